#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "tests/html/html_page.hpp"
#include "tests/support/files.hpp"

// The site built by script/docs: all links have targets, and all pages fit their window without the network.

namespace drape {
namespace {

namespace fs = std::filesystem;

/// The site as script/docs builds it.
struct BuiltSite : test::ScratchFolder {
  BuiltSite() : ScratchFolder("-built") {
    const std::string command = std::string(DRAPE_SOURCE_DIR "/site/collect.py '") + path("site-pages") +
                                "' && /usr/bin/mkdocs build --quiet --strict --config-file '" +
                                path("site-mkdocs.yml") + "' >'" + path("log") + "' 2>&1";
    if (std::system(command.c_str()) != 0) {
      problem = "it is not built: " + test::content(path("log"));
      return;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path("site"))) {
      if (entry.path().extension() == ".html" && entry.path().filename() != "404.html") pages.push_back(entry.path());
    }
  }

  std::string problem;
  std::vector<fs::path> pages;
};

/// Tests of the site, built once for all tests of a process; skipped without mkdocs or its theme.
class Site : public test::InBrowser {
 protected:
  void SetUp() override {
    if (access("/usr/bin/mkdocs", X_OK) != 0 || !fs::exists("/usr/share/mkdocs/themes/material")) {
      GTEST_SKIP() << "no mkdocs: apt-get install --no-install-recommends mkdocs mkdocs-material";
    }
    InBrowser::SetUp();
    static const BuiltSite site;
    ASSERT_EQ(site.problem, "");
    ASSERT_GT(site.pages.size(), 25U);
    site_ = &site;
  }

  void keep_screenshot(const std::string& name) {
    if (const char* folder = std::getenv("DRAPE_SCREENSHOTS")) {
      browser_->save_screenshot(fs::path(folder) / (name + ".png"));
    }
  }

  const BuiltSite* site_ = nullptr;
};

std::string unescaped(std::string text) {
  for (const auto& [from, to] : {std::pair("&amp;", "&"), std::pair("%20", " ")}) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; ++at) {
      text.replace(at, std::string_view(from).size(), to);
    }
  }
  return text;
}

/// Returns the values of attributes anywhere in a page.
std::set<std::string> attributes(const std::string& page, const std::string& names) {
  std::set<std::string> values;
  const std::regex pattern("\\s(?:" + names + ")=(?:\"([^\"]*)\"|([^\\s\">]+))");
  for (auto at = std::sregex_iterator(page.begin(), page.end(), pattern); at != std::sregex_iterator(); ++at) {
    values.insert(unescaped((*at)[1].matched ? (*at)[1].str() : (*at)[2].str()));
  }
  return values;
}

TEST_F(Site, HasNoLinkThatLeadsNowhere) {
  std::map<fs::path, std::set<std::string>> anchors;
  for (const fs::path& page : site_->pages)
    anchors[page.lexically_normal()] = attributes(test::content(page), "id|name");
  for (const fs::path& page : site_->pages) {
    for (const std::string& link : attributes(test::content(page), "href|src")) {
      if (link.find("://") != std::string::npos || link.starts_with("data:") || link == "." || link == "..") continue;
      const std::size_t hash = std::min(link.find('#'), link.size());
      const std::string file = link.substr(0, hash), anchor = hash < link.size() ? link.substr(hash + 1) : "";
      const fs::path target = (file.empty() ? page : page.parent_path() / file).lexically_normal();
      EXPECT_TRUE(fs::exists(target)) << page << ": " << link;
      if (anchor.empty() || target.extension() != ".html") continue;
      EXPECT_TRUE(anchors[target].contains(anchor)) << page << ": " << link;
    }
  }
}

TEST_F(Site, HasAMenuOfTheFourKindsOfPages) {
  const std::string index = test::content(site_->path("site/index.html"));
  std::size_t at = 0;
  for (const char* entry : {"Start\n", "docs/start/quick-start.html", "Cookbook\n", "docs/cookbook/flag.html",
                            "Reference\n", "docs/reference/scene-format.html", "Notes\n", "docs/notes/accuracy.html"}) {
    at = index.find(entry, at);
    ASSERT_NE(at, std::string::npos) << entry;
  }
}

TEST_F(Site, ShowsEverySceneWithItsFile) {
  const std::string gallery = test::content(site_->path("site/gallery.html"));
  int scenes = 0;
  for (const char* group : {"homework", "showcase"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(DRAPE_SOURCE_DIR "/scenes") / group)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string page = std::string("scenes/") + group + "/" + entry.path().stem().string();
      EXPECT_NE(gallery.find("href=\"" + page + ".html\""), std::string::npos) << page;
      EXPECT_EQ(test::content(site_->path("site/" + page + ".toml")), test::content(entry.path()));
      ++scenes;
    }
  }
  EXPECT_GE(scenes, 18);
}

// Least contrast of a link with the page, see WCAG 2.1, 1.4.3.
constexpr const char* contrast_of_links = R"(
  const light = (color) => {
    const [r, g, b] = color.match(/[0-9.]+/g).slice(0, 3).map((v) => v / 255)
      .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const page = light(getComputedStyle(document.body).backgroundColor);
  return Math.min(...[...document.querySelectorAll("article p a, article li a")].map((a) => {
    const [low, high] = [page, light(getComputedStyle(a).color)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
  }), 21))";

TEST_F(Site, FitsItsWindowWithoutTheNetwork) {
  std::ofstream(path("blank.html")) << "<!DOCTYPE html>";
  for (const char* name :
       {"index", "gallery", "docs/start/quick-start", "docs/cookbook/index", "docs/reference/scene-format",
        "docs/reference/effects", "docs/notes/stability", "scenes/showcase/air"}) {
    for (const bool dark : {false, true}) {
      browser_->set_theme(dark);
      browser_->set_width(1200);
      // Clears the theme stored by another page, from one that stores none: the site's own pages may store it again.
      browser_->open(path("blank.html"));
      browser_->run("localStorage.clear()");
      browser_->open(site_->path(std::string("site/") + name + ".html"));
      for (const int width : {390, 1200}) {
        browser_->set_width(width);
        EXPECT_LE(browser_->run("return document.documentElement.scrollWidth").get<int>(), width) << name;
      }
      browser_->run("document.querySelectorAll('img').forEach((i) => { i.loading = 'eager' })");
      EXPECT_EQ(browser_->run("return [...document.images].filter((i) => i.complete && !i.naturalWidth).length"), 0);
      for (const std::string& address : browser_->requests()) EXPECT_TRUE(address.starts_with("file://")) << address;
      const auto lightness = browser_->run(
          "return Math.max(...getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3))");
      EXPECT_EQ(lightness.get<int>() < 128, dark) << name;
      EXPECT_GE(browser_->run(contrast_of_links).get<double>(), 4.5) << name << (dark ? ", dark" : ", light");
      std::string shown = name;
      std::replace(shown.begin(), shown.end(), '/', '-');
      keep_screenshot("site-" + shown + (dark ? "-dark" : "-light"));
    }
  }
}

}  // namespace
}  // namespace drape
