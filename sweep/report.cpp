#include "sweep/report.hpp"

#include "core/atomic_file.hpp"
#include "sweep/charts.hpp"
#include "sweep/page.hpp"
#include "sweep/tables.hpp"

namespace drape {

std::string write_sweep_report(const SweepResults& results, const std::filesystem::path& folder) {
  write_file_atomically(folder / "runs.csv", runs_csv(results));
  write_file_atomically(folder / "report.md", sweep_markdown(results));
  write_file_atomically(folder / "table.tex", sweep_latex(results));
  std::string problem;
  for (const NamedChart& chart : figure_diagrams(results).charts) {
    const std::string missing = write_chart(chart, folder / diagrams_place);
    if (problem.empty()) problem = missing;
  }
  write_file_atomically(folder / sweep_page_name, sweep_page(results, folder));
  return problem;
}

}  // namespace drape
