#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
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

TEST_F(AtomicFile, SaysThatTheDiskIsFullWhenAskedAfterASilentFailure) {
  PartialFile file(path("x.txt"));
  EXPECT_NO_THROW(file.require_space());
  const drape::test::FileSizeLimit limit(1000);
  EXPECT_THROW(file.require_space(), OutputError);
}

}  // namespace
