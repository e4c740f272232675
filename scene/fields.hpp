#pragma once

#include <string>
#include <vector>

#include "core/keys.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

struct ReadEffect;
struct TableType;

/// What the target of a key holds. What is of a form of its own is as the document has it.
/// @param written the key's value in the document; null: it is not there
FieldValue field_value(const Key& key, const TomlValue* written);

/// Every key of a scene with what holds for it, be it given or not; and "scene", its name. Of several effects of one
/// name, the number is in the path: effects.sphere.0.radius.
std::vector<SceneField> scene_fields(const std::string& name, const std::vector<TableType>& tables,
                                     const std::vector<ReadEffect>& effects, const TomlValue& document);

/// A value as a scene file has it, in one line.
std::string toml_text(const TomlValue& value);

}  // namespace drape
