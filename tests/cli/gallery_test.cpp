// The README's pictures: the test does not draw them again, but checks that their sources are unchanged.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::cli {
namespace {

namespace fs = std::filesystem;

const fs::path repository = DRAPE_SOURCE_DIR;

TEST(Gallery, IsOfTheScenesAsTheyAre) {
  const test::SceneFolder folder;
  const auto checked = test::run_shell(folder, "'" + (repository / "script/gallery").string() + "' --check");
  EXPECT_EQ(checked.code, 0) << checked.text;
}

TEST(Gallery, SaysWhichPictureIsStaleAndWhy) {
  const test::SceneFolder folder;
  for (const char* kept : {"reports", "check", "study"})
    fs::create_directory_symlink(repository / kept, folder.path() / kept);
  for (const char* part : {"script", "docs/images/accuracy", "scenes/homework", "scenes/showcase"}) {
    fs::create_directories(folder.path() / part);
  }
  fs::copy(repository / "README.md", folder.path());
  fs::copy(repository / "docs/cookbook", folder.path() / "docs/cookbook");
  fs::copy(repository / "script/gallery", folder.path() / "script");
  fs::copy(repository / "docs/images/made-from.txt", folder.path() / "docs/images");
  fs::copy(repository / "docs/images/accuracy/3-solve.svg", folder.path() / "docs/images/accuracy");
  fs::copy(repository / "scenes/showcase", folder.path() / "scenes/showcase", fs::copy_options::recursive);
  for (const char* name : {"5.toml", "5.golden"}) {
    fs::copy(repository / "scenes/homework" / name, folder.path() / "scenes/homework" / name,
             fs::copy_options::recursive);
  }
  const auto check = [&] { return test::run_shell(folder, "script/gallery --check"); };
  EXPECT_EQ(check().code, 0) << check().text;

  folder.write("scenes/showcase/air.toml",
               test::content(repository / "scenes/showcase/air.toml") + "\n[effects.damping]\n");
  for (const char* name : {"ground", "wind"}) {
    fs::remove(*fs::directory_iterator(folder.path() / "scenes/showcase" / (std::string(name) + ".golden/frames")));
  }
  const auto recipe = [&](const std::string& name) { return "docs/cookbook/" + name + ".md"; };
  folder.write(recipe("flag"), test::content(repository / recipe("flag")) + "\n```\ndrape render flag.toml\n```\n");
  folder.write(recipe("curtain"), test::content(repository / recipe("curtain")) + "\nAnother sentence.\n");
  const auto stale = check();
  EXPECT_EQ(stale.code, 1);
  EXPECT_NE(stale.text.find("'air' is stale, because of scenes/showcase/air.toml "), std::string::npos) << stale.text;
  EXPECT_NE(stale.text.find("'ground' is stale, because of scenes/showcase/ground.golden "), std::string::npos);
  EXPECT_NE(stale.text.find("'recipe-flag' is stale, because of docs/cookbook/flag.md "), std::string::npos);
  EXPECT_NE(stale.text.find("'moments-wind' is stale, because of scenes/showcase/wind.golden "), std::string::npos);
  EXPECT_EQ(stale.text.find("hero"), std::string::npos) << stale.text;
  EXPECT_EQ(stale.text.find("curtain"), std::string::npos) << stale.text;
}

}  // namespace
}  // namespace drape::cli
