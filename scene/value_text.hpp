#pragma once

#include <string>

#include "core/keys.hpp"

namespace drape {

/// What a key's target holds, as a scene would say it; empty where it holds nothing, or what is of a form of its own.
/// Different values have different texts.
std::string value_text(const Key::Target& target);

}  // namespace drape
