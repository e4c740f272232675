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
  // Debian's programs, as on a machine of a reader: others of the same name may stand in front of them.
  std::string script =
      "PATH='" + fs::path(DRAPE_EXECUTABLE).parent_path().string() + "':/usr/bin:/bin:$PATH\nexec 2>&1\n";
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

/// Returns the pages with commands, of one language.
std::vector<std::string> pages() {
  std::vector<std::string> all;
  for (const fs::path& page : test::pages_of(source)) {
    if (page.string().ends_with(".zh-CN.md")) continue;  // pages_test.cpp compares Chinese pages with the English ones
    std::size_t commands = 0;
    for (const Block& block : test::blocks_of(source / page)) commands += test::commands_of(block).size();
    if (commands > 0) all.push_back(page.string());
  }
  return all;
}

class Documents : public testing::TestWithParam<std::string> {};

TEST_P(Documents, CommandsDoWhatIsSaid) { expect_page_true(GetParam(), false); }

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = fs::path(info.param).replace_extension().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Documents, testing::ValuesIn(pages()), test_name);

class LongDocuments : public Documents {};
TEST_P(LongDocuments, CommandsDoWhatIsSaid) { expect_page_true(GetParam(), true); }
INSTANTIATE_TEST_SUITE_P(Nightly, LongDocuments, testing::ValuesIn(pages()), test_name);

TEST(Quotes, StandForAnythingWhereTheyHaveDots) {
  EXPECT_TRUE(test::is_as_quoted("100 steps, … each", "100 steps, 3.2 iterations each"));
  EXPECT_TRUE(test::is_as_quoted("a … b …", "a 1 b 2"));
  EXPECT_FALSE(test::is_as_quoted("a … b …", "a 1 c 2"));
  EXPECT_FALSE(test::is_as_quoted("a b", "a b c"));
  EXPECT_TRUE(test::are_as_quoted({"…", "end"}, {"one", "two", "end"}));
  EXPECT_FALSE(test::are_as_quoted({"one", "end"}, {"one", "two", "end"}));
  EXPECT_FALSE(test::are_as_quoted({"…", "end"}, {"one"}));
}

}  // namespace
}  // namespace drape::cli
