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
      "drape grew out of a course's homework: mass-spring cloth of 20×20 cells, 8.34 s of motion, by two implicit "
      "methods and an explicit one. In tables, \"report\" is what the report on that homework printed, \"its code "
      "again\" what its program gives when it is compiled and run today, and \"drape\" what was measured just now. In "
      "diagrams, the report's figures are dashed, in the colour of their method.";
  for (const Conclusion& c : study.conclusions) {
    report.findings.push_back({c.confirmed ? html::Tone::good : html::Tone::bad,
                               c.confirmed ? "confirmed" : "Not confirmed.", c.claim, c.figures});
  }
  report.sections = {
      {"Tables", {}, study.tables, {}, {}},
      {.title = "Motions", .text = {}, .tables = {}, .charts = {}, .pictures = {}, .motions = study.motions},
      {"Diagrams", {}, {}, study.charts, {}},
      {"Where drape differs on purpose", study.differences, {}, {}, {}},
      {"How it was measured", {describe_measuring(study.runs)}, {}, {}, {}}};
  report.data = {study.energies};
  report.seconds = study.seconds;
  return report;
}

}  // namespace drape
