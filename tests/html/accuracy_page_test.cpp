#include <gtest/gtest.h>

#include "study/accuracy_report.hpp"
#include "tests/html/html_page.hpp"

namespace drape {
namespace {

/// Returns the smallest GIF: one transparent pixel.
std::string one_pixel() {
  const unsigned char bytes[] =
      "GIF89a\1\0\1\0\x80\0\0\0\0\0\xff\xff\xff!\xf9\4\1\0\0\0\0,\0\0\0\0\1\0\1\0\0\2\2D\1\0;";
  return {reinterpret_cast<const char*>(bytes), sizeof bytes - 1};
}

class AccuracyPage : public test::InBrowser {
 protected:
  /// Returns the page of a short study of a small cloth.
  std::string page() {
    const auto file = path("small.toml");
    put(file,
        "[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 20\npins = [\"corner:x-y-\"]\n[time]\nstep = 0.02\nduration = "
        "1\n[integrator]\nmethod = \"liu13\"\ntolerance = 1e-3\n[effects.gravity]\n");
    AccuracyOptions options;
    options.methods = {Method::liu13, Method::quasi_newton};
    options.tolerances = {1e-2, 1e-4, 1e-6};
    options.times = {0.1, 0.2};
    options.accuracies = {1e-2, 1e-3};
    options.runs = 6;
    Progress progress;
    const auto study = study_accuracy("small", file, options, {}, progress);
    const StudyPicture picture{"small.gif", one_pixel(), "Side by side.", "drape study accuracy small.toml"};
    return to_page(accuracy_report(
        {.command = "drape study accuracy small.toml", .scenes = {*study}, .pictures = {{picture}}, .seconds = 1}));
  }
};

TEST_F(AccuracyPage, IsSound) {
  open(page());
  expect_sound();
  EXPECT_EQ(browser_->run("return document.images.length"), 1);
  EXPECT_EQ(browser_->run("return document.querySelectorAll('.chart').length"), 9);
  keep_screenshots("accuracy");
}

TEST_F(AccuracyPage, HoveringAPointShowsItsCommands) {
  open(page());
  browser_->point_at(".series.s3 [data-label^='quasi-newton, ε'] .sign");
  const std::string tip = browser_->run("return document.getElementById('tip').textContent");
  EXPECT_TRUE(tip.starts_with("quasi-newton, ε = ")) << tip;
  EXPECT_NE(tip.find("--methods quasi-newton"), std::string::npos) << tip;
  EXPECT_NE(tip.find("\ndrape render "), std::string::npos) << tip;
}

}  // namespace
}  // namespace drape
