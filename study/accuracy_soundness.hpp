#pragma once

#include <string>

#include "study/accuracy.hpp"

namespace drape {

/// Says what keeps a report from being made of a scene that was read from a file: lists that do not go together.
/// @returns a sentence without a full stop; empty: nothing does
std::string unsound_in(const SceneAccuracy& scene);

}  // namespace drape
