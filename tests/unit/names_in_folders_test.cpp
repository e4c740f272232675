#include "core/installation.hpp"

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::names_in_folders {
namespace {

namespace fs = std::filesystem;
using test::usage_error;

TEST(NameInFolder, IsWhatAFolderCanHave) {
  for (const std::string name : {"5", "homework-5", "été.gif", "a b", "$(x)", "<b>", "a..b", "-r", "\xff"}) {
    EXPECT_EQ(name_in_folder(name, "sweep.json", "key"), name);
  }
  EXPECT_NO_THROW(name_in_folder(std::string(longest_name, 'n'), "sweep.json", "key"));
}

TEST(NameInFolder, LeadsNowhereElse) {
  const std::vector<std::string> names{"",
                                       ".",
                                       "..",
                                       "../victim",
                                       "/etc/passwd",
                                       "a/b",
                                       "a\\b",
                                       ".git",
                                       "a\nb",
                                       "a\x1b[2J",
                                       "a\x7f",
                                       "a\xc2\x9b",
                                       std::string("a\0b", 3),
                                       std::string(longest_name + 1, 'n')};
  for (const std::string& name : names) {
    const std::string message = usage_error([&] { name_in_folder(name, "in/sweep.json", "runs[3].key"); });
    EXPECT_TRUE(message.starts_with("in/sweep.json: runs[3].key: expected a plain name")) << message;
    EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos) << message;
    EXPECT_LT(message.size(), 250U);
    EXPECT_NO_THROW(name_in_folder(as_name_in_folder(name), "scene", "name")) << as_name_in_folder(name);
  }
}

class LinksInFolder : public test::InScratchFolder {
 protected:
  LinksInFolder() {
    put(folder_ / "victim/file", "x");
    put(folder_ / "in/runs/a/file", "x");
  }
  std::string refusal() {
    return usage_error([&] { require_links_inside(folder_ / "in"); });
  }
};

TEST_F(LinksInFolder, MayLeadToItsOtherFiles) {
  fs::create_symlink("a/file", folder_ / "in/runs/b");
  fs::create_directory_symlink("../in/runs", folder_ / "in/again");
  EXPECT_NO_THROW(require_links_inside(folder_ / "in"));
  fs::create_directory_symlink("in", folder_ / "link");
  EXPECT_NO_THROW(require_links_inside(folder_ / "link"));
  EXPECT_NO_THROW(require_inside(folder_ / "link/again/a/file", folder_ / "link"));
  EXPECT_NO_THROW(require_links_inside(folder_ / "nowhere"));
  EXPECT_NO_THROW(require_inside(folder_ / "nowhere/a", folder_ / "nowhere"));
}

TEST_F(LinksInFolder, DoNotLeadOutOfIt) {
  fs::create_directory_symlink("../../victim", folder_ / "in/runs/c");
  EXPECT_NE(refusal().find("in/runs/c: a link leads from there out of "), std::string::npos) << refusal();
  for (const char* place : {"in/runs/c", "in/runs/c/file", "in/../victim"}) {
    EXPECT_THROW(require_inside(folder_ / place, folder_ / "in"), UsageError) << place;
  }
  fs::remove(folder_ / "in/runs/c");
  fs::create_symlink("../../victim/new", folder_ / "in/runs/c");  // writing there would create a file elsewhere
  EXPECT_THROW(require_links_inside(folder_ / "in"), UsageError);
  EXPECT_THROW(require_inside(folder_ / "in/runs/c", folder_ / "in"), UsageError);
}

}  // namespace
}  // namespace drape::names_in_folders
