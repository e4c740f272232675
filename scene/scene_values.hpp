#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drape/render/overlay/caption.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/state.hpp"
#include "scene/cloth_reader.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A table of a scene with its path and its node in the document. Its keys refer to the scene's values.
struct WrittenTable {
  TableType type;
  const TomlValue* written;  ///< node in the document; null if absent
  bool effect = false;
};

/// Returns all tables of a scene, effects last. Tables of several cloths are named cloth.NAME and cloth.NAME.transform.
/// All keys refer to the arguments.
std::vector<WrittenTable> written_tables(ClothList& cloths, Scene& scene, std::vector<ReadEffect>& effects,
                                         const TomlValue& document);

/// Returns every key with its effective value, given or default. The field "scene" holds the scene's name. The path of
/// a repeated effect contains its number: effects.sphere.0.radius.
std::vector<SceneField> scene_fields(const std::string& name, const std::vector<WrittenTable>& tables);

/// Returns the part of physics_values() that tables contain.
/// @param folder folder of the files that effects name
std::vector<SceneValue> physics_of_tables(const std::vector<WrittenTable>& tables, const std::filesystem::path& folder);

/// Returns the names of fields that vary in time: "time", "step", "energy.total".
std::vector<std::string> moment_fields();

/// Returns the value of one of the moment_fields() at a frame.
/// @param step time step [s]
FieldValue moment_value(const std::string& name, const Frame& frame, double step);

/// Returns true if a text uses energies or iteration counts, which frames carry only on request.
bool needs_motion_facts(const TextTemplate& text);

/// Fills in the constant fields of a caption's text; the time-dependent fields stay open.
/// @param text     caption text from the scene
/// @param fields   fields that the text can name beside moment_fields()
/// @param place    place of the text; `problems` receives unknown field names and invalid formats
TextTemplate fill_caption(const std::string& text, const std::vector<SceneField>& fields, const Place& place,
                          Problems& problems);

}  // namespace drape
