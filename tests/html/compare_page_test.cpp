#include <gtest/gtest.h>

#include "compare/page.hpp"
#include "output/png_encoder.hpp"
#include "tests/html/html_page.hpp"

namespace drape {
namespace {

class ComparePage : public test::InBrowser {
 protected:
  static std::string page(const std::vector<std::string>& methods = {"liu13", "liu13"}, std::size_t poster = 0) {
    CompareResult result;
    std::vector<PageMoment> moments;
    for (const char* label : {"liu13, tolerance = 0.001", "implicit <exact>"}) {
      result.motions.push_back({label, {}, {}, {}, {}, {}, methods[result.motions.size()]});
    }
    result.differences = {{"integrator.method", {"liu13", "implicit"}}};
    for (int k = 0; k < 4; ++k) {
      result.times.push_back(0.1 * k);
      moments.push_back({0.1 * k, {}});
      for (ComparedMotion& motion : result.motions) {
        motion.total_energy.push_back(-k);
        motion.most.emplace_back(0.02 * k);
        motion.mean.emplace_back(0.01 * k);
        Image image(480, 400);
        std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(60 * k));
        moments.back().pictures.push_back(encode_png(image));
      }
    }
    return comparison_page(result, moments, poster, encode_png(Image(700, 60)), "drape compare a.toml b.toml");
  }

  /// Returns the moments of the visible pictures.
  nlohmann::json shown() {
    return browser_->run(
        "return [...document.querySelectorAll('.shown-moment')].filter((m) => m.checkVisibility())"
        ".map((m) => m.dataset.moment)");
  }
};

TEST_F(ComparePage, ShowsOneMomentOfAllMotions) {
  open(page());
  expect_sound();
  EXPECT_EQ(browser_->run("return document.querySelector('h1').textContent"),
            "implicit <exact> is up to 60 mm from liu13, tolerance = 0.001");
  EXPECT_EQ(shown(), (nlohmann::json{"0", "0"}));
  browser_->run("document.querySelector('.film input').focus()");
  browser_->press(test::Browser::arrow_right);
  EXPECT_EQ(shown(), (nlohmann::json{"1", "1"}));
  EXPECT_EQ(browser_->run("return document.querySelector('.film output').textContent"), "t = 0.10 s");
  keep_screenshots("compare");
}

TEST_F(ComparePage, ShowsItsPosterUntilItIsPlayedFromTheStart) {
  const auto chosen = [&] { return browser_->run("return document.querySelector('.film input').value"); };
  open(page({"liu13", "liu13"}, 2));
  expect_sound();
  EXPECT_EQ(shown(), (nlohmann::json{"2", "2"}));
  EXPECT_EQ(chosen(), "2");
  EXPECT_EQ(browser_->run("return document.querySelector('.film output').textContent"), "t = 0.20 s");
  // A tick of the interval of playing shows the first moment.
  browser_->run(
      "window.tick = null; const set = window.setInterval; window.setInterval = (f) => (window.tick = f, 1);"
      "document.querySelector('.film .play').click(); window.setInterval = set; window.tick()");
  EXPECT_EQ(shown(), (nlohmann::json{"0", "0"}));
  browser_->run("window.tick()");
  EXPECT_EQ(shown(), (nlohmann::json{"1", "1"}));
}

// As on the pages of studies: see method_series().
TEST_F(ComparePage, GivesMotionsTheColoursOfTheirMethods) {
  const auto colours = [&] {
    return browser_->run(
        "return [...document.querySelector('.chart').querySelectorAll('.series')].map((s) => s.classList[1])");
  };
  open(page({"quasi-newton", "implicit"}));
  EXPECT_EQ(colours(), (nlohmann::json{"s3", "s1"}));
  open(page());
  EXPECT_EQ(colours(), (nlohmann::json{"s0", "s1"})) << "one method does not tell motions apart";
}

TEST_F(ComparePage, PlaysAndPauses) {
  open(page());
  browser_->click(".film .play");
  EXPECT_EQ(browser_->run("return document.querySelector('.film .play').textContent"), "Pause");
  browser_->click(".film .play");
  EXPECT_EQ(browser_->run("return document.querySelector('.film .play').textContent"), "Play");
  const auto moments = shown();
  EXPECT_EQ(moments.at(0), moments.at(1));
}

TEST_F(ComparePage, SaysInWhatTheMotionsDiffer) {
  open(page());
  EXPECT_EQ(
      browser_->run("return [...document.querySelectorAll('#differences ~ .table td')].map((c) => c.textContent)"),
      (nlohmann::json{"integrator.method", "liu13", "implicit"}));
  EXPECT_EQ(browser_->run("return document.querySelector('.film figure:nth-child(2) figcaption').textContent"),
            "implicit <exact>");
  // In a wide window the motions are side by side; otherwise one below the other.
  const char* tops = "return [...document.querySelectorAll('.film figure')].map((f) => f.getBoundingClientRect().top)";
  const auto wide = browser_->run(tops);
  EXPECT_EQ(wide.at(0), wide.at(1));
  browser_->set_width(390);
  const auto narrow = browser_->run(tops);
  EXPECT_LT(narrow.at(0).get<double>(), narrow.at(1).get<double>());
}

}  // namespace
}  // namespace drape
