#include <gtest/gtest.h>

#include <cmath>

#include "check/html_report.hpp"
#include "output/png_encoder.hpp"
#include "tests/html/html_page.hpp"
#include "tests/html/sample_check.hpp"

namespace drape {
namespace {

using test::Browser;

class CheckPage : public test::InBrowser {
 protected:
  /// Returns the visible share of the actual picture beside the slider, in percent from the left.
  double split() {
    return std::stod(browser_
                         ->run("return getComputedStyle(document.querySelector('.moment:not([hidden]) .stage'))"
                               ".getPropertyValue('--split')")
                         .get<std::string>());
  }
  bool is_shown(const std::string& selector) {
    return browser_->run("const e = document.querySelector('.moment:not([hidden]) " + selector +
                         "'); return e.checkVisibility({visibilityProperty: true})");
  }
};

TEST_F(CheckPage, OfARunWhereAllIsWell) {
  open(html_report(test::sample_check(false)));
  expect_sound();
  EXPECT_EQ(browser_->run("return document.querySelector('h1').textContent"), "All 3 scenes are unchanged");
  keep_screenshots("check-passed");
}

// The sample's films move away from their first picture.
TEST_F(CheckPage, BeginsAScenesPicturesWithTheMostTelling) {
  const auto moments = [&] {
    return browser_->run(
        "return [...document.querySelectorAll('.comparison')].map((c) => c.querySelector('.moment:not([hidden])')"
        ".dataset.moment)");
  };
  open(html_report(test::sample_check(false)));
  for (const auto& moment : moments()) EXPECT_NE(moment, "0");
  open(html_report(test::sample_check(true)));
  EXPECT_EQ(moments().at(0), "1") << "the first bad frame of the changed scene";
}

TEST_F(CheckPage, ShowsFailedScenesFirst) {
  open(html_report(test::sample_check(true)));
  expect_sound();
  EXPECT_EQ(browser_->run("return document.querySelector('h1').textContent"), "1 of 3 scenes changed, 1 had no golden");
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('main h2')].map((h) => h.firstChild.textContent)"),
            (nlohmann::json{"5", "new", "4"}));
  EXPECT_EQ(browser_->run("return [...document.querySelectorAll('main h2 .badge')].map((h) => h.textContent)"),
            (nlohmann::json{"changed", "missing", "passed"}));
  const auto commands =
      browser_->run("return [...document.querySelectorAll('.command code')].map((c) => c.textContent)");
  for (const char* line :
       {"drape accept out/check", "drape accept out/check 5", "drape bless scenes/homework/new.toml"}) {
    EXPECT_NE(std::find(commands.begin(), commands.end(), line), commands.end()) << line;
  }
  // Unjudged parts are hatched, and the golden's origin comes first.
  EXPECT_GT(browser_->run("return document.querySelectorAll('main .ignored').length"), 0);
  EXPECT_EQ(browser_->run("return document.querySelector('main .findings li').textContent")
                .get<std::string>()
                .find("The golden was recorded with a different renderer"),
            0u);
  keep_screenshots("check-failed");
}

// A page begins with the golden's origin and omits that finding from the list, but not an error that quotes it.
TEST(CheckPageFindings, AreOmittedByKindAlone) {
  SceneResult scene = test::sample_check(true).scenes.back();
  ASSERT_EQ(scene.findings.back().kind, FindingKind::elsewhere);
  const std::string origin = sentence(scene, scene.findings.back()).substr(1);
  const auto times_shown = [&] {
    const std::string page = scene_content(scene, "scene").html();
    int times = 0;
    for (std::size_t at = page.find(origin); at != std::string::npos; at = page.find(origin, at + 1)) ++times;
    return times;
  };
  EXPECT_EQ(times_shown(), 1);
  scene.findings.push_back({FindingKind::no_candidate, "a text with t" + origin + " in it"});
  EXPECT_EQ(times_shown(), 2);
  scene.findings.clear();
  EXPECT_EQ(times_shown(), 1);
}

