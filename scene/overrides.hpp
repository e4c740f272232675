#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"

namespace drape {

/// Applies "key.path=value" to a document, one after the other, as if the file said so. The value is any TOML value, or
/// a bare word, which is a string. Tables on the way that do not exist are added. On the way, a number picks an item of
/// an array, and an array of one table may be passed through without one: effects.sphere.0.radius,
/// effects.sphere.radius. An array that the document leaves to its default is that: video.size.0. What cannot be
/// applied is added to `problems`.
void apply_overrides(TomlValue& document, const std::vector<std::string>& overrides, Problems& problems);

}  // namespace drape
