#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"

namespace drape {

/// A hash of what a document says: neither comments nor the order of keys nor the way in which a number is written
/// (1, 1.0, 1e0) change it. 16 hexadecimal digits.
/// @param ignored names of tables below the root that do not count
std::string digest(const TomlValue& document, const std::vector<std::string>& ignored = {});

}  // namespace drape
