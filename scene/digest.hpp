#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"

namespace drape {

/// Computes a hash of a document's content, 16 hexadecimal digits. Comments, the order of keys and the notation of
/// numbers (1, 1.0, 1e0) do not change it.
/// @param ignored names of top-level tables to leave out
std::string digest(const TomlValue& document, const std::vector<std::string>& ignored = {});

}  // namespace drape
