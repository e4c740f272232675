#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "study/case.hpp"

namespace drape {

/// What the report prints about a case, and what its code gives when it is run again.
struct Reported {
  std::optional<double> iterations, again;
  double microseconds = 0;
};

/// A row of the homework's tables.
struct HomeworkRow {
  int table = 0;  ///< 1, 2 or 3
  std::string method;
  double step = 0;        ///< [s]
  std::string tolerance;  ///< as it is written: "1e-3"; empty where there is none
  Reported reported;
  StudyCase what;
};

/// The rows of tables 1, 2 and 3, in their order.
std::vector<HomeworkRow> homework_rows();

/// Further cases that the report's conclusions are about, none of which is in its tables.
enum class Extra : std::size_t {
  undamped,   ///< semi-implicit, k = 18, without damping: to be compared with the implicit motion
  half_step,  ///< semi-implicit, k = 18, damped, with half the time step
  no_sphere,  ///< semi-implicit, k = 180, damped, without the sphere
};
std::vector<StudyCase> homework_extras();

/// The cloth of the report's energy log: semi-implicit, k = 180, without damping, 20 steps.
StudyCase homework_energy_case();

}  // namespace drape
