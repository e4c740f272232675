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

/// A table of a scene with its path, whose keys refer to the scene's values.
struct WrittenTable {
  TableType type;
  const TomlValue* written;  ///< in the document; null if absent
  bool effect = false;
};

/// Returns all tables of a scene, effects last. Those of several cloths are cloth.NAME and cloth.NAME.transform. Their
/// keys refer to the arguments.
std::vector<WrittenTable> written_tables(ClothList& cloths, Scene& scene, std::vector<ReadEffect>& effects,
                                         const TomlValue& document);

/// Returns every key of a scene with its effective value, given or default, and "scene", the scene's name. The path of
/// a repeated effect contains its number: effects.sphere.0.radius.
std::vector<SceneField> scene_fields(const std::string& name, const std::vector<WrittenTable>& tables);

/// Returns the part of physics_values() that tables contain.
/// @param folder folder of the files that effects name
std::vector<SceneValue> physics_of_tables(const std::vector<WrittenTable>& tables, const std::filesystem::path& folder);

/// Returns the names of fields that vary in time: "time", "step", "energy.total".
std::vector<std::string> moment_fields();

/// Returns the value of such a field at a frame.
/// @param step simulation step [s]
FieldValue moment_value(const std::string& name, const Frame& frame, double step);

/// Returns true if a text uses energies or iteration counts, which frames carry only on request.
bool needs_motion_facts(const TextTemplate& text);

/// Fills in the constant fields of a caption's text; the time-dependent fields stay open.
/// @param text     caption text as the scene has it
/// @param fields   fields that the text can name beside moment_fields()
/// @param place    place of the text, for `problems`: unknown names and formats
TextTemplate fill_caption(const std::string& text, const std::vector<SceneField>& fields, const Place& place,
                          Problems& problems);

}  // namespace drape
