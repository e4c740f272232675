#include <gtest/gtest.h>

#include "tests/cli/run_drape.hpp"

namespace drape {
namespace {

using testing::drape;
using testing::Finished;
using testing::SceneFolder;

TEST(Study, OfTheHomeworkWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study homework -o results --runs 1");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("Table 3"), std::string::npos) << finished.text;
  for (const char* name : {"report.html", "report.md", "table1.csv", "table2.csv", "table3.csv", "energies.csv",
                           "energy-log.csv", "iterations-k18.csv", "iterations-k18.gp", "time-by-tolerance.gp"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results" / name)) << name;
  }
}

TEST(Study, NeedsAKindThatThereIs) {
  const SceneFolder folder;
  EXPECT_EQ(drape(folder, "study").code, 2);
  EXPECT_EQ(drape(folder, "study homwork").code, 2);
  EXPECT_EQ(drape(folder, "study homework --runs 0").code, 2);
}

}  // namespace
}  // namespace drape
