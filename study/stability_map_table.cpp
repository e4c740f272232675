#include <fmt/format.h>

#include "html/chart_axis.hpp"
#include "study/stability_map.hpp"

namespace drape {

ResultTable map_table(const StabilityMap& map) {
  const html::Diagram diagram = map_diagram(map);
  ResultTable table{map_name(map),
                    diagram.title,
                    {diagram.y_title},
                    {},
                    {"Each column is a step. ×: the cloth blew up. *: some steps did not converge."}};
  for (const double step : map.steps) table.columns.push_back(fmt::format("{:.2g} s", step));
  for (std::size_t row = 0; row < map.stiffnesses.size(); ++row) {
    table.rows.push_back({html::short_number(map.stiffnesses[row])});
    for (std::size_t column = 0; column < map.steps.size(); ++column) {
      const StabilityCell& cell = map.cells[row * map.steps.size() + column];
      const char* const mark = cell.outcome == StabilityOutcome::not_converged ? "*" : "";
      table.rows.back().push_back(
          cell.outcome == StabilityOutcome::blown_up ? "×" : fmt::format("{:.2g}{}", cell.energy_error, mark));
    }
  }
  return table;
}

}  // namespace drape
