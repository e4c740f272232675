#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "core/text.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/cli/without_opengl.hpp"
#include "tests/support/files.hpp"

namespace drape {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

/// Checks that the results have a page, its Markdown, these tables, and these diagrams in every format.
void expect_results(const SceneFolder& folder, const Finished& finished, std::vector<std::string> files,
                    const std::vector<std::string>& diagrams) {
  EXPECT_EQ(finished.code, 0) << finished.text;
  files.insert(files.end(), {"report.html", "report.md"});
  const bool svg_only = finished.text.find("only as SVG") != std::string::npos;
  for (const std::string& name : diagrams) {
    files.insert(files.end(), {name + ".csv", name + ".md", name + ".tex", name + ".svg"});
    if (!svg_only) files.insert(files.end(), {name + ".pdf", name + ".png"});
  }
  for (const std::string& name : files) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results" / name)) << name;
  }
}

TEST(Study, OfTheHomeworkWritesEverything) {
  const SceneFolder folder;
  Finished finished =
      drape(folder, "study homework -o results --runs 1 2>messages.txt >summary.txt; exit $? #", "COLUMNS=80");
  finished.text += test::content(folder.path("messages.txt"));
  std::istringstream summary(test::content(folder.path("summary.txt")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(summary, line);) {
    EXPECT_LE(columns_of(line), 80U) << line;
    lines.push_back(line);
  }
  EXPECT_LE(lines.size(), 6U) << summary.str();
  EXPECT_EQ(lines.back(), "results/report.html");
  expect_results(folder, finished, {"table1.csv", "table2.csv", "table3.csv", "energies.csv", "energy-log.csv"},
                 {"iterations-k18", "time-by-tolerance"});
}

TEST(Study, NeedsAKindThatThereIs) {
  const SceneFolder folder;
  EXPECT_EQ(drape(folder, "study").code, 2);
  EXPECT_EQ(drape(folder, "study homwork").code, 2);
  EXPECT_EQ(drape(folder, "study homework --runs 0").code, 2);
}

const std::string swing = R"([cloth]
mesh = { grid = [4, 4] }
stiffness = 20
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 1
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
)";

TEST(Study, OfAccuracyWritesEverythingForEveryScene) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  folder.write("b/a.toml", swing);
  const Finished finished =
      drape(folder,
            "study accuracy a.toml b/a.toml -o results --runs 1 --animate methods --methods liu13,implicit "
            "--tolerances 1e-2,1e-4 --times 0.1,0.2 --steps 0.02,0.01 --accuracies 1e-2,1e-3");
  EXPECT_NE(finished.text.find(" costs"), std::string::npos) << finished.text;
  expect_results(
      folder, finished,
      {"runs.csv", "b-a-by-methods.gif", "b-a-by-methods.png", "b-a-answer.tex", "b-a-answer.md", "b-a-tolerances.csv",
       "b-a-steps.csv", "b-a-cheapest.csv", "b-a-asked.csv", "b-a-estimates.csv", "profiles.csv", "profile-times.csv"},
      {"b-a-solve", "b-a-motion-1", "b-a-motion-2", "b-a-step", "b-a-step-cost", "b-a-apart", "b-a-asked-and-got",
       "b-a-error-cost", "b-a-film", "profile"});

  // Recreates everything from the runs, the animations and their motions.
  std::map<std::string, std::string> before;
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "results")) {
    const std::string name = file.path().filename().string();
    if (file.path().extension() == ".pdf") continue;  // contains its date
    before[name] = test::content(file.path());
    const bool kept = name == "runs.csv" || name == "motions.csv" || name.find("-by-methods.") != std::string::npos;
    if (!kept) std::filesystem::remove(file.path());
  }
  const Finished again = drape(folder, "study accuracy --report-only -o results");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_EQ(again.text.substr(again.text.find(" costs")), finished.text.substr(finished.text.find(" costs")));
  for (const auto& [name, content] : before) {
    EXPECT_TRUE(test::content(folder.path() / "results" / name) == content) << name;
  }
  EXPECT_NE(before["report.html"].find("Turn the cloth"), std::string::npos);
}

