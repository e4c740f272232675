// The diagram of docs/reference/effects.md: heavy strips of few cells whose springs are ever stiffer.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "reports/chart.hpp"
#include "study/known_answers.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/sheets_to_bend.hpp"

namespace drape::locking_diagram_test {
namespace {

using test::Division;

constexpr const char* diagram_file = DRAPE_SOURCE_DIR "/docs/images/bending-stiff-strip.svg";
constexpr std::array divisions{Division::diagonal, Division::alternating, Division::crossed, Division::delaunay,
                               Division::relaxed};
constexpr double rigidity = 1, weight = 1;  // of a strip of length 1: ρgL³/D = 1

/// Returns the tip's error as a fraction of its drop, for a strip at rest.
/// @param stiffness E L²/D
double error_of_tip(Division division, int cells, double stiffness) {
  const test::Sheet sheet = test::clamped_strip(division, cells, cells / 3, 1);
  constexpr double g = 9.8;
  Cloth cloth = test::cloth_of(sheet, weight / g);
  stiffen_by_area(stiffness * rigidity, cloth);
  SimulationSettings settings = test::setup(std::move(cloth), Method::implicit, 1);
  settings.effects.add(Bending{.rigidity = rigidity});
  settings.effects.add(Gravity{.acceleration = {0, 0, -g}});
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-6;
  settings.integrator.max_iterations = 1000;
  Simulation simulation(std::move(settings));
  for (int i = 0; i < 100 && (i < 3 || simulation.state().v.cwiseAbs().maxCoeff() > 1e-6); ++i) simulation.step();
  return test::tip_drop(sheet, simulation.state().x) / heavy_elastica(1).drop - 1;
}

std::string legend_of(Division division) {
  switch (division) {
    case Division::diagonal:
      return "one diagonal";
    case Division::alternating:
      return "alternating";
    case Division::crossed:
      return "X";
    case Division::delaunay:
      return "Delaunay";
    default:
      return "Delaunay, relaxed";
  }
}

TEST(LockingDiagram, ShowsStripsOfTenCells) {
  html::Chart chart;
  chart.title = "Error of a clamped strip's tip against the stiffness of its springs";
  chart.x_title = "E L²/D";
  chart.y_title = "error of the tip [%]";
  chart.x_scale = html::Scale::logarithmic;
  for (const Division division : divisions) {
    html::ChartSeries series;
    series.name = legend_of(division);
    for (int exponent = 3; exponent <= 8; ++exponent) {
      const double stiffness = std::pow(10, exponent), error = error_of_tip(division, 10, stiffness);
      if (exponent == 4 || exponent == 5) {
        EXPECT_LT(std::abs(error), 0.0105) << series.name << ", 1e" << exponent;
      }
      html::ChartPoint& point = series.points.emplace_back();
      point.x = stiffness;
      point.y = 100 * error;
    }
    chart.series.push_back(std::move(series));
  }
  if (std::getenv("DRAPE_UPDATE_DOCS") != nullptr) {
    std::ofstream(diagram_file, std::ios::binary) << html::svg_file(html::still_chart(chart));
  }
}

TEST(LockingDiagram, StripsOfTwentyCellsDoNotLock) {
  for (const Division division : divisions) {
    for (const double stiffness : {1e5, 1e7}) {
      EXPECT_LE(std::abs(error_of_tip(division, 20, stiffness)), 0.004) << legend_of(division) << ", " << stiffness;
    }
  }
}

}  // namespace
}  // namespace drape::locking_diagram_test
