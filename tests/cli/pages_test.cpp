// Form of the pages: their folders, links, length, first paragraphs, translations and Chinese punctuation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/documents.hpp"
#include "tests/support/files.hpp"

namespace drape::cli {
namespace {

namespace fs = std::filesystem;
using test::Block;

const fs::path source = DRAPE_SOURCE_DIR;

bool is_chinese(const fs::path& page) { return page.string().ends_with(".zh-CN.md"); }

/// Returns the English page of a translation, or the page itself.
fs::path english_of(const fs::path& page) {
  return is_chinese(page) ? fs::path(page).replace_extension().replace_extension(".md") : page;
}

/// Returns a page without its fenced blocks and its comments, which may have several lines.
std::string prose_of(const fs::path& page) {
  std::istringstream lines(test::content(page));
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) inside = !inside;
    if (!inside && !line.starts_with("```")) text += line + "\n";
  }
  for (std::size_t at = 0; (at = text.find("<!--", at)) != std::string::npos;) {
    text.erase(at, std::min(text.find("-->", at), text.size()) + 3 - at);
  }
  return text;
}

/// Returns the targets of a page's links and pictures.
std::vector<std::string> targets_of(const fs::path& page) {
  const std::string text = prose_of(page);
  std::vector<std::string> targets;
  for (std::size_t at = 0; (at = text.find("](", at)) != std::string::npos; ++at) {
    targets.push_back(text.substr(at + 2, text.find(')', at) - at - 2));
  }
  return targets;
}

/// Returns the anchor that GitHub and mkdocs give to a heading in ASCII.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::istringstream lines(prose_of(page));
  std::set<std::string> anchors;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t level = line.find_first_not_of('#');
    if (level != std::string::npos && level > 0 && line[level] == ' ')
      anchors.insert(anchor_of(line.substr(level + 1)));
  }
  return anchors;
}

TEST(Pages, HaveLinksThatLeadSomewhere) {
  auto pages = test::pages_of(source);
  for (const char* other : {"ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "bench/README.md"})
    pages.emplace_back(other);
  for (const fs::path& page : pages) {
    for (const std::string& link : targets_of(source / page)) {
      if (link.find(':') != std::string::npos) continue;
      const std::size_t hash = std::min(link.find('#'), link.size());
      const fs::path target = hash == 0 ? source / page : (source / page).parent_path() / link.substr(0, hash);
      EXPECT_TRUE(fs::exists(target)) << page << ": " << link;
      if (hash == link.size() || target.extension() != ".md" || is_chinese(target)) continue;
      EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1))) << page << ": " << link;
    }
  }
}

TEST(Pages, AreAllListed) {
  std::set<fs::path> listed;
  for (const char* index : {"docs/README.md", "docs/cookbook/README.md"}) {
    for (const std::string& link : targets_of(source / index)) {
      listed.insert((fs::path(index).parent_path() / link).lexically_normal());
    }
  }
  for (const fs::path& page : test::pages_of(source)) {
    if (page.has_parent_path() && page != "docs/README.md") {
      EXPECT_TRUE(listed.contains(page)) << page;
    }
  }
}

// The page and its summary are made by script/validation-page.
TEST(Pages, ShowEveryCaseWithAKnownAnswer) {
  const std::string page = test::content(source / "docs/notes/validation.md");
  std::size_t cases = 0;
  for (const auto& entry : fs::directory_iterator(source / "scenes/validation")) {
    if (!fs::exists(entry.path() / "case.json")) continue;
    const std::string name = entry.path().filename().string();
    EXPECT_NE(page.find("](../images/validation/" + name + ".svg)"), std::string::npos) << name;
    ++cases;
  }
  const std::string summary = test::content(source / "docs/images/validation/summary.svg");
  const std::size_t first = summary.find("class=\"series s0\""), last = summary.find("class=\"series s1\"");
  ASSERT_LT(first, last);
  std::size_t points = 0;
  for (std::size_t at = first; (at = summary.find("class=\"point\"", at)) < last; ++at) ++points;
  EXPECT_EQ(points, cases) << "of the scenes as they are";
}

TEST(Pages, HaveAtMost25000WordsInAll) {
  std::size_t words = 0;
  for (const fs::path& page : test::pages_of(source)) {
    if (is_chinese(page)) continue;
    std::istringstream text(test::content(source / page));
    for (std::string word; text >> word;) {  // not the bars of a table, the brackets of code and the like
      words += std::ranges::any_of(word, [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80; }) ? 1U : 0U;
    }
  }
  EXPECT_LE(words, 25000U);
  EXPECT_GE(words, 10000U);
}

// A page begins with its title and a paragraph, before any list, table, block or picture.
TEST(Pages, BeginWithAnAnswer) {
  for (const fs::path& page : test::pages_of(source)) {
    std::istringstream lines(test::content(source / page));
    std::string title, empty, first;
    std::getline(lines, title);
    std::getline(lines, empty);
    std::getline(lines, first);
    EXPECT_TRUE(title.starts_with("# ")) << page;
    EXPECT_EQ(empty, "") << page;
    EXPECT_FALSE(first.empty()) << page;
    for (const char* other : {"|", "- ", "!", "<", "```", "1", "#", ">", "["}) {
      EXPECT_FALSE(first.starts_with(other)) << page << ": " << first;
    }
  }
}

