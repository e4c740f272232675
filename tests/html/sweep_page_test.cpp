#include <gtest/gtest.h>

#include "sweep/page.hpp"
#include "tests/html/html_page.hpp"
#include "tests/sweep/sweep_runs.hpp"

namespace drape {
namespace {

class SweepPage : public test::InBrowser {
 protected:
  /// Returns the page of eight runs with films of eleven frames, two of which are refused.
  std::string page() {
    put(path("a.toml"), test::tiny_scene);
    SweepRequest request = test::request_of(
        path("a.toml"), {"cloth.stiffness=10,2000", "cloth.mass=1,0.1", "integrator.method=implicit,verlet"});
    request.overrides = {"video.fps=50", "video.speed=0.5"};
    request.films = {"gif"};
    return sweep_page(test::sweep(request, {.folder = path("out"), .shard = {}}), path("out"));
  }

  /// Returns the displacement of each strip from left and top, in pictures.
  nlohmann::json moved() {
    return browser_->run(
        "return [...document.querySelectorAll('.strip')].map((s) => { const a = s.getBoundingClientRect(), b = "
        "s.firstElementChild.getBoundingClientRect();"
        "return [Math.round((a.left - b.left) / a.width), Math.round((a.top - b.top) / a.height)]; })");
  }

  nlohmann::json column(int number) {
    return browser_->run("return [...document.querySelectorAll('.sortable tbody tr')].map((r) => r.cells[" +
                         std::to_string(number) + "].textContent)");
  }
};

TEST_F(SweepPage, PlaysAllFilmsInStep) {
  open(page());
  expect_sound();
  const std::size_t films = moved().size();
  EXPECT_GE(films, 4U);
  // Before playing, each shows another picture than the first, which is the same for all.
  const nlohmann::json posters =
      browser_->run("return [...document.querySelectorAll('.strip')].map((s) => Number(s.dataset.poster))");
  const nlohmann::json shown = moved();
  for (std::size_t k = 0; k < films; ++k) {
    const int poster = posters.at(k);
    EXPECT_GT(poster, 0);
    EXPECT_EQ(shown.at(k), (nlohmann::json{poster % 4, poster / 4}));
  }
  browser_->run("document.querySelector('.strips input[type=range]').focus()");
  for (int k = 0; k < 5; ++k) browser_->press(test::Browser::arrow_right);
  EXPECT_EQ(moved(), nlohmann::json(std::vector<std::vector<int>>(films, {1, 1}))) << "the sixth, in rows of four";
  EXPECT_EQ(browser_->run("return document.querySelector('.strips output').textContent"), "t = 0.05 s");
  browser_->click(".strips .as-sheets");
  EXPECT_EQ(moved(), nlohmann::json(std::vector<std::vector<int>>(films, {0, 0}))) << "all of a sheet is seen";
  expect_sound();
  keep_screenshots("sweep");
}

TEST_F(SweepPage, TellsMomentsApartThatAreMillisecondsApart) {
  put(path("a.toml"), test::tiny_scene);
  SweepRequest request = test::request_of(path("a.toml"), {"cloth.mass=1,2"});
  request.overrides = {"video.fps=50", "video.speed=0.1", "time.duration=0.02", "time.step=0.002"};
  request.films = {"gif"};
  const std::string page = sweep_page(test::sweep(request, {.folder = path("out"), .shard = {}}), path("out"));
  EXPECT_NE(page.find("t = 0.002 s"), std::string::npos);
  EXPECT_NE(page.find("t = 0.004 s"), std::string::npos);
}

TEST_F(SweepPage, SortsItsFigures) {
  open(page());
  const nlohmann::json before = column(1);
  EXPECT_EQ(before.front(), "10");
  browser_->click(".sortable th:nth-child(2) button");
  EXPECT_EQ(column(1).front(), "10");
  browser_->click(".sortable th:nth-child(2) button");
  EXPECT_EQ(column(1).front(), "2000");
  EXPECT_EQ(browser_->run("return document.querySelector('.sortable th:nth-child(2)').ariaSort"), "descending");
  browser_->click(".sortable th:nth-child(1) button");
  EXPECT_EQ(column(1), before);
}

TEST_F(SweepPage, OpensOneOfManyRuns) {
  open(page());
  const auto seen = [&](const std::string& selector) -> std::string {
    return browser_->run("return [...document.querySelectorAll('" + selector +
                         "')].filter((e) => e.checkVisibility()).map((e) => e.textContent).join()");
  };
  EXPECT_EQ(seen(".filters button"), "all 8,completed 6,refused 2");
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.filters input').length"), 1);
  browser_->click(".filters button:nth-child(3)");
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('.list tbody tr')].filter((r) => !r.hidden).length"),
            2);
  browser_->click(".filters button:nth-child(2)");
  follow(".list tbody tr:not([hidden]) a");
  EXPECT_EQ(seen(".list table"), "");
  EXPECT_EQ(seen(".entry h3").substr(0, 24), "1: cloth.stiffness = 10,") << seen(".entry h3");
  const std::string command = seen(".entry .command code");
  EXPECT_TRUE(command.starts_with("drape render ")) << command;
  EXPECT_TRUE(
      command.ends_with(" --set video.fps=50 --set video.speed=0.5 --set cloth.stiffness=10 --set cloth.mass=1 "
                        "--set integrator.method=implicit -o film.gif"))
      << command;
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('.entry .poster img')].filter((e) => "
                          "e.checkVisibility() && e.naturalWidth > 1).length"),
            1);
  EXPECT_NE(seen(".entry .facts").find("methodimplicit"), std::string::npos) << seen(".entry .facts");
  EXPECT_EQ(seen("#figures ~ .note"), "") << "notes about the table";
  keep_screenshots("sweep-run");
}

TEST_F(SweepPage, DrawsAnyFigureOverAnyKey) {
  open(page());
  const char* seen =
      "return [...document.querySelectorAll('.choice')].filter((c) => c.checkVisibility())"
      ".map((c) => c.querySelector('figcaption').textContent)";
  EXPECT_EQ(browser_->run(seen).size(), 1U);
  EXPECT_TRUE(
      browser_->run("const at = (s) => document.querySelector(s).getBoundingClientRect();"
                    "return at('.choice-lists').bottom <= at('.choice figure').top"))
      << "the diagram is below what chooses it";
  browser_->run(
      "const list = document.querySelectorAll('.chooser select')[1]; list.value = '2';"
      "list.dispatchEvent(new Event('change'))");
  ASSERT_EQ(browser_->run(seen).size(), 1U);
  EXPECT_NE(browser_->run(seen).front().get<std::string>().find("over integrator.method"), std::string::npos);
}

}  // namespace
}  // namespace drape
