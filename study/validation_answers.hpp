#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/validation_case.hpp"

namespace drape {

/// A value from another program for a known answer.
struct GivenAnswer {
  const ValidationProblem* problem = nullptr;
  const KnownAnswer* known = nullptr;
  double value = 0;

  [[nodiscard]] bool met() const;
};

/// Reads answers from a CSV file with the columns problem, quantity and value, or from an NPZ file. An NPZ file has a
/// motion of one problem, measured like drape's own; vertices are in the order of the case's mesh. Its arrays are
/// `times`, `positions` (times × vertices × 3, or vertices × 3 for the last state), and `velocities` if the measure
/// needs them.
/// @param problem of the NPZ file; may be empty for a case with one problem
/// @throws UsageError "file: message"
std::vector<GivenAnswer> read_answers(const ValidationCase& of, const std::filesystem::path& file,
                                      const std::string& problem);

}  // namespace drape
