// The layout of the portable archive (script/portable), with this system's loader and libraries instead of its own.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/auxv.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::portable {
namespace {

namespace fs = std::filesystem;
using test::Finished;
using test::SceneFolder;

/// Returns the loader of this process.
fs::path loader() {
  Dl_info info{};
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the kernel tells addresses as numbers
  dladdr(reinterpret_cast<void*>(getauxval(AT_BASE)), &info);
  return fs::canonical(info.dli_fname);
}

class Portable : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(DRAPE_LAUNCHER).empty()) GTEST_SKIP() << "no launcher is built with a sanitizer";
    lay_out("archive");
  }

  void lay_out(const std::string& name) {
    root_ = folder_.path() / name;
    for (const char* part : {"bin", "libexec/loader", "lib/drape", "share", "etc/fonts"})
      fs::create_directories(root_ / part);
    fs::copy_file(DRAPE_LAUNCHER, root_ / "bin/drape");
    fs::copy_file(loader(), root_ / "libexec/loader/drape");
    fs::copy_file(DRAPE_EXECUTABLE, root_ / "libexec/drape");
    fs::copy_file(fs::path(DRAPE_EXECUTABLE).parent_path() / "lib/drape/codecs.so", root_ / "lib/drape/codecs.so");
    fs::copy_file(fs::path(DRAPE_SOURCE_DIR) / "cmake/portable-fonts.conf", root_ / "etc/fonts/fonts.conf");
    fs::create_directory_symlink(DRAPE_SOURCE_DIR, root_ / "share/drape");
  }

  [[nodiscard]] Finished drape(const std::string& arguments, const std::string& environment = "") const {
    return run_shell(folder_, environment + " '" + (root_ / "bin/drape").string() + "' " + arguments);
  }

  SceneFolder folder_;
  fs::path root_;
};

TEST_F(Portable, FindsItsPartsFromItsOwnPlace) {
  const Finished finished = drape("doctor --json");
  ASSERT_EQ(finished.code, 0) << finished.text;
  const auto json = nlohmann::json::parse(finished.text);
  EXPECT_EQ(json.at("codecs").at("detail"), (root_ / "lib/drape/codecs.so").string());
  ASSERT_EQ(json.at("backends").size(), 1U);
  EXPECT_EQ(json.at("backends")[0].at("name"), "osmesa");
}

TEST_F(Portable, WritesTheSameBytesAsTheProgramThatWasBuilt) {
  folder_.write("s.toml", test::swinging_scene + "[video]\nsize = [64, 48]\n");
  ASSERT_EQ(test::drape(folder_, "render s.toml -o a.gif").code, 0);
  const Finished finished = drape("render s.toml -o b.gif");
  ASSERT_EQ(finished.code, 0) << finished.text;
  EXPECT_EQ(test::content(folder_.path() / "a.gif"), test::content(folder_.path() / "b.gif"));
}

TEST_F(Portable, IsStartedThroughALinkAndFromAFolderWithSpaces) {
  fs::rename(root_, folder_.path() / "a folder, moved");
  root_ = folder_.path() / "a folder, moved";
  fs::create_symlink(root_ / "bin/drape", folder_.path() / "linked");
  const Finished finished = run_shell(folder_, "./linked --version");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_TRUE(finished.text.starts_with("drape ")) << finished.text;
}

TEST_F(Portable, PassesArgumentsAndExitCodesOn) {
  const Finished finished = drape("render 'no such scene.toml'");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("no such scene.toml"), std::string::npos) << finished.text;
}

TEST_F(Portable, RefusesAPathThatALoaderWouldDivide) {
  lay_out("a:b");
  const Finished finished = drape("--version");
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(finished.text.find("drape: cannot run in a folder whose path contains ':'"), 0U) << finished.text;
}

TEST_F(Portable, RefusesEgl) {
  folder_.write("s.toml", test::swinging_scene);
  const Finished finished = drape("render s.toml --backend egl -o a.png --frames 0..0");
  EXPECT_EQ(finished.code, 4);
  EXPECT_NE(finished.text.find("the portable archive has no EGL"), std::string::npos) << finished.text;
}

TEST_F(Portable, NamesItsLauncherInTheJobsOfASweep) {
  folder_.write("s.toml", test::swinging_scene);
  const Finished finished = drape("sweep s.toml --vary cloth.stiffness=10..40/2 --slurm 1 -o sweep");
  ASSERT_EQ(finished.code, 0) << finished.text;
  std::string jobs;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "sweep"))
    if (entry.is_regular_file()) jobs += test::content(entry.path());
  EXPECT_NE(jobs.find((root_ / "bin/drape").string()), std::string::npos) << jobs;
  EXPECT_EQ(jobs.find("libexec"), std::string::npos) << jobs;
}

TEST_F(Portable, GivesAnotherProgramItsOwnEnvironment) {
  folder_.write("s.toml", test::swinging_scene);
  folder_.write("bin/xdg-open", "#!/bin/sh\nenv >opened.tmp; mv opened.tmp opened\n");
  fs::permissions(folder_.path("bin/xdg-open"), fs::perms::owner_all);
  const Finished finished = drape("render s.toml --frames 0..0 -o a.png --open", "PATH=$PWD/bin:$PATH MINE=yes");
  ASSERT_EQ(finished.code, 0) << finished.text;
  test::run_shell(folder_, "for i in $(seq 100); do [ -e opened ] && break; sleep 0.1; done");
  const std::string opened = test::content(folder_.path("opened"));
  EXPECT_NE(opened.find("MINE=yes"), std::string::npos) << opened;
  EXPECT_EQ(opened.find("FONTCONFIG_FILE"), std::string::npos) << opened;
  EXPECT_EQ(opened.find("GIO_"), std::string::npos) << opened;
}

}  // namespace
}  // namespace drape::portable
