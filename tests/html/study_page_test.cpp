#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "reports/listing.hpp"
#include "study/homework.hpp"
#include "tests/html/html_page.hpp"

namespace drape {
namespace {

using test::Browser;

HomeworkStudy sample_study() {
  HomeworkStudy study;
  study.runs = 5;
  study.conclusions = {{"Implicit Euler looks right even at ε = 1.", true, "0.000 pairs a frame."},
                       {"The sphere makes every method <faster>.", false, "It does not."}};
  study.tables = {{"table1", "Table 1", {"method", "iterations"}, {{"liu13", "7.24"}}, {"A note."}}};
  html::Chart chart;
  chart.title = "Iterations by tolerance.";
  chart.x_title = "tolerance ε [m]";
  chart.y_title = "iterations";
  chart.x_scale = chart.y_scale = html::Scale::logarithmic;
  for (const std::string method : {"implicit", "liu13"}) {
    html::ChartSeries series{method, {}};
    for (int k = 0; k <= 5; ++k) {
      const double tolerance = std::pow(10, -k);
      series.points.push_back({tolerance, method == "liu13" ? 2 + 3.0 * k * k : 2.0 + k, "ε = 1e-" + std::to_string(k),
                               "drape simulate " + method + " 1e-" + std::to_string(k)});
    }
    chart.series.push_back(series);
  }
  study.charts = {{"iterations", chart}};
  study.differences = {"drape also holds pins"};
  return study;
}

/// Makes a report with a cloth of 2×2 cells that turns about an edge.
StudyReport report_with_motion() {
  Scene scene;
  const Mesh grid = make_grid(2, 2);
  scene.simulation.cloth = make_cloth(grid, grid, 1, 10, {});
  std::vector<Frame> frames;
  for (int k = 0; k < 20; ++k) {
    Frame frame{.index = k, .time = 0.05 * k, .positions = scene.simulation.cloth.positions};
    for (auto x : frame.positions.rowwise()) {
      x[2] = x[0] * std::sin(0.1 * k);
      x[0] *= std::cos(0.1 * k);
    }
    frames.push_back(std::move(frame));
  }
  HomeworkStudy study = sample_study();
  for (const char* label : {"liu13 <exact>", "semi-implicit"}) {
    study.motions.push_back({label, "drape render it -o motion.html", pack_for_page(scene, frames, distant_view({}))});
  }
  study.motions.push_back({"one that a browser cannot hold", {}, {}});
  return homework_report(study);
}

/// Makes a report of cases, the first of which is not met.
StudyReport report_of_cases(std::size_t count) {
  StudyReport report;
  report.kind = "drape study cases";
  report.headline = "Cases";
  report.command = "drape study cases";
  report.answer = StudySection{"Summary", {"All of them."}, {}, {}, {}};
  report.list = StudyList{"cases", {"cases", "Cases", {"case", "answers"}, {}, {"A note."}}};
  report.findings.push_back({html::Tone::neutral, "", "Of the whole study.", ""});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string title = "Case " + std::to_string(i);
    report.list->table.rows.push_back({title, std::to_string(i)});
    report.findings.push_back({i == 0 ? html::Tone::bad : html::Tone::good, "", title + " is found.", "", title});
    StudySection section{title, {"About " + title + "."}, {}, {}, {}};
    section.group = i == 0 ? "not met" : "met";
    report.sections.push_back(std::move(section));
  }
  report.sections.push_back({"How it was measured", {"By a clock."}, {}, {}, {}});
  return report;
}

class StudyPage : public test::InBrowser {
 protected:
  /// Returns the visible texts of a selector.
  std::string seen(const std::string& selector) {
    return browser_->run("return [...document.querySelectorAll('" + selector +
                         "')].filter((e) => e.getClientRects().length).map((e) => e.textContent).join()");
  }

