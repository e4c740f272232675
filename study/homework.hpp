#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "study/measure.hpp"
#include "study/report.hpp"
#include "study/runs_file.hpp"

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
  StudyCase study_case;
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

/// Tests each conclusion of the report.
/// @param rows   homework_rows()
/// @param tables measurements of these rows, in the same order
/// @param extras measurements of homework_extras()
std::vector<Conclusion> judge_conclusions(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables,
                                          const std::vector<Measured>& extras);

/// Returns the row of a table with this method and tolerance; "" matches any tolerance.
/// @throws std::out_of_range if there is none
std::size_t find_row(const std::vector<HomeworkRow>& rows, int table, const std::string& method,
                     const std::string& tolerance = "");

/// Returns the report of a study for all output formats.
StudyReport homework_report(const HomeworkStudy& study);

}  // namespace drape
