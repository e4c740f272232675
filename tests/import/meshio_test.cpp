// Files written by meshio and numpy, if Debian's python3-meshio is installed.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {
namespace {

class Meshio : public InScratchFolder {};

TEST_F(Meshio, WritesFilesThatAreReadToTheBit) {
  if (std::system("/usr/bin/python3 -c 'import meshio, numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no python3-meshio";
  const std::string script = DRAPE_SOURCE_DIR "/tests/import/write_with_meshio.py";
  const std::string command =
      "/usr/bin/python3 " + script + " '" + path().string() + "' 2>/dev/null > '" + path("names") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::istringstream names(content(path("names")));
  int count = 0;
  for (std::string name; std::getline(names, name); ++count) {
    SCOPED_TRACE(name);
    Progress progress;
    const ImportedMotion found = import_motion({.cloths = {path(name)}}, path("motion.drape"), {}, progress);
    EXPECT_EQ(found.frames, 2);
    EXPECT_EQ(found.triangles, 2);
    MotionReader reader(path("motion.drape"));
    EXPECT_EQ(reader.state(0).x(3, 2), 0.5);
    EXPECT_EQ(reader.state(1).x(1, 2), -0.5);
    EXPECT_EQ(reader.state(1).x(3, 1), 1);
    std::filesystem::remove(path("motion.drape"));
  }
  EXPECT_EQ(count, 10);
}

}  // namespace
}  // namespace drape::test
