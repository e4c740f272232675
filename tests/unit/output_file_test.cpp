#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "core/files.hpp"
#include "drape/core/error.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace fs = std::filesystem;
using namespace drape;

namespace {

class AtomicFile : public drape::test::InScratchFolder {};

template <class Call>
std::string output_error(Call&& call) {
  try {
    call();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST_F(AtomicFile, HasItsBytesAndLeavesNothingElse) {
  const std::string bytes("a\0b\n", 4);
  EXPECT_EQ(write_file_atomically(path("x.bin"), bytes), 4u);
  EXPECT_EQ(test::content(path("x.bin")), bytes);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, MakesTheFoldersItNeeds) {
  write_file_atomically(path("a/b/c.txt"), "c");
  EXPECT_EQ(test::content(path("a/b/c.txt")), "c");
}

TEST_F(AtomicFile, TakesAPathRelativeToTheWorkingFolderOfItsBeginning) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  PartialFile file("x.txt");
  file.write("x");
  fs::current_path(before);
  file.commit();
  EXPECT_EQ(test::content(path("x.txt")), "x");
}

TEST_F(AtomicFile, AppearsOnlyWhenCommitted) {
  put(path("x.txt"), "old");
  PartialFile file(path("x.txt"));
  file.write("new");
  EXPECT_EQ(test::content(path("x.txt")), "old");
  EXPECT_EQ(file.commit(), 3u);
  EXPECT_EQ(test::content(path("x.txt")), "new");
}

TEST_F(AtomicFile, ThatIsOnlyAskedAboutLeavesNothingBehind) {
  put(path("old/x.txt"), "old");
  require_writable(path("old/x.txt"));
  require_writable(path("a/b/x.txt"));
  EXPECT_EQ(test::content(path("old/x.txt")), "old");
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_EQ(file_count(), 1u);
  EXPECT_NE(output_error([&] { require_writable(path("old/x.txt/y")); }).find("Not a directory"), std::string::npos);
}

TEST_F(AtomicFile, LeavesTheOldFileAndNothingElseWithoutACommit) {
  put(path("x.txt"), "old");
  { PartialFile(path("x.txt")).write("new"); }
  EXPECT_EQ(test::content(path("x.txt")), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, LeavesTheOldFileOnAFullDisk) {
  put(path("x.txt"), "old");
  const std::string message = output_error([this] {
    const drape::test::FileSizeLimit limit(1000);
    write_file_atomically(path("x.txt"), std::string(5000, 'x'));
  });
  EXPECT_EQ(message, "cannot write " + path("x.txt") + ": File too large");
  EXPECT_EQ(test::content(path("x.txt")), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, ReplacesWhatASymbolicLinkPointsTo) {
  fs::create_directories(path("real"));
  put(path("real/x.txt"), "old");
  fs::create_symlink("real/x.txt", path("link.txt"));
  write_file_atomically(path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(test::content(path("real/x.txt")), "new");
}

TEST_F(AtomicFile, FillsASymbolicLinkThatPointsToNothing) {
  fs::create_symlink("later/x.txt", path("link.txt"));
  write_file_atomically(path("link.txt"), "new");
  EXPECT_EQ(test::content(path("later/x.txt")), "new");
}

TEST_F(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  put(path("x.txt"), "old");
  fs::permissions(path("x.txt"), fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(path("x.txt"), "new");
  EXPECT_EQ(fs::status(path("x.txt")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFile, TakesTheLongestNameAFolderTakes) {
  const std::string name(255, 'n');
  write_file_atomically(path(name), "x");
  EXPECT_EQ(test::content(path(name)), "x");
}

TEST_F(AtomicFile, SaysWhyItCannotBeWritten) {
  fs::create_directories(path("folder"));
  put(path("file"), "");
  fs::create_symlink("loop", path("loop"));
  const auto message = [](const std::string& file) { return output_error([&] { PartialFile partial(file); }); };
  EXPECT_EQ(message(path("folder")), "cannot write " + path("folder") + ": it is a folder");
  EXPECT_EQ(message(path("folder/")), "cannot write " + path("folder/") + ": a file name is missing");
  EXPECT_EQ(message(path("file/x")), "cannot write " + path("file/x") + ": Not a directory");
  EXPECT_EQ(message(path("loop")), "cannot write " + path("loop") + ": Too many levels of symbolic links");
  EXPECT_EQ(message("/dev/null"), "cannot write /dev/null: it is not a regular file");
  EXPECT_EQ(message("/proc/x.gif").substr(0, 26), "cannot write /proc/x.gif: ");
}

TEST_F(AtomicFile, CanBeWrittenTwiceAtOnceAndTheLastCommitWins) {
  PartialFile first(path("x.txt")), second(path("x.txt"));
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(test::content(path("x.txt")), "first");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, ThatEndedEarlyStandsBesideTheCompleteOne) {
  put(path("x.tar.gz"), "old");
  PartialFile file(path("x.tar.gz"));
  file.write("half");
  EXPECT_EQ(file.commit(Ending::early), 4u);
  EXPECT_EQ(file.name(Ending::early), path("x.tar.partial.gz"));
  EXPECT_EQ(test::content(path("x.tar.gz")), "old");
  EXPECT_EQ(test::content(path("x.tar.partial.gz")), "half");

  PartialFile longest(path(std::string(251, 'n') + ".gif"));
  EXPECT_NO_THROW(longest.commit(Ending::early));
}

TEST_F(AtomicFile, RemovesWhatKilledProcessesLeftOfIt) {
  const auto leave = [this](const char* text) {
    const pid_t child = ::fork();
    if (child == 0) {
      PartialFile file(path("x.txt"));
      PartialFile beside_it(path("x.txt"));
      PartialFile another(path("y.txt"));
      file.write(text);
      ::kill(::getpid(), SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
  };
  leave("left");
  EXPECT_EQ(file_count(), 3u);
  PartialFile held(path("x.txt"));
  EXPECT_EQ(file_count(), 2u);  // the held file, and the leftover of y.txt
  {
    const PartialFile second(path("x.txt"));
    EXPECT_TRUE(fs::exists(held.temporary()));
    EXPECT_EQ(file_count(), 3u);
  }
  held.commit();
  write_file_atomically(path("y.txt"), "new");
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(AtomicFile, OfAnotherWriterIsNeverTakenForLeftBehind) {
  std::atomic<int> failures = 0;
  {
    std::vector<std::jthread> writers;
    for (int i = 0; i < 8; ++i) {
      writers.emplace_back([&] {
        for (int k = 0; k < 50; ++k) {
          try {
            write_file_atomically(path("x.txt"), "same");
          } catch (const OutputError&) {
            ++failures;
          }
        }
      });
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(test::content(path("x.txt")), "same");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(AtomicFile, SaysThatTheDiskIsFullWhenAskedAfterASilentFailure) {
  PartialFile file(path("x.txt"));
  EXPECT_NO_THROW(file.require_space());
  const drape::test::FileSizeLimit limit(1000);
  EXPECT_THROW(file.require_space(), OutputError);
}

}  // namespace
