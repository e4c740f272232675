#include "study/homework_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drape {

StudyReport homework_report(const HomeworkStudy& study) {
  const auto confirmed = std::count_if(study.conclusions.begin(), study.conclusions.end(),
                                       [](const Conclusion& c) { return c.confirmed; });
  StudyReport report;
  report.kind = report.command = "drape study homework";
  report.title = "The homework's results, measured again";
  report.headline = fmt::format("{} of the report's {} conclusions are confirmed", confirmed, study.conclusions.size());
  report.introduction =
      "The tables of the report that drape grew out of, with drape's measurements beside its own: mass-spring cloth of "
      "20×20 cells, 8.34 s of motion.";
  for (const Conclusion& c : study.conclusions) {
    report.findings.push_back({c.confirmed ? html::Tone::good : html::Tone::bad,
                               c.confirmed ? "confirmed" : "Not confirmed.", c.claim, c.figures});
  }
  report.sections = {{"Tables", {}, study.tables, {}, {}},
                     {"Diagrams", {}, {}, study.charts, {}},
                     {"Where drape differs on purpose", study.differences, {}, {}, {}},
                     {"How it was measured", {describe_measuring(study.runs)}, {}, {}, {}}};
  report.data = {study.energies};
  report.seconds = study.seconds;
  return report;
}

}  // namespace drape
