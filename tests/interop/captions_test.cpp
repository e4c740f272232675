#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "run/run_scene.hpp"
#include "tests/support/scene_folder.hpp"

// Captions are read by tesseract, which does not know their text.

namespace drape::interop_captions {
namespace {

class Captions : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DRAPE_INTEROP") == nullptr) GTEST_SKIP() << "script/interop installs the readers and runs this";
  }

  /// Returns the text that tesseract reads in the last picture of a film, without spaces.
  std::string read(const std::string& caption, const std::string& language, const std::string& look) const {
    const std::string picture = folder_.path("picture.png");
    const std::string text =
        "[cloth]\nmesh = { grid = [8, 8] }\nstiffness = 50\npins = [\"corner:x-y-\"]\n[time]\nstep = 0.02\n"
        "duration = 0.4\n[integrator]\nmethod = \"implicit\"\ntolerance = 1e-3\n[effects.gravity]\n[video]\n"
        "size = [800, 600]\n[look]\n" +
        look + "\n[caption]\nsize = 36\n" + caption + "\n";
    RunOptions options;
    options.outputs = {picture};
    Progress progress;
    run_scene(folder_.load(text), options, {}, progress);
    const std::string command = "tesseract '" + picture + "' - -l " + language + " --psm 11 2>/dev/null";
    std::FILE* const output = ::popen(command.c_str(), "r");
    std::string found;
    std::array<char, 4096> piece{};
    while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), output))
      found.append(piece.data(), count);
    ::pclose(output);
    std::erase_if(found, [](char c) { return c == ' ' || c == '\n' || c == '\f'; });
    return found;
  }

  test::SceneFolder folder_;
};

TEST_F(Captions, SayTheSceneAndTheMomentOnDarkAndLight) {
  for (const char* look : {"background = \"white\"", "background = \"black\""}) {
    const std::string text =
        read("text = \"{integrator.method}, h = {time.step}, t = {time:.2f} s, step {step}\"", "eng", look);
    EXPECT_NE(text.find("implicit,h=0.02,t=0.40s,step20"), std::string::npos) << look << ": " << text;
  }
}

TEST_F(Captions, AreReadOnTheClothToo) {
  const std::string panel = "text = \"energy {energy.total:.1f} J\"\nplace = \"bottom\"\nbacking = \"panel\"";
  const std::string text = read(panel, "eng", "mesh_lines = true");
  EXPECT_NE(text.find("energy-"), std::string::npos) << text;
}

TEST_F(Captions, AreReadInGreekAndChinese) {
  const std::string greek = read("text = \"Ενέργεια\"", "ell", "background = \"white\"");
  EXPECT_NE(greek.find("Ενέργεια"), std::string::npos) << greek;
  const std::string chinese = read("text = \"布料模拟\"", "chi_sim", "background = \"white\"");
  EXPECT_NE(chinese.find("布料模拟"), std::string::npos) << chinese;
}

}  // namespace
}  // namespace drape::interop_captions
