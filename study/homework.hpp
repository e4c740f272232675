#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/measure.hpp"
#include "study/report.hpp"

namespace drape {

/// A conclusion of the homework's report, and its confirmation here.
struct Conclusion {
  std::string claim;
  bool confirmed = false;
  std::string figures;
};

/// New measurements of the homework's tables, beside the values printed in its report.
struct HomeworkStudy {
  std::vector<ResultTable> tables;
  ResultTable energies;  ///< the whole log of the first 20 steps
  std::vector<NamedChart> charts;
  std::vector<StudyMotion> motions;  ///< one motion per method of tables 1 and 2
  std::vector<Conclusion> conclusions;
  std::vector<std::string> differences;  ///< intended differences from the report, one sentence each
  RunCount runs;
  double seconds = 0;
};

/// Measures the homework's tables, with `runs` timed runs of every case.
/// @returns nothing if stopped
std::optional<HomeworkStudy> study_homework(RunCount runs, const std::stop_token& stop, Progress& progress);

}  // namespace drape
