#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/support/browser.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {

/// Opens pages in a headless Chromium shared by all tests of a process; skipped without one. Screenshots for inspection
/// go to the folder DRAPE_SCREENSHOTS.
class InBrowser : public InScratchFolder {
 protected:
  void SetUp() override {
    if (const std::string why = Browser::missing(); !why.empty()) GTEST_SKIP() << why;
    static Browser browser;
    browser.open_tab();
    browser_ = &browser;
  }

  void open(const std::string& content, const std::string& name = "page.html") {
    put(path(name), content);
    browser_->set_width(1200);
    browser_->open(path(name));
  }

  /// Waits until an expression of the page is true, for at most a minute.
  void wait_for(const std::string& condition) {
    for (int i = 0; i < 600; ++i) {
      if (browser_->run("return Boolean(" + condition + ")").get<bool>()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    FAIL() << condition << ": " << browser_->run("return document.body.innerText").get<std::string>();
  }

  /// Follows a link within the page, and waits until the page has heard of it.
  void follow(const std::string& selector) {
    browser_->run(
        "window.followed = false; addEventListener('hashchange', () => window.followed = true, {once: true})");
    browser_->click(selector);
    wait_for("window.followed");
  }

  /// Checks the requirements of every page: an empty console, no requests, all pictures loaded, every control named, no
  /// sideways scrolling at any width.
  void expect_sound() {
    EXPECT_EQ(browser_->console_problems(), std::vector<std::string>());
    EXPECT_EQ(browser_->requests(), std::vector<std::string>());
    EXPECT_EQ(browser_->run("return [...document.images].filter((i) => !i.complete || !i.naturalWidth).length"), 0);
    EXPECT_EQ(browser_->run("return [...document.images].filter((i) => i.decoding === 'async').length"), 0)
        << "a picture that is decoded later is white on a page that is looked at at once";
    EXPECT_EQ(browser_->run("return [...document.images].filter((i) => !i.alt).length"), 0);
    EXPECT_EQ(browser_->run("return [...document.querySelectorAll('input, button')].filter((i) => "
                            "!i.closest('label') && !i.ariaLabel && !i.textContent).length"),
              0);
    EXPECT_EQ(browser_->run("const ids = [...document.querySelectorAll('[id]')].map((e) => e.id);"
                            "return ids.length - new Set(ids).size"),
              0);
    for (const int width : {360, 1200}) {
      browser_->set_width(width);
      EXPECT_LE(browser_->run("return document.documentElement.scrollWidth").get<int>(), width);
    }
  }

  /// Saves screenshots of the current page: narrow and wide, light and dark, and on paper.
  void keep_screenshots(const std::string& name) {
    const char* folder = std::getenv("DRAPE_SCREENSHOTS");
    if (folder == nullptr) return;
    for (const bool dark : {false, true}) {
      browser_->set_theme(dark);
      for (const int width : {390, 1200}) {
        browser_->set_width(width);
        browser_->save_screenshot(std::filesystem::path(folder) /
                                  (name + (dark ? "-dark-" : "-light-") + std::to_string(width) + ".png"));
      }
    }
    browser_->set_print(false);
    browser_->set_width(paper_width);
    browser_->save_screenshot(std::filesystem::path(folder) / (name + "-paper.png"));
    browser_->set_theme(false);
  }

  static constexpr int paper_width = 688;  // between the margins of A4 [CSS pixels]

  Browser* browser_ = nullptr;
};

}  // namespace drape::test
