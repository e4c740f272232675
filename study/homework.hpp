#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/measure.hpp"
#include "study/report.hpp"

namespace drape {

/// Something that the homework's report concludes, and what came out here.
struct Conclusion {
  std::string claim;
  bool confirmed = false;
  std::string figures;
};

/// The homework's tables, measured again, beside what its report prints.
struct HomeworkStudy {
  std::vector<ResultTable> tables;
  ResultTable energies;  ///< the log of the first 20 steps, in full
  std::vector<NamedChart> charts;
  std::vector<StudyMotion> motions;  ///< of each method of tables 1 and 2
  std::vector<Conclusion> conclusions;
  std::vector<std::string> differences;  ///< from the report on purpose, a sentence each
  RunCount runs;
  double seconds = 0;
};

/// @param runs  timed runs of every case
/// @returns nothing if it was stopped
std::optional<HomeworkStudy> study_homework(RunCount runs, const std::stop_token& stop, Progress& progress);

}  // namespace drape
