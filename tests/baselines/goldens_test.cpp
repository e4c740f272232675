#include <gtest/gtest.h>

#include <algorithm>

#include "check/golden.hpp"
#include "tests/cli/run_drape.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Returns drape's own scenes with a golden.
std::vector<fs::path> scenes_with_goldens() {
  std::vector<fs::path> files;
  for (const char* folder : {"homework", "showcase"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(DRAPE_SOURCE_DIR) / "scenes" / folder)) {
      if (entry.path().extension() == ".toml" && fs::exists(golden_folder(entry.path()))) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Goldens : public ::testing::TestWithParam<fs::path> {};
INSTANTIATE_TEST_SUITE_P(Of, Goldens, ::testing::ValuesIn(scenes_with_goldens()), [](const auto& tested) {
  std::string name = tested.param.parent_path().filename().string() + "_" + tested.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

TEST_P(Goldens, AreWhatTheSceneStillGives) {
  const test::SceneFolder folder;
  const auto finished = test::drape(folder, "check --update none '" + GetParam().string() + "'");
  EXPECT_EQ(finished.code, 0) << finished.text;
}

TEST(HomeworkGoldens, AreAllThere) {
  for (const char* scene : {"1", "2", "3", "4", "5"}) {
    EXPECT_TRUE(fs::exists(fs::path(DRAPE_SOURCE_DIR) / "scenes/homework" / (std::string(scene) + ".golden"))) << scene;
  }
}

}  // namespace
}  // namespace drape
