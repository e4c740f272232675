#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {

/// A case that is hard for a solver.
struct HardCase {
  std::string name;
  std::string file;                          ///< scene file; empty for a case that no scene can express
  std::function<SimulationSettings()> make;  ///< makes a case without a scene file
  std::int64_t steps = 100;                  ///< of a case without a scene file
};

inline void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

/// Returns scenes/hard/*.toml in the order of their names, and the cases that no scene can express.
const std::vector<HardCase>& hard_cases();

/// Settings and number of steps of a run.
struct HardRun {
  SimulationSettings settings;
  std::int64_t steps = 0;
};

/// Returns the run of a case with a method.
/// @param more overrides, as on the command line; only step and allow_unstable for a case without a scene
/// @throws UsageError if it is refused
HardRun load(const HardCase& hard, Solver solver, const std::vector<std::string>& more = {});

/// Names a parametrised test after its case and method.
std::string case_and_method(const testing::TestParamInfo<std::tuple<HardCase, NamedMethod>>& info);

}  // namespace drape::test
