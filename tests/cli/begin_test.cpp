#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/read_picture.hpp"

// The first commands of a new user: new, lint, --quality, --open, and times in place of frames.

namespace drape::begin_cli {
namespace {

namespace fs = std::filesystem;
using test::drape;
using test::Finished;
using test::SceneFolder;

const std::vector<std::string> kinds{"flag", "tablecloth", "curtain", "hanging", "garment"};

TEST(New, WritesScenesThatHaveNothingToAdvise) {
  const SceneFolder folder;
  for (const std::string& kind : kinds) {
    const Finished written = drape(folder, "new " + kind);
    EXPECT_EQ(written.code, 0) << written.text;
    EXPECT_NE(written.text.find("drape render " + kind + ".toml"), std::string::npos) << written.text;
    const std::string text = test::content(folder.path(kind + ".toml"));
    ASSERT_TRUE(text.starts_with("#:schema /")) << text;
    EXPECT_TRUE(fs::exists(text.substr(9, text.find('\n') - 9))) << text;
    const Finished lint = drape(folder, "lint " + kind + ".toml --set time.duration=0.2");
    EXPECT_EQ(lint.text, "1 scene: 0 errors, 0 hints\n") << kind;
    const Finished film = drape(folder, "render " + kind + ".toml --quality draft --set time.duration=0.1 -o x.gif");
    EXPECT_EQ(film.code, 0) << film.text;
  }
}

TEST(New, OverwritesNothing) {
  const SceneFolder folder;
  folder.write("flag.toml", "mine");
  const Finished refused = drape(folder, "new flag");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("flag.toml exists already"), std::string::npos) << refused.text;
  EXPECT_EQ(test::content(folder.path("flag.toml")), "mine");
  EXPECT_EQ(drape(folder, "new flag other.toml").code, 0);
  fs::create_directory(folder.path("scenes"));
  EXPECT_EQ(drape(folder, "new flag scenes").code, 0);
  EXPECT_TRUE(fs::exists(folder.path("scenes/flag.toml")));
}

TEST(New, NamesWhatThereIs) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "new curtian");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("unknown 'curtian'; did you mean 'curtain'?"), std::string::npos) << finished.text;
  EXPECT_EQ(drape(folder, "new").code, 2);
  EXPECT_EQ(drape(folder, "new flag a.toml b.toml").code, 2);
}

TEST(Lint, SaysWhatHasNoEffectAndWhere) {
  const SceneFolder folder;
  folder.write("a.toml", test::least_scene +
                             "[look]\nline_color = \"red\"\nground_grid = 1\ntexture = \"plaid.png\"\ncolor = \"red\"\n"
                             "[camera]\nposition = [0.1, 0, 0]\nmargin = 0.1\n");
  const Finished finished = drape(folder, "lint a.toml");
  EXPECT_EQ(finished.code, 0) << finished.text;
  for (const char* expected :
       {"hint: a.toml:7:14: line_color: it has no effect without mesh_lines = true",
        "hint: a.toml:8:15: ground_grid: it has no effect without [effects.ground]",
        "hint: a.toml:10:9: color: it is not seen", "hint: a.toml:12:12: position: the camera is inside the cloth",
        "hint: a.toml:13:10: margin: it has no effect beside position", "1 scene: 0 errors, 5 hints\n"}) {
    EXPECT_NE(finished.text.find(expected), std::string::npos) << expected << "\n" << finished.text;
  }
}

TEST(Lint, SaysThatStepsAreLongForTheStiffness) {
  const SceneFolder folder;
  folder.write("a.toml", test::least_scene);
  EXPECT_EQ(drape(folder, "lint a.toml").text, "1 scene: 0 errors, 0 hints\n");
  const Finished stiff = drape(folder, "lint a.toml --set cloth.stiffness=1e8");
  EXPECT_NE(stiff.text.find("step: 0.01 s is "), std::string::npos) << stiff.text;
  const Finished coarse = drape(folder, "lint a.toml --set video.fps=500");
  EXPECT_NE(coarse.text.find("steps are longer than the 0.002 s between frames"), std::string::npos) << coarse.text;
}

