#include <gtest/gtest.h>

#include "reports/chart.hpp"
#include "reports/diagram_files.hpp"
#include "reports/page.hpp"
#include "study/stability_map.hpp"
#include "tests/html/html_page.hpp"

namespace drape {
namespace {

/// SVG files in a browser.
class DiagramFile : public test::InBrowser {
 protected:
  /// Checks that every word is within the picture, and none overlaps another.
  void expect_legible(const html::Diagram& diagram) { expect_legible(html::svg_file(diagram)); }
  void expect_legible(const std::string& svg) {
    open(svg, "diagram.svg");
    EXPECT_EQ(browser_->console_problems(), std::vector<std::string>());
    EXPECT_EQ(browser_->requests(), std::vector<std::string>());
    const std::string problems = browser_->run(R"(
      const whole = document.documentElement.getBoundingClientRect();
      const words = [...document.querySelectorAll("text")].map((t) => [t.textContent, t.getBoundingClientRect()]);
      const said = [];
      words.forEach(([text, box], i) => {
        if (box.width === 0 && text) said.push(`${text}: not drawn`);
        if (box.left < whole.left || box.right > whole.right || box.top < whole.top || box.bottom > whole.bottom)
          said.push(`${text}: cut off`);
        for (const [other, b] of words.slice(i + 1)) {
          const across = Math.min(box.right, b.right) - Math.max(box.left, b.left);
          const down = Math.min(box.bottom, b.bottom) - Math.max(box.top, b.top);
          // Boxes have the height of a line; above and below digits it is empty for 0.43 of the font size (DejaVu Serif).
          if (across > 0 && down > 3) said.push(`${text} / ${other}: over each other`);
        }
      });
      return said.join("\n"))");
    EXPECT_EQ(problems, "");
  }
};

html::Chart chart_of(html::Scale x, html::Scale y, double from, double to) {
  html::Chart chart{
      "The largest distance of a vertex to the exact minimiser, mean over 14 states along the motion, which "
      "is a long title.",
      "time per step [µs], median and quartiles",
      "error [m]",
      x,
      y,
      {},
      {}};
  for (const char* name :
       {"semi-implicit", "implicit", "implicit, cholesky", "liu13", "liu13, report", "quasi-newton"}) {
    html::ChartSeries series = method_series(name);
    for (int i = 0; i <= 6; ++i) {
      const double along = from * std::pow(to / from, i / 6.0);
      series.points.push_back({along, (1.0 + static_cast<double>(chart.series.size())) * along, "", ""});
    }
    chart.series.push_back(series);
  }
  chart.levels = {{from, "distance between the two references"}};
  return chart;
}

TEST_F(DiagramFile, IsLegibleWhateverTheAxesAre) {
  using enum html::Scale;
  for (const html::Scale x : {linear, logarithmic}) {
    for (const html::Scale y : {linear, logarithmic}) {
      for (const double factor : {1.1, 40.0, 1e12}) {
        SCOPED_TRACE(factor);
        expect_legible(html::still_chart(chart_of(x, y, 3e-7, 3e-7 * factor)));
        expect_legible(html::still_chart(chart_of(x, y, 137, 137 * factor)));
      }
    }
  }
}

TEST_F(DiagramFile, IsLegibleOnPaper) {
  using enum html::Scale;
  for (const double inches : {3.3, 7.0}) {
    for (const html::Scale x : {linear, logarithmic}) {
      for (const double factor : {1.1, 40.0, 1e12}) {
        SCOPED_TRACE(factor);
        expect_legible(
            html::paper_file(html::paper_chart(chart_of(x, logarithmic, 3e-7, 3e-7 * factor), inches), inches));
        expect_legible(html::paper_file(html::paper_chart(chart_of(x, linear, 137, 137 * factor), inches), inches));
      }
    }
  }
}

StabilityMap map_of(int per_decade) {
  StabilityMap map;
  map.method = Method::quasi_newton;
  map.axis = StabilityAxis::push;
  map.limit_name = "step·√stiffness = 2";
  for (int i = 0; i <= 5 * per_decade; ++i) map.steps.push_back(std::pow(10, -5 + 1.0 * i / per_decade));
  for (int i = 0; i <= 9 * per_decade; ++i) map.stiffnesses.push_back(std::pow(10, 1.0 * i / per_decade));
  for (const double stiffness : map.stiffnesses) {
    map.limits.push_back(2 / std::sqrt(stiffness));
    for (const double step : map.steps) {
      const bool beyond = step > map.limits.back();
      map.cells.push_back(
          {step, stiffness, beyond ? StabilityOutcome::blown_up : StabilityOutcome::not_converged, step, 1});
    }
  }
  return map;
}

TEST_F(DiagramFile, OfAStabilityMapIsLegible) {
  for (const int per_decade : {1, 3}) {
    expect_legible(map_diagram(map_of(per_decade)));
    for (const double inches : {3.3, 7.0}) expect_legible(html::paper_file(map_diagram(map_of(per_decade)), inches));
  }
}

TEST_F(DiagramFile, OfAStabilityMapIsLegibleOnAPageInANarrowWindow) {
  for (const int per_decade : {1, 3}) {
    html::Page page;
    page.content = html::row({map_figure(map_of(per_decade))});
    open(html::render(page));
    for (const int width : {390, 1200}) {
      browser_->set_width(width);
      EXPECT_EQ(browser_->run(R"(
        const boxes = [...document.querySelectorAll(".chart text")].filter((t) => t.textContent)
          .map((t) => t.getBoundingClientRect());
        return boxes.filter((a, i) => boxes.slice(i + 1).some((b) => a.left < b.right && b.left < a.right &&
          a.top < b.bottom - 3 && b.top < a.bottom - 3)).length)"),
                0)
          << width;
    }
  }
}

}  // namespace
}  // namespace drape
