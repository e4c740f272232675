#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {

/// One of the worst days of a solver.
struct HardCase {
  std::string name;
  std::string file;                          ///< the scene; empty for a case that a scene cannot say
  std::function<SimulationSettings()> make;  ///< such a case
  std::int64_t steps = 100;                  ///< of such a case
};

inline void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

/// scenes/hard/*.toml, in the order of their names, and the cases that no scene can say.
const std::vector<HardCase>& hard_cases();

/// What to simulate, and for how many steps.
struct HardRun {
  SimulationSettings settings;
  std::int64_t steps = 0;
};

/// The case with a method.
/// @param more overrides, as on the command line; only step and allow_unstable for a case without a scene
/// @throws UsageError if it is refused
HardRun load(const HardCase& hard, Solver solver, const std::vector<std::string>& more = {});

/// Ends the name of a parametrised test with the case's and the method's.
std::string case_and_method(const testing::TestParamInfo<std::tuple<HardCase, NamedMethod>>& info);

}  // namespace drape::test