TEST(Lint, SaysThatLayersAreThickForTheMesh) {
  const SceneFolder folder;
  folder.write("a.toml", test::least_scene + "[effects.self_collision]\nthickness = 0.1\n");
  const std::string command =
      "lint a.toml --set 'cloth.mesh={ grid = [8, 8] }' --set effects.self_collision.thickness=";
  EXPECT_EQ(drape(folder, command + "0.1").text, "1 scene: 0 errors, 0 hints\n");  // cells are 0.25 m wide
  const Finished thick = drape(folder, command + "0.25");
  EXPECT_NE(thick.text.find("thickness: 0.25 m is more than "), std::string::npos) << thick.text;
}

TEST(Lint, FindsTheErrorsOfAllScenes) {
  const SceneFolder folder;
  folder.write("a.toml", "[cloth]\nmash = 1\n");
  folder.write("b.toml", test::least_scene);
  const Finished finished = drape(folder, "lint a.toml b.toml none.toml");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("error: a.toml:2:1: unknown key 'mash'"), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("error: none.toml"), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("\n3 scenes: "), std::string::npos) << finished.text;
  EXPECT_EQ(drape(folder, "lint").code, 2);
}

TEST(Lint, SaysWhyARunWillBeSlow) {
  const SceneFolder folder;
  folder.write("a.toml", test::swinging_scene);
  const Finished finished = drape(folder, "lint a.toml --set time.duration=1e6 --set video.fps=1");
  EXPECT_NE(finished.text.find("slow: 50000000 steps will take about "), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("faster would be"), std::string::npos) << finished.text;
}

TEST(Watch, EndsWithCtrlC) {
  const SceneFolder folder;
  folder.write("a.toml", test::least_scene);
  const Finished finished = test::run_shell(
      folder, "timeout --foreground --preserve-status -s TERM 2 '" DRAPE_EXECUTABLE "' watch a.toml --no-open");
  EXPECT_EQ(finished.code, 130) << finished.text;
  EXPECT_EQ(drape(folder, "watch none.toml --no-open").code, 2);
  EXPECT_EQ(drape(folder, "watch a.toml --no-open --port 65536").code, 2);
}

const std::string film = test::swinging_scene + "[video]\nsize = [64, 48]\n";

TEST(Quality, ScalesThePictureUnlessTheCommandLineSaysItsSize) {
  const SceneFolder folder;
  folder.write("a.toml", film);
  const auto size = [&](const std::string& options) {
    const Finished finished = drape(folder, "render a.toml -o a.png " + options);
    EXPECT_EQ(finished.code, 0) << finished.text;
    return test::read_picture(folder.path("a.png")).size();
  };
  EXPECT_EQ(size(""), cv::Size(64, 48));
  EXPECT_EQ(size("--quality draft"), cv::Size(32, 24));
  EXPECT_EQ(size("--quality film"), cv::Size(64, 48));
  EXPECT_EQ(size("--quality print"), cv::Size(128, 96));
  EXPECT_EQ(size("--set look.quality=draft"), cv::Size(32, 24));
  EXPECT_EQ(size("--quality draft --set video.size=[80,60]"), cv::Size(80, 60));
  const Finished wrong = drape(folder, "render a.toml --quality drafd");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.text.find("did you mean 'draft'?"), std::string::npos) << wrong.text;
}

TEST(Quality, DrawsARecordedMotionToo) {
  const SceneFolder folder;
  folder.write("a.toml", film);
  ASSERT_EQ(drape(folder, "simulate a.toml -o a.drape").code, 0);
  const Finished finished = drape(folder, "render a.drape --quality draft -o a.png");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_EQ(test::read_picture(folder.path("a.png")).size(), cv::Size(32, 24));
}

TEST(Quality, DrawsTheMotionOfADraftInAnyQualityAndThatOfAFilmInADraft) {
  const SceneFolder folder;
  std::string fine = film;
  const std::string cells = "[6, 6]";
  fine.replace(fine.find(cells), cells.size(), "[30, 20]");
  folder.write("a.toml", fine);
  ASSERT_EQ(drape(folder, "simulate a.toml --set look.quality=draft -o draft.drape").code, 0);
  ASSERT_EQ(drape(folder, "simulate a.toml -o film.drape").code, 0);
  for (const std::string motion : {"draft", "film"}) {
    for (const std::string quality : {"draft", "film", "print"}) {
      const Finished finished = drape(folder, "render " + motion + ".drape --quality " + quality + " -o a.png");
      EXPECT_EQ(finished.code, 0) << motion << ' ' << quality << ' ' << finished.text;
    }
  }
}

