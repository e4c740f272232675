#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "study/case.hpp"

namespace drape {

/// The report's values for a case, and the iterations that its code gives in a new run.
struct Reported {
  std::optional<double> iterations, again;
  double microseconds = 0;
};

/// A row of the homework's tables.
struct HomeworkRow {
  int table = 0;  ///< 1, 2 or 3
  std::string method;
  double step = 0;        ///< [s]
  std::string tolerance;  ///< as written: "1e-3"; empty if there is none
  Reported reported;
  StudyCase what;
};

/// Returns the rows of tables 1, 2 and 3, in order.
std::vector<HomeworkRow> homework_rows();

/// Further cases for the report's conclusions, which its tables lack.
enum class Extra : std::size_t {
  undamped,   ///< semi-implicit, k = 18, undamped, for comparison with the implicit motion
  half_step,  ///< semi-implicit, k = 18, damped, with half the time step
  no_sphere,  ///< semi-implicit, k = 180, damped, without the sphere
};
std::vector<StudyCase> homework_extras();

/// Returns the case of the report's energy log: semi-implicit, k = 180, undamped, 20 steps.
StudyCase homework_energy_case();

}  // namespace drape
