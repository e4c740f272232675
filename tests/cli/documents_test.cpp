// Runs the commands quoted in the pages, in order, in a folder with a few small scenes.

#include "tests/cli/documents.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::cli {
namespace {

namespace fs = std::filesystem;
using test::Block;
using test::QuotedCommand;

const fs::path source = DRAPE_SOURCE_DIR;

/// Writes the files named by the pages' commands.
void write_files(const test::SceneFolder& folder) {
  std::string small = test::swinging_scene + "[video]\nsize = [64, 48]\n";
  small.replace(small.find("step = 0.02"), 11, "step = 0.01");  // stable for the explicit methods
  for (const char* name :
       {"scene.toml", "a.toml", "cloth.toml", "my.toml", "new.toml", "other.toml", "scenes/flag.toml"})
    folder.write(name, small);
  folder.write("b.toml", small + "[effects.damping]\nfactor = 0.2\n");
  folder.write("look.toml", small + "[look]\nmesh_lines = true\n");
  folder.write("plan.toml", "[sweep]\nscenes = [\"cloth.toml\"]\n[sweep.vary]\n\"cloth.stiffness\" = \"10..40/2\"\n");
  fs::create_directory_symlink(source / "scenes/homework", folder.path() / "scenes/homework");
}

/// Runs commands in one shell, so that each starts where the previous one ended.
/// @returns the output of each, with its exit code in the last line
std::vector<std::vector<std::string>> outputs_of(const test::SceneFolder& folder,
                                                 const std::vector<QuotedCommand>& all) {
  std::string script = "PATH='" + fs::path(DRAPE_EXECUTABLE).parent_path().string() + "':$PATH\nexec 2>&1\n";
  for (const QuotedCommand& command : all) script += command.command + "\necho \"@@ $?\"\n";
  folder.write("commands.sh", script);
  std::istringstream text(test::run_shell(folder, "bash commands.sh </dev/null").text);
  std::vector<std::vector<std::string>> outputs(1);
  for (std::string line; std::getline(text, line);) {
    static const std::regex progress("[a-z ]+ [0-9]+/[0-9]+ [a-z]+(  .* left)?");  // of long commands on a busy machine
    if (std::regex_match(line, progress)) continue;
    const std::size_t end = line.find("@@ ");
    if (end != 0) outputs.back().push_back(line);
    if (end == std::string::npos) continue;
    if (end != 0) outputs.back().back().resize(end);
    outputs.back().push_back(line.substr(end + 3));
    outputs.emplace_back();
  }
  outputs.resize(all.size());
  return outputs;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void expect_page_true(const std::string& page, bool nightly) {
  const test::SceneFolder folder;
  write_files(folder);
  std::vector<QuotedCommand> all;
  for (const Block& block : test::blocks_of(source / page)) {
    if (block.test.starts_with("skip") || (block.test == "nightly" && !nightly)) continue;
    for (const QuotedCommand& command : test::commands_of(block)) all.push_back(command);
    if (block.file.empty()) continue;
    all.push_back(
        {"cat >" + block.file + " <<'END OF FILE'\n" + joined(block.lines) + "END OF FILE", {}, 0, block.line});
  }
  const auto outputs = outputs_of(folder, all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> output = outputs[i];
    ASSERT_FALSE(output.empty()) << page << ":" << all[i].line;
    const std::string code = output.back();
    output.pop_back();
    EXPECT_EQ(code, std::to_string(all[i].code)) << page << ":" << all[i].line << ": " << joined(output);
    if (all[i].output.empty()) continue;
    EXPECT_TRUE(test::are_as_quoted(all[i].output, output))
        << page << ":" << all[i].line << ": " << all[i].command << " says\n"
        << joined(output) << "and the page\n"
        << joined(all[i].output);
  }
}

std::vector<std::string> pages() {
  std::vector<std::string> all{"README.md"};
  for (const auto& entry : fs::directory_iterator(source / "docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name.ends_with(".zh-CN.md")) continue;  // Chinese pages are compared below
    std::size_t commands = 0;
    for (const Block& block : test::blocks_of(entry.path())) commands += test::commands_of(block).size();
    if (commands > 0) all.push_back("docs/" + name);
  }
  std::sort(all.begin(), all.end());
  return all;
}

class Documents : public testing::TestWithParam<std::string> {};

TEST_P(Documents, CommandsDoWhatIsSaid) { expect_page_true(GetParam(), false); }

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = fs::path(info.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Documents, testing::ValuesIn(pages()), test_name);

class LongDocuments : public Documents {};
TEST_P(LongDocuments, CommandsDoWhatIsSaid) { expect_page_true(GetParam(), true); }
INSTANTIATE_TEST_SUITE_P(Nightly, LongDocuments, testing::ValuesIn(pages()), test_name);

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
      const std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
      // A page links to its other language, and to other pages in its own.
      if (target.find("README") == std::string::npos && target.find("tutorial") == std::string::npos)
        text += target + "\n";
    }
  }
  return text;
}

TEST(Translations, HaveTheSameHeadingsCommandsAndLinks) {
  for (const char* page : {"README", "docs/tutorial"}) {
    EXPECT_EQ(skeleton(source / (std::string(page) + ".md")), skeleton(source / (std::string(page) + ".zh-CN.md")))
        << page;
  }
}

TEST(Quotes, StandForAnythingWhereTheyHaveDots) {
  EXPECT_TRUE(test::is_as_quoted("100 steps, … each", "100 steps, 3.2 iterations each"));
  EXPECT_TRUE(test::is_as_quoted("a … b …", "a 1 b 2"));
  EXPECT_FALSE(test::is_as_quoted("a … b …", "a 1 c 2"));
  EXPECT_FALSE(test::is_as_quoted("a b", "a b c"));
  EXPECT_TRUE(test::are_as_quoted({"…", "end"}, {"one", "two", "end"}));
  EXPECT_FALSE(test::are_as_quoted({"one", "end"}, {"one", "two", "end"}));
  EXPECT_FALSE(test::are_as_quoted({"…", "end"}, {"one"}));
}

/// Relative links of a page, except those into a page, have targets.
TEST(Links, LeadSomewhere) {
  for (const auto& folder : {source, source / "docs", source / "bench"}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".md") continue;
      const std::string text = test::content(entry.path());
      for (std::size_t at = 0; (at = text.find("](", at)) != std::string::npos; ++at) {
        const std::string target = text.substr(at + 2, text.find_first_of("#)", at + 2) - at - 2);
        if (target.empty() || target.find(':') != std::string::npos) continue;
        EXPECT_TRUE(fs::exists(folder / target)) << entry.path() << ": " << target;
      }
    }
  }
}

}  // namespace
}  // namespace drape::cli
