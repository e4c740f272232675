#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "cli/terminal.hpp"
#include "core/text.hpp"
#include "run/progress.hpp"
#include "tests/cli/run_drape.hpp"

namespace drape::cli {
namespace {

using test::drape;
using test::Finished;

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, columns_of(line));
  return longest;
}

/// Returns the names below "Subcommands:" of a help.
std::vector<std::string> subcommands_of(const std::string& help) {
  std::vector<std::string> names;
  const std::size_t heading = help.find("Subcommands:\n");
  if (heading == std::string::npos) return names;
  std::istringstream lines(help.substr(heading));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  ")) {
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

TEST(Terminal, HelpOfEveryCommandFitsTheWindowAndHasExamples) {
  const test::SceneFolder folder;
  std::vector<std::string> commands = subcommands_of(drape(folder, "help").text);
  EXPECT_GE(commands.size(), 9U);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Finished help = drape(folder, "help " + commands[i], "COLUMNS=80");
    EXPECT_EQ(help.code, 0) << commands[i];
    EXPECT_LE(longest_line(help.text.substr(0, help.text.find("Examples:"))), 80U) << help.text;
    EXPECT_EQ(help.text.find("Excludes"), std::string::npos) << help.text;
    EXPECT_NE(help.text.find("\nExamples:\n  drape " + commands[i]), std::string::npos) << help.text;
    EXPECT_EQ(help.text, drape(folder, commands[i] + " --help", "COLUMNS=80").text);
    for (const std::string& name : subcommands_of(help.text)) commands.push_back(commands[i] + " " + name);
  }
  const Finished unknown = drape(folder, "help rendr");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.text, "drape: unknown command 'rendr'; did you mean 'render'?\n");
  const Finished study = drape(folder, "study homewrok");
  EXPECT_EQ(study.code, 2);
  EXPECT_EQ(study.text, "drape: unknown command 'homewrok'; did you mean 'homework'?\n");
}

// A film that began earlier is half done when its progress is first shown.
TEST(Terminal, PredictsTheTimeLeftFromWhatIsDoneSinceItIsShown) {
  Progress progress;
  progress.begin("drawing", "frames", 200);
  progress.done = 100;
  testing::internal::CaptureStderr();
  ProgressDisplay display(progress, ProgressDisplay::Style::bar);
  display.update();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  progress.done = 101;
  display.update();
  const std::string text = testing::internal::GetCapturedStderr();
  const std::string head = "drawing 101/200 frames  ";
  ASSERT_NE(text.find(head), std::string::npos) << text;
  EXPECT_LE(std::stod(text.substr(text.find(head) + head.size())), 20) << text;  // frames per second
}

TEST(Terminal, AnswersWithWhatWasMeant) {
  const test::SceneFolder folder;
  folder.write("x.toml", test::swinging_scene);
  const auto refusal = [&](const std::string& arguments) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    return finished.text;
  };
  EXPECT_EQ(refusal("x.toml"), "drape: 'x.toml' is a scene, not a command; did you mean 'drape render x.toml'?\n");
  EXPECT_EQ(refusal("m.drape"), "drape: 'm.drape' is a motion, not a command; did you mean 'drape render m.drape'?\n");
  EXPECT_EQ(refusal("render x.toml --fps 30"),
            "drape: '--fps' is a key of the scene, not an option; did you mean '--set video.fps=30'?\n");
  EXPECT_EQ(refusal("simulate x.toml --max-iterations=7"),
            "drape: '--max-iterations' is a key of the scene, not an option; did you mean '--set "
            "integrator.max_iterations=7'?\n");
  // Several tables have such a key; the suggestion fits it. doctor takes none.
  EXPECT_EQ(refusal("render x.toml --size 640x480"),
            "drape: '--size' is a key of the scene, not an option; did you mean --set 'video.size=[640,480]' or --set "
            "'check.size=[640,480]'?\n");
  EXPECT_EQ(drape(folder, "render x.toml -o x.gif --frames 0..1 --set 'video.size=[64,48]'").code, 0);
  EXPECT_NE(refusal("render x.toml --size 9").find("did you mean '--set caption.size=9'"), std::string::npos);
  EXPECT_EQ(refusal("doctor --fps 30").find("key of the scene"), std::string::npos);
}

TEST(Terminal, SaysWhatThereIsWhereNothingIsAskedFor) {
  const test::SceneFolder folder;
  const Finished finished = drape(folder, "", "COLUMNS=80");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("\n\nUsage: drape COMMAND ...\n\n  new       Write "), std::string::npos)
      << finished.text;
  EXPECT_NE(finished.text.find("drape help COMMAND\n"), std::string::npos) << finished.text;
  EXPECT_LE(longest_line(finished.text), 80U) << finished.text;
  EXPECT_LE(std::ranges::count(finished.text, '\n'), 24) << finished.text;
}

