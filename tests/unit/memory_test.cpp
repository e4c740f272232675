#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/machine.hpp"
#include "drape/core/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {
namespace {

TEST(Memory, GrantsWhatFits) { EXPECT_NO_THROW(require_memory("a vector", 1e6, "")); }

TEST(Memory, RefusesMoreThanThereIsWithTheFigures) {
  try {
    require_memory("a factor", 2 * memory_left(), "take a coarser cloth");
    FAIL() << "granted twice the memory there is";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("a factor would take"), std::string::npos) << message;
    EXPECT_NE(message.find("coarser cloth"), std::string::npos) << message;
  }
}

TEST(Memory, CountsWhatTheProcessHolds) {
  const double before = memory_left();
  const std::vector<char> held(64'000'000, 'x');
  EXPECT_LE(memory_left(), before - 60e6) << held.back();
}

/// A folder that resembles a machine's root, as far as memory is concerned.
class GroupMemory : public InScratchFolder {
 protected:
  void file(const std::string& name, const std::string& text) const { put(path(name), text); }
};

TEST_F(GroupMemory, OfVersion2IsTheLeastOnTheWayToTheRoot) {
  file("proc/self/cgroup", "0::/user/job\n");
  file("sys/fs/cgroup/user/job/memory.max", "max\n");
  file("sys/fs/cgroup/user/job/memory.current", "1000000\n");
  EXPECT_GT(memory_left(folder_), 100e6);
  file("sys/fs/cgroup/user/memory.max", "50000000\n");
  file("sys/fs/cgroup/user/memory.current", "30000000\n");
  EXPECT_EQ(memory_left(folder_), 20e6);
  file("sys/fs/cgroup/user/memory.stat", "anon 22000000\ninactive_file 5000000\nactive_file 3000000\n");
  EXPECT_EQ(memory_left(folder_), 28e6);  // the file cache is reclaimable
  file("sys/fs/cgroup/user/job/memory.max", "4000000\n");
  EXPECT_EQ(memory_left(folder_), 3e6);
}

TEST_F(GroupMemory, OfVersion1IsThatOfTheMemoryController) {
  file("proc/self/cgroup", "9:name=systemd:/\n5:devices:/\n4:cpu,memory:/job\n0::/\n");
  file("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  file("sys/fs/cgroup/memory/memory.usage_in_bytes", "7000000000\n");
  EXPECT_GT(memory_left(folder_), 100e6);
  file("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "40000000\n");
  file("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "30000000\n");
  file("sys/fs/cgroup/memory/job/memory.stat", "inactive_file 1\ntotal_inactive_file 4000000\n");
  EXPECT_EQ(memory_left(folder_), 14e6);
}

TEST_F(GroupMemory, InAContainerIsWhatIsMounted) {
  file("proc/self/cgroup", "0::/the/hosts/own/name\n");
  file("sys/fs/cgroup/memory.max", "40000000\n");
  file("sys/fs/cgroup/memory.current", "50000000\n");
  EXPECT_EQ(memory_left(folder_), 0);
}

}  // namespace
}  // namespace drape::test