/// Returns the parts that two languages of a page must share: levels of headings, commands, quoted output, code, links
/// and pictures.
std::string skeleton(const fs::path& page) {
  std::string text;
  for (const Block& block : test::blocks_of(page)) {
    text += "```" + block.language + " " + block.file + " " + block.test + "\n";
    for (const std::string& line : block.lines) {
      if (line.find("\\caption") == std::string::npos) {
        const std::string code = line.substr(0, line.find("  #"));
        text += code.substr(0, code.find_last_not_of(' ') + 1) + "\n";
      }
    }
  }
  std::istringstream lines(test::content(page));
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) inside = !inside;
    if (inside) continue;
    const std::size_t level = line.find_first_not_of('#');
    const std::size_t digits = line.find_first_not_of("0123456789.", level == std::string::npos ? 0 : level + 1);
    if (level != std::string::npos && level > 0 && line[level] == ' ') text += line.substr(0, digits) + "\n";
    for (std::size_t at = 0; (at = line.find("](", at)) != std::string::npos; ++at) {
      // A page links to its other language, and to other pages in its own.
      std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
      if (const std::size_t chinese = target.find(".zh-CN"); chinese != std::string::npos) target.erase(chinese, 6);
      if (fs::path(target).filename() != english_of(page).filename()) text += target + "\n";
    }
  }
  return text;
}

TEST(Translations, HaveTheSameHeadingsCommandsAndLinks) {
  std::set<fs::path> translated;
  for (const fs::path& page : test::pages_of(source)) {
    if (!is_chinese(page)) continue;
    translated.insert(english_of(page));
    EXPECT_EQ(skeleton(source / english_of(page)), skeleton(source / page)) << page;
  }
  EXPECT_TRUE(translated.contains("README.md"));
  for (const fs::path& page : test::pages_of(source)) {
    if (page.parent_path() == "docs/start" && !is_chinese(page)) {
      EXPECT_TRUE(translated.contains(page)) << page;
    }
  }
}

/// Returns true for the bytes of a Chinese character (U+3400 to U+9FFF), which begin with these in UTF-8.
bool is_han(const std::string& text, std::size_t at) {
  if (at + 2 >= text.size()) return false;
  const auto first = static_cast<unsigned char>(text[at]), second = static_cast<unsigned char>(text[at + 1]);
  return (first == 0xE3 && second >= 0x90) || (first >= 0xE4 && first <= 0xE9);
}

/// Returns the text without code, links' targets and HTML, in which punctuation is that of another language.
std::string without_markup(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::string end = text[at] == '`' ? "`" : text.compare(at, 2, "](") == 0 ? ")" : text[at] == '<' ? ">" : "";
    if (end.empty()) {
      kept += text[at];
    } else {
      at = std::min(text.find(end, at + 1), text.size());
      kept += "\x01";
    }
  }
  return kept;
}

/// Returns the places in a Chinese text with punctuation of half width beside a Chinese character, or with a line break
/// that is shown as a space.
std::vector<std::string> half_width_in(const std::string& markdown) {
  const std::string text = without_markup(markdown);
  std::vector<std::string> found;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool after_han = at >= 3 && is_han(text, at - 3), before_han = is_han(text, at + 1);
    const bool punctuation = std::string(",.:;?!()").find(text[at]) != std::string::npos;
    const bool spaced = at + 1 < text.size() && text[at + 1] == ' ' && is_han(text, at + 2);
    const bool broken = text[at] == '\n' && before_han && at > 0 && text[at - 1] != '\n' && text[at - 1] != '|';
    if ((punctuation && (after_han || before_han || (spaced && text[at] != '.'))) || broken) {
      found.push_back(text.substr(at < 30 ? 0 : at - 30, 60));
    }
  }
  return found;
}

TEST(Translations, HaveTheFullWidthPunctuationOfTheirLanguage) {
  for (const fs::path& page : test::pages_of(source)) {
    if (!is_chinese(page)) continue;
    for (const std::string& place : half_width_in(prose_of(source / page))) ADD_FAILURE() << page << ": " << place;
  }
}

TEST(Translations, AreFoundWithHalfWidthPunctuation) {
  EXPECT_EQ(half_width_in("模拟布料，并生成动画（逐位相同）。\n\n渲染：`drape render, x`").size(), 0U);
  EXPECT_EQ(half_width_in("## 1. 场景\n\n版本 3.0 和 [教程](a,b.md)。").size(), 0U);
  for (const char* wrong : {"布料,并", "布料, 并", "如下:", "(布)", "布?", "第一行。\n第二行", "drape, 布"}) {
    EXPECT_GE(half_width_in(wrong).size(), 1U) << wrong;
  }
}

}  // namespace
}  // namespace drape::cli
