#pragma once

#include <string>
#include <vector>

#include "core/keys.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

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
