#pragma once

#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/effects/effect.hpp"
#include "scene/table_reader.hpp"

namespace drape {

/// An effect and the table that describes it.
struct ReadEffect {
  Effect effect;
  const TomlValue* table;
  bool good;  ///< true if read without a problem
};

/// Reads the tables [effects.NAME] of a document, in the order of the registry; equal names keep their document order.
std::vector<ReadEffect> read_effects(const TomlValue& document, TableReader& reader, Problems& problems);

/// Returns the key path of each effect: effects.NAME. Several effects of one name get numbers: effects.sphere.0.
std::vector<std::string> effect_paths(const std::vector<ReadEffect>& effects);

/// Lets each effect check its values against all other settings.
/// @param settings settings that contain these effects
void check_effects(const std::vector<ReadEffect>& effects, const SimulationSettings& settings, Problems& problems);

struct ReadEffect;
struct TableType;

/// Returns the value of a key's target. A value in a custom form is returned as the document writes it.
/// @param written the key's value in the document; null if absent
FieldValue field_value(const Key& key, const TomlValue* written);

/// Returns every key of a scene with its effective value, given or default, and "scene", the scene's name. The path of
/// a repeated effect contains its number: effects.sphere.0.radius.
std::vector<SceneField> scene_fields(const std::string& name, const std::vector<TableType>& tables,
                                     const std::vector<ReadEffect>& effects, const TomlValue& document);

/// Formats a value as in a scene file, on one line.
std::string toml_text(const TomlValue& value);

}  // namespace drape