TEST(Study, OfAccuracyMakesAReportOfWholeRunsOnly) {
  const SceneFolder folder;
  folder.write("other/runs.csv", "a,b\n");
  folder.write("cut/runs.csv", "scene,kind,method,scheme,setting,run,quantity,value\n,study,,,,,format,1\n");
  const auto expect_error = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, "study accuracy " + arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect_error("--report-only -o other", "other/runs.csv:1: expected the runs of a study");
  expect_error("--report-only -o cut", "cut/runs.csv:2: the file is cut");
  expect_error("--report-only -o none", "none/runs.csv");
  expect_error("a.toml --report-only -o cut", "it takes no scene");
  expect_error("", "expected a scene file, or --report-only");
}

// A scene's name appears in file names, links, tables and commands.
TEST(Study, OfAccuracyTakesScenesOfAnyName) {
  const SceneFolder folder;
  for (const std::string name : {"x';system(\"touch pwned\");#", "<b>&|{frame},\""}) {
    folder.write(name + ".toml", swing);
    folder.write("list/" + name + ".toml", swing);
  }
  const Finished finished = drape(folder,
                                  "study accuracy *.toml -o results --runs 1 --animate methods --methods "
                                  "liu13,implicit --tolerances 1e-2 --times 0.1 --steps 0.02 --parts solve,order");
  expect_results(folder, finished, {"x';system(\"touch pwned\");#-by-methods.gif", "<b>&|{frame},\"-by-methods.gif"},
                 {"x';system(\"touch pwned\");#-solve", "<b>&|{frame},\"-apart"});
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder.path())) {
    EXPECT_NE(file.path().filename(), "pwned") << file.path();
  }
  const std::string page = test::content(folder.path() / "results/report.html");
  EXPECT_EQ(page.find("<b>&"), std::string::npos);
  EXPECT_NE(page.find("&lt;b&gt;&amp;|{frame},&quot;.toml"), std::string::npos);
  const std::string text = test::content(folder.path() / "results/report.md");
  EXPECT_NE(text.find("\n## \\<b\\>\\&\\|{frame},\".toml\n"), std::string::npos);
  EXPECT_NE(text.find("](%3Cb%3E%26%7C%7Bframe%7D%2C%22-solve.svg)"), std::string::npos);
}

TEST(Study, OfAccuracySaysWhatItCannotMeasure) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  const auto expect_error = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, "study accuracy " + arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect_error("a.toml --methods lui13", "did you mean 'liu13'");
  expect_error("a.toml --times 2", "2 s is beyond the motion");
  expect_error("a.toml --times 0.1 --steps 0.03", "does not divide");
  expect_error("b.toml", "b.toml");
  expect_error("a.toml --tolerances -1", "--tolerances");
  expect_error("a.toml --accuracies 0", "--accuracies");
  expect_error("a.toml --parts askd", "did you mean 'asked'");
  expect_error("a.toml --parts films", "films requires asked");
  expect_error("a.toml --parts estimates", "estimates requires asked");
  expect_error("a.toml --patience 0", "--patience");
  // It names semi-implicit Euler, which has nothing to solve for, although that would run only after the reference
  // motion.
  folder.write("a.toml", swing + "[effects.field]\nacceleration = [\"-x\", \"0\", \"0\"]\n");
  expect_error("a.toml --times 0.1 --methods liu13,semi-implicit --set time.duration=1e5", "semi-implicit Euler");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

