#include "core/machine.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <string>

#include "tests/support/scratch_folder.hpp"

namespace drape::test {
namespace {

/// A folder that resembles a machine's root, as far as processors are concerned.
class Processors : public InScratchFolder {
 protected:
  void file(const std::string& name, const std::string& text) const { put(path(name), text); }
};

TEST_F(Processors, AreThoseThatTheProcessMayUse) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(processors_left(folder_), CPU_COUNT(&before));
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(processors_left(folder_), 1);
  EXPECT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

TEST_F(Processors, AreNoMoreThanAGroupHasTimeOf) {
  file("proc/self/cgroup", "0::/user/job\n");
  file("sys/fs/cgroup/user/job/cpu.max", "max 100000\n");
  const int all = processors_left(folder_);
  file("sys/fs/cgroup/user/cpu.max", "50000 100000\n");  // half a processor
  EXPECT_EQ(processors_left(folder_), 1);
  file("sys/fs/cgroup/user/cpu.max", "100000000 100000\n");
  EXPECT_EQ(processors_left(folder_), all);
}

TEST_F(Processors, AreNoMoreThanAGroupOfVersion1HasTimeOf) {
  file("proc/self/cgroup", "4:memory:/job\n3:cpu,cpuacct:/job\n");
  file("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "-1\n");
  file("sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "100000\n");
  const int all = processors_left(folder_);
  file("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "100000\n");
  EXPECT_EQ(processors_left(folder_), 1);
  EXPECT_GE(all, 1);
}

}  // namespace
}  // namespace drape::test
