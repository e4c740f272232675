#include "core/files.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "drape/core/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Tests whose system's temporary folder is their own.
class TemporaryFolders : public test::InScratchFolder {
 protected:
  void SetUp() override { ::setenv("TMPDIR", folder_.c_str(), 1); }
  void TearDown() override { ::unsetenv("TMPDIR"); }

  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  void age_all() {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.is_symlink()) continue;
      fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(1));
    }
  }
};

TEST_F(TemporaryFolders, LiveAsLongAsTheirOwner) {
  fs::path place;
  {
    const TemporaryFolder folder("drape-test");
    place = folder.path();
    EXPECT_EQ(place.parent_path(), folder_);
    put(place / "inside/deep.txt", "text");
    EXPECT_EQ(fs::status(place).permissions(), fs::perms::owner_all);
  }
  EXPECT_FALSE(fs::exists(place));
}

TEST_F(TemporaryFolders, OfKilledProcessesGoWithTheNext) {
  const pid_t child = ::fork();
  if (child == 0) {
    const TemporaryFolder folder("drape-test");
    put(folder.path() / "left.txt", "text");
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  fs::create_directory(folder_ / "drape-tester");  // of another kind
  fs::create_directory_symlink("/", folder_ / "drape-test-link");
  std::optional<TemporaryFolder> held(std::in_place, "drape-test");
  EXPECT_EQ(entries(), 4) << "what has just been made may not have its lock yet";
  age_all();
  const TemporaryFolder next("drape-test");
  EXPECT_EQ(entries(), 4);  // the two held ones, and the two entries that are not drape's
  EXPECT_TRUE(fs::exists(held->path()));
  EXPECT_TRUE(fs::is_symlink(folder_ / "drape-test-link"));
}

TEST_F(TemporaryFolders, SayWhyThereIsNone) {
  ::setenv("TMPDIR", (folder_ / "absent").c_str(), 1);
  EXPECT_THROW(TemporaryFolder("drape-test"), OutputError);
}

}  // namespace
}  // namespace drape