TEST_F(CheckPage, SliderMovesByMouseAndByKey) {
  open(html_report(test::sample_check(true)));
  browser_->click(".comparison .views input[value=slider]");
  EXPECT_FALSE(is_shown(".difference"));
  EXPECT_TRUE(is_shown(".split"));
  EXPECT_EQ(split(), 50);
  browser_->run("document.querySelector('.moment:not([hidden]) .split').focus()");
  browser_->press(Browser::arrow_right);
  EXPECT_EQ(split(), 50.5);
  browser_->press(std::string(Browser::arrow_left) + Browser::arrow_left);
  EXPECT_EQ(split(), 49.5);
  browser_->run("const s = document.querySelector('.moment:not([hidden]) .split'); s.value = 10;");
  browser_->click(".moment:not([hidden]) .split");  // in its middle
  EXPECT_NEAR(split(), 50, 1);
  // Left of the line is the expected picture: the actual one is clipped there.
  EXPECT_EQ(
      browser_->run("return getComputedStyle(document.querySelector('.moment:not([hidden]) .actual .frame')).clipPath"),
      browser_->run(
          "return 'inset(0px 0px 0px ' + document.querySelector('.moment:not([hidden]) .split').value + '%)'"));
  browser_->set_width(1200);
  browser_->run("document.querySelector('.comparison').scrollIntoView()");
  keep_screenshots("check-slider");
  EXPECT_EQ(browser_->console_problems(), std::vector<std::string>());
}

TEST_F(CheckPage, KeysChooseViewAndFrame) {
  open(html_report(test::sample_check(true)));
  browser_->run("document.querySelector('.comparison .moments input:checked').focus()");
  const auto shown_moment = [&] {
    return browser_->run("return document.querySelector('.comparison .moment:not([hidden])').dataset.moment");
  };
  EXPECT_EQ(shown_moment(), "1");  // the first frame that changed
  browser_->press(".");
  EXPECT_EQ(shown_moment(), "2");
  browser_->press(",,,");
  EXPECT_EQ(shown_moment(), "3");  // wraps around
  browser_->press(".");
  EXPECT_EQ(shown_moment(), "0");
  browser_->press(Browser::arrow_right);  // as in every group of radio buttons
  EXPECT_EQ(shown_moment(), "1");
  browser_->press("4");
  EXPECT_TRUE(is_shown(".difference"));
  EXPECT_FALSE(is_shown(".expected"));
  browser_->press("5");
  EXPECT_TRUE(is_shown(".error-map"));
  EXPECT_FALSE(is_shown(".difference"));
  browser_->press("1");
  for (const char* view : {".expected", ".actual", ".difference", ".error-map"}) EXPECT_TRUE(is_shown(view)) << view;
}

TEST_F(CheckPage, BlinksUntilItIsStopped) {
  open(html_report(test::sample_check(true)));
  browser_->click(".comparison .views input[value=blink]");
  const std::string wait_for_swap =
      "const root = document.querySelector('.comparison'); const before = root.dataset.phase;"
      "return new Promise((done) => { new MutationObserver(() => done(true))"
      ".observe(root, {attributes: true, attributeFilter: ['data-phase']}); setTimeout(() => done(false), ";
  EXPECT_TRUE(browser_->run(wait_for_swap + "20000); })"));
  // One call, since the pictures may swap between two.
  EXPECT_TRUE(
      browser_->run("const shown = (view) => document.querySelector('.moment:not([hidden]) ' + view)"
                    ".checkVisibility({visibilityProperty: true});"
                    "return shown('.expected') !== shown('.actual')"));
  browser_->click(".comparison .pause");
  EXPECT_FALSE(browser_->run(wait_for_swap + "1500); })"));
  browser_->run("document.querySelector('.comparison').removeAttribute('data-phase')");
  browser_->press("s");
  EXPECT_TRUE(is_shown(".expected"));
  browser_->press("s");
  EXPECT_TRUE(is_shown(".actual"));
}

TEST_F(CheckPage, CurveTellsItsValues) {
  open(html_report(test::sample_check(true)));
  browser_->point_at(".chart > svg .point:nth-of-type(3) .sign");
  EXPECT_TRUE(browser_->run("return !document.getElementById('tip').hidden"));
  EXPECT_NE(browser_->run("return document.getElementById('tip').textContent").get<std::string>().find("step "),
            std::string::npos);
  EXPECT_EQ(
      browser_->run("return [...document.querySelectorAll('td')].filter((c) => /nan/.test(c.textContent)).length"), 0)
      << "a gap in a curve is no row of its table";
}

}  // namespace
}  // namespace drape
