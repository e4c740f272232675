#pragma once

#include <functional>

#include "scene/scene.hpp"

namespace drape {

/// Changes what trades time for detail as the scene's quality says, relative to its own values.
///   draft  half the size, at most 12.5 frames per second, one sample, no ambient occlusion, a tenfold tolerance; where
///          none is given, an error of 1e-4 of the cloth's size per step, or 0.03 of its fall in a step if that is less
///   print  twice the size, at most 8192 pixels, four samples, textures filtered 16-fold
/// A tolerance that follows from an accuracy stays. So does a value that the command line gives.
/// @param given whether the command line gives the value of a key, "video.size"
void apply_quality(Scene& scene, const std::function<bool(const char*)>& given);

}  // namespace drape