// Repeated measurements give different times, so equal times prove that results were kept.
TEST(Study, OfAccuracyGoesOnWhereItWasInterrupted) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  folder.write("b.toml", swing);
  const std::string command =
      "study accuracy a.toml b.toml --parts asked --times 0.1 --steps 0.02 --accuracies 1e-3 --methods verlet "
      "--runs 1 --animate none -o results --resume";
  ASSERT_EQ(drape(folder, command).code, 0);
  const std::string whole = test::content(folder.path() / "results/runs.csv");
  const auto rows_of = [](const std::string& text, const std::string& scene) {
    std::istringstream lines(text);
    std::string rows;
    for (std::string line; std::getline(lines, line);) rows += line.starts_with(scene + ",") ? line + "\n" : "";
    return rows;
  };
  // As after the first scene.
  const std::string second = rows_of(whole, "b");
  std::string begun = whole;
  begun.erase(begun.find(second), second.size());
  const auto rows = std::ranges::count(begun, '\n') - 2;  // without the heading and the last
  begun.resize(begun.rfind(",rows,") + 6);
  begun += fmt::format("{}\n", rows);
  folder.write("results/runs.csv", begun);
  const Finished again = drape(folder, command);
  EXPECT_EQ(again.code, 0) << again.text;
  const std::string resumed = test::content(folder.path() / "results/runs.csv");
  EXPECT_EQ(rows_of(resumed, "a"), rows_of(whole, "a"));
  EXPECT_NE(rows_of(resumed, "b"), "");
  // An edited scene is measured again.
  std::string edited = swing;
  edited.replace(edited.find("stiffness = "), 12, "stiffness = 1");
  folder.write("b.toml", edited);
  const Finished changed = drape(folder, command);
  EXPECT_EQ(changed.code, 0) << changed.text;
  EXPECT_NE(changed.text.find("b.toml has changed since it was measured"), std::string::npos) << changed.text;
  const std::string measured = test::content(folder.path() / "results/runs.csv");
  EXPECT_EQ(rows_of(measured, "a"), rows_of(whole, "a"));
  EXPECT_NE(rows_of(measured, "b"), rows_of(resumed, "b"));
  const Finished other = drape(folder, command + " --set cloth.stiffness=30");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.text.find("runs.csv is of another command: drape study accuracy"), std::string::npos) << other.text;
}

// A profile over many scenes counts it as a miss.
TEST(Study, OfSeveralScenesLeavesAMethodOutWhereItCannotRun) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  folder.write("b.toml", swing + "[effects.field]\nacceleration = [\"-x\", \"0\", \"0\"]\n");
  const Finished finished = drape(folder,
                                  "study accuracy a.toml b.toml --parts asked --times 0.1 --steps 0.02 --accuracies "
                                  "1e-3 --methods quasi-newton,semi-implicit --runs 1 --animate none -o results");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("semi-implicit cannot compute"), std::string::npos) << finished.text;
}

TEST(Study, OfScalingWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study scaling --grids 10,15 --runs 1 -o results");
  expect_results(folder, finished, {"scaling-times.csv", "scaling-growth.csv", "scaling-shares.csv"},
                 {"scaling-step", "scaling-vertex", "scaling-iteration", "scaling-memory"});
}

TEST(Study, OfStabilityWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study stability --per-decade 1 --steps 5 -o results");
  EXPECT_NE(finished.text.find("semi-implicit: step and stiffness of the springs"), std::string::npos) << finished.text;
  expect_results(folder, finished, {"border.csv"},
                 {"semi-implicit-springs", "liu13-springs", "implicit-push", "quasi-newton-push"});
}

