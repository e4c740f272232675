#include <gtest/gtest.h>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/read_picture.hpp"

namespace drape::compare_cli {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

const std::string scene = test::least_scene + "duration = 0.1\n[video]\nsize = [64, 48]\n[effects.gravity]\n";

TEST(Compare, WritesEveryFormInOnePass) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  folder.write("b.toml", scene + "[cloth.transform]\ntranslate = [0, 0, 1]\n");
  const Finished finished =
      drape(folder, "compare a.toml b.toml -o ab.gif -o ab.html -o ab.png --sheet 2x1 --difference");
  EXPECT_EQ(finished.code, 0) << finished.text;
  for (const char* file : {"ab.gif", "ab.html", "ab.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path(file))) << file;
  for (const char* diagram : {"energy", "distance"}) {
    for (const char* form : {".svg", ".csv", ".md", ".tex"}) {
      EXPECT_TRUE(std::filesystem::exists(folder.path("ab-diagrams/" + std::string(diagram) + form)))
          << diagram << form;
    }
  }
}

TEST(Compare, VariesASceneByItsKeys) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const Finished finished = drape(
      folder, "compare a.toml --vary integrator.method=liu13,implicit --vary 'camera.up=[0, 0, 1],[0, 1, 1]' -o a.png");
  EXPECT_EQ(finished.code, 0) << finished.text;
  std::size_t motions = 0;
  for (std::size_t at = 0; (at = finished.text.find("drape: ", at)) != std::string::npos; ++at) ++motions;
  EXPECT_EQ(motions, 4U) << finished.text;
}

/// 10 N/m alone would be moved by verlet, 1e9 N/m by quasi-newton, and the page would say so.
TEST(Compare, GivesAllTheMethodThatIsChosenOnce) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const auto page = [&](const std::string& varied) {
    const Finished finished = drape(folder, "compare a.toml --vary " + varied + " -o a.html");
    EXPECT_EQ(finished.code, 0) << finished.text;
    return test::content(folder.path("a.html"));
  };
  const std::string key = "integrator.method";
  EXPECT_EQ(page("cloth.stiffness=10,1e9").find(key), std::string::npos);
  EXPECT_NE(page("integrator.method=verlet,quasi-newton").find(key), std::string::npos);
}

TEST(Compare, PutsWhatOnlyTheLastKeyTellsApartIntoARow) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const std::string vary =
      "compare a.toml --vary integrator.method=liu13,implicit,verlet --vary cloth.stiffness=10,20 ";
  const auto size = [&](const std::string& arguments) {
    EXPECT_EQ(drape(folder, arguments).code, 0);
    return test::read_picture(folder.path("x.png")).size();
  };
  EXPECT_EQ(size(vary + "-o x.png"), size(vary + "-o x.png --grid 2x3"));
}

TEST(Compare, MakesAFilmThatFits) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const Finished finished = drape(folder, "compare a.toml a.toml -o x.gif --max-size 3kB");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_LE(std::filesystem::file_size(folder.path("x.gif")), 3000U);
  EXPECT_NE(finished.text.find(" pixels instead of "), std::string::npos) << finished.text;
}

TEST(Compare, TakesMotions) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  ASSERT_EQ(drape(folder, "simulate a.toml -o a.drape").code, 0);
  ASSERT_EQ(drape(folder, "compare a.toml a.toml -o two.gif").code, 0);
  const Finished both = drape(folder, "compare a.drape a.toml -o both.gif");
  EXPECT_EQ(both.code, 0) << both.text;
  EXPECT_TRUE(both.text.starts_with("drape: a.drape\ndrape: a.toml\n")) << both.text;
  const Finished twice = drape(folder, "compare a.drape --vary look.color=red,blue --frames 0..2 -o twice.gif");
  EXPECT_EQ(twice.code, 0) << twice.text;
  const auto refused = [&](const std::string& arguments) {
    const Finished finished = drape(folder, "compare " + arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    return finished.text;
  };
  EXPECT_NE(refused("a.drape --vary cloth.stiffness=10,20").find("drape: cloth.stiffness: 10, and 20 in --vary\n"),
            std::string::npos);
  EXPECT_EQ(refused("a.drape a.toml --steps 11"), "drape: --steps 11: a.drape has 10\n");
  EXPECT_EQ(refused("a.toml b.drape.partial"),
            "drape: b.drape.partial is not complete: drape simulate --resume b.drape.partial continues it\n");
}

TEST(Compare, RefusesInOneMessageWithExitCode2) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const auto message = [&](const std::string& arguments) {
    const Finished finished = drape(folder, "compare " + arguments);
    EXPECT_EQ(finished.code, 2) << arguments << finished.text;
    return finished.text;
  };
  EXPECT_EQ(message("a.toml"), "drape: drape compare needs at least two motions\n");
  EXPECT_EQ(message("a.toml a.toml --grid 3"),
            "drape: --grid takes COLUMNSxROWS, each from 1 to 100, as in 4x3; found '3'\n");
  EXPECT_EQ(message("a.toml a.toml -o x.gif --sheet 2x2"), "drape: --sheet 2x2 needs an output for it: -o NAME.png\n");
  EXPECT_EQ(message("a.toml --vary integrator -o x.gif"),
            "drape: --vary takes key.path=value,value…, found 'integrator'\n");
  EXPECT_NE(message("a.toml --vary integrater.method=liu13,implicit").find("did you mean 'integrator'?"),
            std::string::npos);
  EXPECT_NE(message("a.toml a.toml -o a.toml").find("a.toml"), std::string::npos);
}

TEST(Sheet, IsMadeOfASingleFilmToo) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  ASSERT_EQ(drape(folder, "render a.toml -o a.gif -o sheet.png --sheet 3x1").code, 0);
  EXPECT_EQ(test::read_picture(folder.path("sheet.png")).cols, 3 * 64 + 2 * 6);
  EXPECT_EQ(drape(folder, "render a.toml --sheet 2x1").code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/a.png")));
  EXPECT_EQ(drape(folder, "render a.toml -o a.gif --sheet 3x1").code, 2);
}

}  // namespace
}  // namespace drape::compare_cli
