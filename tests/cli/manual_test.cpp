#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

// The manual's pages and the shells' completions are generated from the program's own descriptions, and are complete.

namespace drape::manual_pages {
namespace {

namespace fs = std::filesystem;
using test::drape;
using test::Finished;
using test::run_shell;
using test::SceneFolder;

/// The completions call the program by the name that was typed.
const std::string on_path = "PATH=" + fs::path(DRAPE_EXECUTABLE).parent_path().string() + ":$PATH ";

struct Manual : SceneFolder {
  Manual() {
    const Finished finished = drape(*this, "manual share");
    EXPECT_EQ(finished.code, 0) << finished.text;
  }
  [[nodiscard]] std::string page(const std::string& file) const { return test::content(path("share/man/" + file)); }
  /// Returns bash's completions of a line with the cursor at its end, one word per line.
  [[nodiscard]] std::string completed(const std::string& line) const {
    write("complete.sh",
          ". share/bash-completion/completions/drape\nCOMP_LINE=$1 COMP_POINT=${#1}\n_drape\n"
          "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    return run_shell(*this, on_path + "bash complete.sh '" + line + "'").text;
  }
};

/// Removes the backslashes before dashes.
std::string plain(std::string text) {
  std::erase(text, '\\');
  return text;
}

TEST(Manual, HasAPageForEveryCommandWithEveryOption) {
  const Manual manual;
  const std::string commands = drape(manual, "--help").text;
  const std::regex command("\n  ([a-z]+) "), option("(--[a-z-]+)");
  std::set<std::string> names;
  const std::size_t from = commands.find("\nSubcommands:");
  ASSERT_NE(from, std::string::npos) << commands;
  const std::size_t to = std::min(commands.find("\nExamples:"), commands.size());
  for (std::sregex_iterator at(commands.begin() + static_cast<std::ptrdiff_t>(from),
                               commands.begin() + static_cast<std::ptrdiff_t>(to), command),
       end;
       at != end; ++at) {
    names.insert((*at)[1]);
  }
  EXPECT_TRUE(names.contains("render") && names.contains("doctor") && !names.contains("manual"));
  for (const std::string& name : names) {
    const std::string help = drape(manual, name + " --help").text,
                      page = plain(manual.page("man1/drape-" + name + ".1"));
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at) {
      EXPECT_NE(page.find((*at)[1]), std::string::npos) << name << ": " << (*at)[1];
    }
    EXPECT_NE(manual.page("man1/drape.1").find("drape\\-" + name), std::string::npos) << name;
  }
  EXPECT_NE(plain(manual.page("man1/drape-study-accuracy.1")).find("--tolerances"), std::string::npos);
}

TEST(Manual, HasEveryKeyOfTheSceneFormat) {
  const Manual manual;
  const std::string page = plain(manual.page("man5/drape-scene.5"));
  const std::string reference = test::content(DRAPE_SOURCE_DIR "/docs/reference/scene-format.md");
  const std::string keys = reference.substr(reference.find("<!-- reference: begin -->"));
  const std::regex row("\n- `([a-z_]+)`: ");
  int count = 0;
  for (std::sregex_iterator at(keys.begin(), keys.end(), row), end; at != end; ++at, ++count) {
    EXPECT_NE(page.find("fB" + (*at)[1].str() + "fR = "), std::string::npos) << (*at)[1];
  }
  EXPECT_GT(count, 60);
}

TEST(Manual, IsReadByManWithoutAWarning) {
  const Manual manual;
  if (run_shell(manual, "command -v man").code != 0) GTEST_SKIP() << "no man: apt-get install man-db";
  const Finished finished = run_shell(manual,
                                      "for page in share/man/man*/*; do LC_ALL=C.UTF-8 MANWIDTH=100 "
                                      "man --warnings -l $page 2>&1 >/dev/null; done");
  EXPECT_EQ(finished.text, "");
}

TEST(Completion, OffersCommandsOptionsKeysAndValuesInBash) {
  const Manual manual;
  EXPECT_EQ(manual.completed("drape ren"), "render\n");
  EXPECT_EQ(manual.completed("drape study sc"), "scaling\n");
  EXPECT_EQ(manual.completed("drape render --max"), "--max-size\n");
  EXPECT_EQ(manual.completed("drape new fl"), "flag\n");
  EXPECT_EQ(manual.completed("drape watch a.toml --quality d"), "draft\n");
  EXPECT_EQ(manual.completed("drape render a.toml --backend os"), "osmesa\n");
  EXPECT_EQ(manual.completed("drape render a.toml --set effects.gravity.acc"), "effects.gravity.acceleration=\n");
  // If = ends a word, as in an unconfigured bash, a completion contains only the text after it.
  EXPECT_EQ(manual.completed("drape render a.toml --set integrator.method=li"), "liu13\n");
  EXPECT_EQ(manual.completed("drape compare a.toml --vary look.shadows="), "true\nfalse\n");
}

TEST(Completion, OffersSceneFilesInBash) {
  const Manual manual;
  manual.write("cloth.toml", "");
  manual.write("clothes.txt", "");
  fs::create_directory(manual.path("closet"));
  EXPECT_EQ(manual.completed("drape render cl"), "closet/\ncloth.toml\n");
}

TEST(Completion, IsRightFish) {
  const Manual manual;
  if (run_shell(manual, "command -v fish").code != 0) GTEST_SKIP() << "no fish: apt-get install fish";
  const auto offered = [&](const std::string& line) {
    return run_shell(
               manual,
               on_path +
                   "HOME=$PWD fish --no-config -c 'source share/fish/vendor_completions.d/drape.fish; complete -C \"" +
                   line + "\"'")
        .text;
  };
  EXPECT_TRUE(offered("drape ren").starts_with("render\t")) << offered("drape ren");
  EXPECT_TRUE(offered("drape render --set integrator.method=li").starts_with("integrator.method=liu13"));
  EXPECT_TRUE(offered("drape render --backend os").starts_with("osmesa"));
}

TEST(Completion, IsRightZsh) {
  const Manual manual;
  if (run_shell(manual, "command -v zsh").code != 0) GTEST_SKIP() << "no zsh: apt-get install zsh";
  EXPECT_EQ(run_shell(manual, "zsh -n share/zsh/vendor-completions/_drape").text, "");
}

// dpkg-shlibdeps does not see libraries opened by name at first use.
TEST(Package, DependsOnEveryLibraryThatIsLoadedAtRunTime) {
  const SceneFolder folder;
  if (run_shell(folder, "command -v dpkg-query").code != 0) GTEST_SKIP() << "not a Debian system";
  const std::string lists = test::content(DRAPE_SOURCE_DIR "/cmake/Debian.cmake");
  const std::regex library("\"(lib[^\"/ ]*\\.so\\.[0-9]+)\"");
  int count = 0;
  for (const char* part : {"core", "reports", "render", "study", "output", "run", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(DRAPE_SOURCE_DIR) / part)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = test::content(entry.path());
      for (std::sregex_iterator at(text.begin(), text.end(), library), end; at != end; ++at) {
        const Finished found = run_shell(folder, "dpkg-query --search '*/" + (*at)[1].str() + "'");
        if (found.code != 0) continue;  // a name on another system
        const std::string package = found.text.substr(0, found.text.find(':'));
        EXPECT_TRUE(std::regex_search(lists, std::regex("[\" ]" + package + "[\",]")))
            << entry.path() << ": " << package;
        ++count;
      }
    }
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace drape::manual_pages