TEST(Study, OfValidationWritesEverythingAndGoesOn) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study validation rolled-sheet pattern-stiffness -o results");
  EXPECT_NE(finished.text.find("All 2 cases with known answers are met"), std::string::npos) << finished.text;
  expect_results(folder, finished,
                 {"runs.csv", "validation.csv", "rolled-sheet-answers.tex", "pattern-stiffness-answers.csv"},
                 {"validation-summary", "rolled-sheet-energy", "rolled-sheet-cost", "pattern-stiffness-diagonal"});
  const std::string table = test::content(folder.path() / "results/validation.csv");
  const auto players = [&folder] {
    const std::string page = test::content(folder.path() / "results/report.html");
    int count = 0;
    for (std::size_t at = 0; (at = page.find("Turn the cloth", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(players(), 2);
  const Finished again = drape(folder, "study validation --report-only -o results");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_EQ(test::content(folder.path() / "results/validation.csv"), table);
  EXPECT_EQ(players(), 2);
  const Finished resumed = drape(folder, "study validation rolled-sheet pattern-stiffness --resume -o results");
  EXPECT_EQ(resumed.code, 0) << resumed.text;
  EXPECT_EQ(test::content(folder.path() / "results/validation.csv"),
            table);  // includes the times: nothing was measured
  EXPECT_EQ(players(), 2);
  const Finished other = drape(folder, "study validation rolled-sheet --resume -o results");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.text.find("is of another command: drape study validation rolled-sheet pattern-stiffness"),
            std::string::npos)
      << other.text;
}

TEST(Study, OfValidationThatWasInterruptedIsNotMet) {
  const SceneFolder folder;
  ASSERT_EQ(drape(folder, "study validation pattern-stiffness --quick -o results").code, 0);
  std::string runs = test::content(folder.path() / "results/runs.csv");
  const std::size_t at = runs.find("planned,");
  ASSERT_NE(at, std::string::npos);
  runs.insert(at + std::string("planned,").size(), "9");
  folder.write("results/runs.csv", runs);
  const Finished again = drape(folder, "study validation --report-only -o results");
  EXPECT_EQ(again.code, 130) << again.text;
  EXPECT_NE(again.text.find(" runs are missing"), std::string::npos) << again.text;
  EXPECT_EQ(again.text.find("All"), std::string::npos) << again.text;
}

TEST(Study, OfValidationNamesWhatIsNotMet) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study validation lateral-buckling --patience 0.001 -o results");
  EXPECT_EQ(finished.code, 1) << finished.text;
  EXPECT_NE(finished.text.find("not met: Lateral buckling."), std::string::npos) << finished.text;
  EXPECT_NE(test::content(folder.path() / "results/report.md").find("given up after 0.001 s"), std::string::npos);
  EXPECT_EQ(drape(folder, "study validation catenery").code, 2);
  EXPECT_EQ(drape(folder, "study validation catenary --report-only").code, 2);
}

TEST(Study, AnAnswerIsJudgedByItsCase) {
  const SceneFolder folder;
  folder.write("answers.csv", "problem,quantity,value\nspan-1.2,sag,0.7256\n");
  EXPECT_EQ(drape(folder, "validate catenary answers.csv").code, 0);
  folder.write("wrong.csv", "problem,quantity,value\nspan-1.2,sag,0.8\n");
  EXPECT_EQ(drape(folder, "validate catenary wrong.csv").code, 1);
  EXPECT_EQ(drape(folder, "validate catenary none.csv").code, 2);
  const std::string source = std::string(DRAPE_SOURCE_DIR) + "/scenes/validation/terminal-velocity/";
  ASSERT_EQ(drape(folder, "simulate " + source + "terminal-velocity.toml --every 1 -o motion.npz").code, 0);
  const Finished finished = drape(folder, "validate terminal-velocity motion.npz");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("4 of 4 answers are met"), std::string::npos) << finished.text;
}

// These studies would take hours, so unwritable results are reported first.
TEST(Study, LooksForItsFolderFirst) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  folder.write("afile", "");
  folder.write("taken/report.html/file", "");
  const auto expect_refusal = [&](const std::string& study, const std::string& output) {
    const Finished finished = drape(folder, "study " + study + " -o " + output, "timeout 60");
    EXPECT_EQ(finished.code, 4) << study << " -o " << output << ": " << finished.text;
    EXPECT_NE(finished.text.find("cannot write " + output), std::string::npos) << finished.text;
  };
  for (const std::string study : {"accuracy a.toml --set time.duration=1e5 --animate none",
                                  "scaling --grids 10000 --runs 1000", "homework --runs 1000"}) {
    expect_refusal(study, "afile");
  }
  for (const std::string output : {"afile", "afile/results", "taken", "/proc/results"}) {
    expect_refusal("stability --steps 100000", output);
  }
}

TEST(Study, OfAccuracyLooksWhetherItCanDrawFirst) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  const std::string none = test::without_opengl(folder);
  const Finished finished = drape(folder, "study accuracy a.toml --set time.duration=1e5", none + " timeout 60");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_NE(finished.text.find("apt-get install libosmesa6"), std::string::npos) << finished.text;
}

TEST(Study, ThatIsInterruptedWritesNothing) {
  const SceneFolder folder;
  // In the foreground timeout sends one signal; otherwise two, and the second ends drape at once.
  const Finished finished = drape(folder, "study stability --per-decade 20 -o results",
                                  "timeout --foreground --preserve-status --signal=TERM 3");
  EXPECT_EQ(finished.code, 130) << finished.text;
  EXPECT_NE(finished.text.find("interrupted: no report was written"), std::string::npos) << finished.text;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
}

}  // namespace
}  // namespace drape
