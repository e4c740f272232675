#include "study/homework_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/atomic_file.hpp"
#include "html/components.hpp"
#include "html/page.hpp"
#include "sim/kernels/kernels.hpp"
#include "study/gnuplot.hpp"

namespace drape {
namespace {

std::string headline(const HomeworkStudy& study) {
  const auto confirmed = std::count_if(study.conclusions.begin(), study.conclusions.end(),
                                       [](const Conclusion& c) { return c.confirmed; });
  return fmt::format("{} of the report's {} conclusions are confirmed", confirmed, study.conclusions.size());
}

const char* verdict(const Conclusion& conclusion) { return conclusion.confirmed ? "confirmed" : "not confirmed"; }

std::string method_of_measuring(const HomeworkStudy& study) {
  return fmt::format(
      "Times are the computing time of one thread that stays on one processor, the mean over the steps of a run: the "
      "median "
      "and the quartiles of {} runs, in which the cases take turns. A first run is not timed.",
      study.runs);
}

}  // namespace

std::string homework_text(const HomeworkStudy& study) {
  std::string text;
  for (const ResultTable& table : study.tables) text += to_text(table) + "\n";
  text += headline(study) + "\n";
  for (const Conclusion& c : study.conclusions) {
    text += fmt::format("  {}: {}\n      {}\n", verdict(c), c.claim, c.figures);
  }
  text += "\nDifferences on purpose\n";
  for (const std::string& difference : study.differences) text += fmt::format("  {}\n", difference);
  return text + fmt::format("\n{}\n", method_of_measuring(study));
}

std::string homework_markdown(const HomeworkStudy& study) {
  std::string text = fmt::format("# The homework, measured again\n\n{}.\n\n", headline(study));
  for (const Conclusion& c : study.conclusions) text += fmt::format("- **{}** {} {}\n", verdict(c), c.claim, c.figures);
  text += "\n";
  for (const ResultTable& table : study.tables) text += to_markdown(table) + "\n";
  for (const NamedChart& chart : study.charts) text += fmt::format("![{}]({}.svg)\n\n", chart.chart.title, chart.name);
  text += "## Differences on purpose\n\n";
  for (const std::string& difference : study.differences) text += fmt::format("- {}\n", difference);
  return text + fmt::format("\n{}\n", method_of_measuring(study));
}

std::string homework_page(const HomeworkStudy& study) {
  std::vector<html::Finding> findings;
  for (const Conclusion& c : study.conclusions) {
    findings.push_back({c.confirmed ? html::Tone::good : html::Tone::bad,
                        html::element("strong", fmt::format("{} {}", c.claim, c.confirmed ? "" : "Not confirmed.")) +
                            " " + c.figures});
  }
  html::Markup tables, charts, differences;
  for (const ResultTable& table : study.tables) tables += to_html(table);
  for (const NamedChart& chart : study.charts) charts += html::chart(chart.chart);
  for (const std::string& difference : study.differences) differences += html::paragraph(difference);

  html::Page page;
  page.kind = "drape study homework";
  page.title = "The homework, measured again";
  page.heading = headline(study);
  page.introduction =
      html::paragraph(
          "The tables of the report that drape grew out of, with its own figures beside drape's: mass-spring "
          "cloth of 20×20 cells, 8.34 s of motion.") +
      html::command("This study", "drape study homework");
  page.content =
      html::findings(findings) + html::section(2, "tables", "Tables", tables) +
      html::section(2, "diagrams", "Diagrams",
                    html::note("Point at a curve, or go along it with the arrow keys, to see its values and the "
                               "command that computes them.") +
                        charts) +
      html::section(2, "differences", "Where drape differs on purpose", differences) +
      html::section(2, "measuring", "How it was measured", html::paragraph(method_of_measuring(study)));
  page.foot = html::provenance();
  page.foot.emplace_back("Instruction set", std::string(kernels().name));
  page.foot.emplace_back("Took", fmt::format("{:.0f} s", study.seconds));
  return html::render(page);
}

std::string write_homework_files(const HomeworkStudy& study, const std::filesystem::path& folder) {
  for (const ResultTable& table : study.tables) write_file_atomically(folder / (table.name + ".csv"), to_csv(table));
  write_file_atomically(folder / (study.energies.name + ".csv"), to_csv(study.energies));
  write_file_atomically(folder / "report.md", homework_markdown(study));
  write_file_atomically(folder / "report.html", homework_page(study));
  std::string problem;
  for (const NamedChart& chart : study.charts) problem = write_plot(chart.chart, folder, chart.name);
  return problem;
}

}  // namespace drape