TEST(Terminal, ValuesAreNotEmpty) {
  const test::SceneFolder folder;
  folder.write("x.toml", test::swinging_scene);
  const auto expect_refused = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments << finished.text;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  for (const std::string option : {"--max-size", "--every", "--sheet", "--frames", "--stats"}) {
    expect_refused("render x.toml " + option + " ''", option + ": expected a value, found an empty text");
    expect_refused("render x.toml " + option + "= x.toml", option + ": expected a value, found an empty text");
  }
  expect_refused("sweep x.toml --vary cloth.mass=1,2 --slurm-option --partition=short",
                 "--slurm-option requires --slurm");
  expect_refused("check x.toml --report x.golden", "--report x.golden: this is the folder of a golden");
  expect_refused("render x.toml -o a.gif -o a.mp4 --poster",
                 "the poster of a.gif and the poster of a.mp4 write the same");
}

TEST(Terminal, OffersWhatACommandCanWrite) {
  const test::SceneFolder folder;
  const std::string compare = drape(folder, "compare --help").text, simulate = drape(folder, "simulate --help").text;
  for (const std::string undrawn : {".obj", ".npz", "the motion itself", ".usda"}) {
    EXPECT_EQ(compare.find(undrawn), std::string::npos) << undrawn;
    EXPECT_NE(simulate.find(undrawn), std::string::npos) << undrawn;
  }
  EXPECT_NE(compare.find(".html"), std::string::npos);
}

TEST(Terminal, HasColoursWhereTheyAreWanted) {
  const test::SceneFolder folder;
  const std::string red = "\x1b[31mdrape:\x1b[0m";
  EXPECT_TRUE(drape(folder, "--color always render absent.toml").text.starts_with(red));
  EXPECT_TRUE(drape(folder, "render absent.toml --color always", "NO_COLOR=1").text.starts_with(red));
  EXPECT_TRUE(drape(folder, "render absent.toml").text.starts_with("drape: "));  // into a pipe
  const auto at_terminal = [&](const std::string& environment, const std::string& arguments) {
    return test::run_shell(folder, environment + " TERM=xterm script -qec '" + DRAPE_EXECUTABLE + " " + arguments +
                                       "' /dev/null </dev/null")
        .text;
  };
  EXPECT_NE(at_terminal("", "render absent.toml").find(red), std::string::npos);
  EXPECT_EQ(at_terminal("NO_COLOR=1", "render absent.toml").find('\x1b'), std::string::npos);
  EXPECT_EQ(at_terminal("", "--color never render absent.toml").find('\x1b'), std::string::npos);
  EXPECT_NE(drape(folder, "--color sometimes doctor").text.find("unknown 'sometimes'"), std::string::npos);
}

TEST(Terminal, BreaksResultsBetweenWords) {
  const test::SceneFolder folder;
  folder.write("scene.toml", test::swinging_scene);
  const std::string options = "simulate scene.toml --set integrator.max_iterations=2 --set integrator.tolerance=1e-9";
  const Finished narrow = drape(folder, options, "COLUMNS=60"), wide = drape(folder, options);
  EXPECT_NE(wide.text.find("steps not converged (worst residual "), std::string::npos) << wide.text;
  EXPECT_LE(longest_line(narrow.text), 60U) << narrow.text;
  const Finished at_terminal = test::run_shell(
      folder, "TERM=xterm script -qec '" + std::string(DRAPE_EXECUTABLE) + " " + options + "' /dev/null </dev/null");
  const std::size_t summary = at_terminal.text.rfind("20 steps, ");
  ASSERT_NE(summary, std::string::npos) << at_terminal.text;
  EXPECT_LE(longest_line(at_terminal.text.substr(summary)), 81U) << at_terminal.text;  // with a carriage return
}

// A progress bar that wrapped into a second line could not be erased.
TEST(Terminal, ShowsProgressInOneLine) {
  const test::SceneFolder folder;
  folder.write("scene.toml", test::swinging_scene);
  const Finished finished = test::run_shell(
      folder, "TERM=xterm script -qec '" DRAPE_EXECUTABLE
              " study accuracy scene.toml --parts order --methods verlet --steps 0.002,0.001 --times 0.4 "
              "--runs 1 --animate none' /dev/null </dev/null");
  const std::string taken_back = "\r\x1b[K";
  for (std::size_t at = finished.text.find(taken_back); at != std::string::npos;) {
    const std::size_t begin = at + taken_back.size();
    const std::string line = finished.text.substr(begin, finished.text.find_first_of("\r\n", begin) - begin);
    EXPECT_LT(columns_of(line), 80U) << line;
    at = finished.text.find(taken_back, begin);
  }
  EXPECT_NE(finished.text.find("report.html"), std::string::npos) << finished.text;
}

TEST(Terminal, WrapsMessagesAtTheWindowsWidth) {
  const test::SceneFolder folder;
  folder.write("scene.toml", test::swinging_scene + "[look]\ncolour = 1\nbackgrund = 2\nsphere_colour = \"red\"\n");
  const Finished finished = drape(folder, "simulate scene.toml --set integrator.method=leapfrog", "COLUMNS=50");
  EXPECT_EQ(finished.code, 2);
  EXPECT_LE(longest_line(finished.text), 50U) << finished.text;
  EXPECT_NE(finished.text.find("\n  "), std::string::npos) << finished.text;
}

}  // namespace
}  // namespace drape::cli