  std::string tip() {
    return browser_->run("const t = document.getElementById('tip'); return t.hidden ? '' : t.textContent");
  }
};

TEST_F(StudyPage, IsSoundAndSaysWhatIsNotConfirmed) {
  open(to_page(homework_report(sample_study())));
  expect_sound();
  EXPECT_EQ(browser_->run("return document.querySelector('h1').textContent"),
            "1 of the report's 2 conclusions are confirmed");
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.findings .bad').length"), 1);
  keep_screenshots("study");
}

TEST_F(StudyPage, OpensOneOfManyCases) {
  open(to_page(report_of_cases(html::many_entries)));
  expect_sound();
  browser_->set_width(1200);
  EXPECT_EQ(seen(".filters button"), "all 6,not met 1,met 5");
  EXPECT_EQ(seen("main h2"), "Summary,How it was measured");
  EXPECT_EQ(seen("main table caption"), "Cases") << "the list is the only table";
  EXPECT_EQ(seen(".findings strong"), "Of the whole study.,Case 0 is found.") << "a good finding is in its section";
  follow("tbody tr:nth-child(3) a");
  EXPECT_EQ(seen("main h2"), "Case 2,Summary,How it was measured");
  EXPECT_EQ(seen(".entry .findings strong"), "Case 2 is found.");
  browser_->set_print(false);
  EXPECT_EQ(seen(".entry h2"), "Case 0,Case 1,Case 2,Case 3,Case 4,Case 5");
  browser_->set_theme(false);
  keep_screenshots("study-list");
}

TEST_F(StudyPage, ShowsFewCasesBelowEachOther) {
  open(to_page(report_of_cases(html::many_entries - 1)));
  expect_sound();
  EXPECT_EQ(seen(".filters button"), "");
  EXPECT_EQ(seen("main h2"), "Summary,Findings,Case 0,Case 1,Case 2,Case 3,Case 4,How it was measured");
  EXPECT_EQ(seen("main table caption"), "Cases");
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.findings li').length"), html::many_entries);
}

TEST_F(StudyPage, HasMotionsToTurnThatAreOpenedOneAtATime) {
  open(to_page(report_with_motion()));
  expect_sound();
  browser_->set_width(1200);
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.turn').length"), 2);
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.turn[data-state]').length"), 0);
  browser_->click("details:has(.turn) summary");
  const auto state = [&] { return browser_->run("return document.querySelector('.turn').dataset.state || ''"); };
  for (int i = 0; i < 200 && state() != "ready"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_EQ(state(), "ready");
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.turn[data-state]').length"), 1);
  EXPECT_EQ(browser_->run("return document.querySelector('details:has(.turn) summary').textContent"),
            "Turn the cloth: liu13 <exact>");
  EXPECT_EQ(browser_->run("return document.querySelector('.turn').player.motion.frames"), 20);
  browser_->run("document.querySelector('.turn canvas').focus()");
  browser_->press(".");
  EXPECT_EQ(browser_->run("return document.querySelector('.turn').dataset.frame"), "1");
  keep_screenshots("study-motions");
}

TEST_F(StudyPage, HoveringAPointShowsItsCommand) {
  open(to_page(homework_report(sample_study())));
  EXPECT_EQ(tip(), "");
  browser_->point_at(".series.s1 .point:nth-of-type(4) .sign");
  EXPECT_EQ(tip(), "liu13, ε = 1e-3drape simulate liu13 1e-3");
  browser_->point_at("h1");
  EXPECT_EQ(tip(), "");
}

TEST_F(StudyPage, ArrowKeysGoFromPointToPoint) {
  open(to_page(homework_report(sample_study())));
  browser_->run("document.querySelector('.chart > svg').focus()");
  browser_->press(Browser::arrow_right);
  EXPECT_EQ(tip(), "implicit, ε = 1e-0drape simulate implicit 1e-0");
  browser_->press(Browser::arrow_right);
  EXPECT_EQ(tip(), "implicit, ε = 1e-1drape simulate implicit 1e-1");
  browser_->press("\uE015");  // down: the other series, nearby
  EXPECT_TRUE(tip().starts_with("liu13, ε = 1e-1")) << tip();
  browser_->press(Browser::arrow_left);
  EXPECT_TRUE(tip().starts_with("liu13, ε = 1e-0")) << tip();
  browser_->press("\uE00C");  // escape
  EXPECT_EQ(tip(), "");
}

// The browser reports a scroll with a delay, even after the key that shows a point's values.
TEST_F(StudyPage, ValuesStayWithTheirPointWhileThePageScrolls) {
  open(to_page(homework_report(sample_study())));
  browser_->run("document.querySelector('.chart > svg').focus()");
  browser_->press(Browser::arrow_right);
  const std::string above =
      "const p = document.querySelector('.point.shown .sign').getBoundingClientRect();"
      "return p.top - document.getElementById('tip').getBoundingClientRect().bottom";
  const double before = browser_->run(above);
  browser_->run("scrollBy(0, -40); dispatchEvent(new Event('scroll'))");
  EXPECT_EQ(tip(), "implicit, ε = 1e-0drape simulate implicit 1e-0");
  EXPECT_NEAR(browser_->run(above).get<double>(), before, 1);
}

}  // namespace
}  // namespace drape
