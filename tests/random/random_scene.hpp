#pragma once

#include <cstdint>
#include <string>

namespace drape::test {

/// Returns a scene file of at most 400 vertices and 50 steps, determined by the seed. It uses every described table and
/// key, including future ones: mostly near the default, sometimes many orders of magnitude away, and occasionally at
/// the limits, beyond them, or not a number. Only counts of iterations stay below some hundreds, to bound the run time.
/// A fifth of the scenes are small cloths of stiff springs in long steps, thrown, with few effects: k·h²/m is up to
/// 1e14.
std::string random_scene(std::uint64_t seed);

}  // namespace drape::test
