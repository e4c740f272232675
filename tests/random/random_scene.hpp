#pragma once

#include <cstdint>
#include <string>

namespace drape::test {

/// A scene file of at most 400 vertices and 50 steps, the same for the same seed. Every table and key that the program
/// describes takes part, whatever effects there will be: its value is near its default mostly, sometimes many orders of
/// magnitude from it, and now and then at its limits, beyond them, or no number at all. Only counts of iterations stay
/// below some hundreds, since a scene may well ask for more work than anyone has time for. A fifth of the scenes are
/// small cloths of stiff springs in long steps, thrown, with little else that acts on them: k·h²/m is up to 1e14.
std::string random_scene(std::uint64_t seed);

}  // namespace drape::test
