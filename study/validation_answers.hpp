#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/validation_case.hpp"

namespace drape {

/// A value that somebody gives for a known answer.
struct GivenAnswer {
  const ValidationProblem* problem = nullptr;
  const KnownAnswer* known = nullptr;
  double value = 0;

  [[nodiscard]] bool met() const;
};

/// Reads answers: a CSV file with the columns problem, quantity and value; or an NPZ file with a motion of one problem,
/// which is measured as drape's own: `positions` (times × vertices × 3, or vertices × 3 of the last state), `times`,
/// and `velocities` where the measure needs them, the vertices in the order of the case's mesh.
/// @param problem that an NPZ file is of; may be empty where the case has one alone
/// @throws UsageError "file: message"
std::vector<GivenAnswer> read_answers(const ValidationCase& of, const std::filesystem::path& file,
                                      const std::string& problem);

}  // namespace drape
