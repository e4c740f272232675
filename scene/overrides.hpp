#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"

namespace drape {

/// Applies assignments "key.path=value" to a document in order, as if the file contained them. The value is any TOML
/// value, or a bare word, which is a string. Missing tables on the path are added. A number on the path picks an item
/// of an array; an array of one table needs no number: effects.sphere.0.radius, effects.sphere.radius. An item of an
/// absent array changes the array's default: video.size.0. Failed assignments are added to `problems`.
void apply_overrides(TomlValue& document, const std::vector<std::string>& overrides, Problems& problems);

}  // namespace drape