TEST(Open, ShowsTheFirstFilmInTheDesktopsProgram) {
  const SceneFolder folder;
  folder.write("a.toml", film);
  folder.write("bin/xdg-open", "#!/bin/sh\necho \"$1\" > opened.tmp; mv opened.tmp opened\n");
  fs::permissions(folder.path("bin/xdg-open"), fs::perms::owner_all);
  const Finished finished =
      drape(folder, "render a.toml --open -o a.gif -o b.gif", "PATH=" + folder.path("bin") + ":$PATH");
  EXPECT_EQ(finished.code, 0) << finished.text;
  test::run_shell(folder, "for i in $(seq 100); do [ -e opened ] && break; sleep 0.1; done");
  EXPECT_EQ(test::content(folder.path("opened")), "a.gif\n");
  const Finished missing = drape(folder, "render a.toml --open -o a.gif", "PATH=/nowhere");
  EXPECT_EQ(missing.code, 0);
  EXPECT_NE(missing.text.find("there is no xdg-open"), std::string::npos) << missing.text;
}

TEST(CompareTimes, AreThoseOfTheFirstMotion) {
  const SceneFolder folder;
  folder.write("a.toml", film);
  folder.write("b.toml", film + "[effects.damping]\nfactor = 0.5\n");
  const auto frames = [&](const std::string& options) {
    const Finished finished = drape(folder, "compare a.toml b.toml -o f/{frame:03}.png " + options);
    EXPECT_EQ(finished.code, 0) << finished.text;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path("f"))) names.push_back(entry.path().stem());
    fs::remove_all(folder.path("f"));
    std::ranges::sort(names);
    return names;
  };
  EXPECT_EQ(frames("--at 0.2s"), (std::vector<std::string>{"005"}));
  EXPECT_EQ(frames("--from 0.1s --to 200ms"), (std::vector<std::string>{"003", "004", "005"}));
  EXPECT_EQ(frames("--every 0.1s"), (std::vector<std::string>{"000", "001", "002", "003", "004"}));
  EXPECT_EQ(frames("--every 10"), (std::vector<std::string>{"000", "001", "002"}));
  EXPECT_EQ(frames("--every 0.1s --at 0.3s"), (std::vector<std::string>{"003"}));
  for (const auto& [options, message] :
       {std::pair("--at 9s", "ends at 0.4 s"), std::pair("--at 2", "takes a time such as 2.5s"),
        std::pair("--every frames", "--every frames is for motion files"), std::pair("--every 0.03s", "whole number"),
        std::pair("--at 0.1s --frames 0..1", "excludes")}) {
    const Finished finished = drape(folder, std::string("compare a.toml b.toml ") + options);
    EXPECT_EQ(finished.code, 2) << options;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  }
}

/// Typed at a terminal, from nothing to one's own film, a figure and a golden, at a smaller size than usual.
TEST(FirstMinutes, EndWithAFilmAFigureAndAGolden) {
  const SceneFolder folder;
  if (test::run_shell(folder, "test -x /usr/bin/python3").code != 0) GTEST_SKIP() << "no python3";
  const std::string program = fs::path(DRAPE_EXECUTABLE).parent_path();
  // Makes the generated scene as small as possible.
  folder.write("bin/drape", "#!/bin/sh\nif [ \"$1\" = new ]; then " + program +
                                "/drape \"$@\"; code=$?; sed -i -e 's/^size = .*/size = [64, 48]/' -e 's/^duration = "
                                ".*/duration = 0.2/' flag.toml; exit $code; fi\nexec " +
                                program + "/drape \"$@\"\n");
  fs::permissions(folder.path("bin/drape"), fs::perms::owner_all);
  const Finished finished =
      test::run_shell(folder, "PATH=" + folder.path("bin") + ":$PATH /usr/bin/python3 " +
                                  std::string(DRAPE_SOURCE_DIR) + "/tests/cli/first_minutes.py . film.cast 1000");
  EXPECT_EQ(finished.code, 0) << finished.text;
  for (const char* file : {"flag.toml", "out/flag.gif", "gusts-diagrams/energy.pdf", "flag.golden", "film.cast"}) {
    EXPECT_TRUE(fs::exists(folder.path(file))) << file << "\n" << finished.text;
  }
  EXPECT_TRUE(test::content(folder.path("film.cast")).starts_with("{\"version\": 2"));
}

}  // namespace
}  // namespace drape::begin_cli
