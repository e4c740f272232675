#include <gtest/gtest.h>

#include "drape/sim/settings.hpp"
#include "tests/cli/run_drape.hpp"

namespace drape::test {
namespace {

TEST(Environment, IsRefusedWhereItIsWrong) {
  const SceneFolder folder;
  folder.write("scene.toml", swinging_scene);
  Finished finished = drape(folder, "simulate scene.toml", "DRAPE_ISA=avx3");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(
      finished.text.find("DRAPE_ISA: the instruction set is 'avx3', expected one of " + instruction_sets().front()),
      std::string::npos)
      << finished.text;
  finished = drape(folder, "simulate scene.toml", "DRAPE_DATA=none");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("DRAPE_DATA: no such folder: none"), std::string::npos) << finished.text;
  EXPECT_EQ(drape(folder, "simulate scene.toml", "DRAPE_ISA= DRAPE_DATA=").code, 0) << "empty is as if not set";
}

TEST(Environment, ThatIsWrongIsAFindingOfTheDoctor) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "doctor", "DRAPE_ISA=avx3");
  EXPECT_NE(finished.text.find("DRAPE_ISA: the instruction set is 'avx3'"), std::string::npos) << finished.text;
}

}  // namespace
}  // namespace drape::test
