// Files that a golden may replace, and files that it must not.

#include "check/golden.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>

#include "output/png_encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/sample_golden.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

class GoldenInItsPlace : public test::InScratchFolder {
 protected:
  static Golden golden() { return test::sample_golden(3, 10, 4, {0, 4}); }

  std::uintmax_t write(const Golden& golden) const {
    const Png picture = encode_png(test::plain_image(32, 24, {1, 2, 3}));
    return write_golden(folder(), golden, {picture, picture});
  }
  std::uintmax_t write() const { return write(golden()); }

  [[nodiscard]] std::string refusal() const {
    std::string message = test::usage_error([&] { has_golden(folder()); });
    EXPECT_EQ(test::usage_error([&] { write(); }), message);
    return message;
  }

  /// Returns every file with its bytes, every link with its target, and every folder.
  [[nodiscard]] std::map<std::string, std::string> everything() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      all[fs::relative(entry.path(), folder_)] = entry.is_symlink()     ? fs::read_symlink(entry.path()).string()
                                                 : entry.is_directory() ? ""
                                                                        : test::content(entry.path());
    }
    return all;
  }

  [[nodiscard]] fs::path folder() const { return folder_ / "scene.golden"; }
};

TEST_F(GoldenInItsPlace, IsWrittenWhereNothingIs) {
  EXPECT_FALSE(has_golden(folder()));
  write();
  EXPECT_TRUE(has_golden(folder()));
  EXPECT_EQ(file_count(), 4u);
}

TEST_F(GoldenInItsPlace, IsWrittenIntoAnEmptyFolder) {
  fs::create_directory(folder());
  fs::permissions(folder(), fs::perms::owner_all);
  EXPECT_FALSE(has_golden(folder()));
  write();
  EXPECT_TRUE(has_golden(folder()));
  EXPECT_EQ(fs::status(folder()).permissions(), fs::perms::owner_all);
}

TEST_F(GoldenInItsPlace, ReplacesAnOlderOneWhole) {
  write();
  put(folder() / "frames" / "0099.png", "old");
  write();
  EXPECT_EQ(file_count(), 4u);  // nothing old, nothing half-written
}

TEST_F(GoldenInItsPlace, ReplacesADamagedOne) {
  write();
  fs::remove(folder() / "manifest.json");
  put(folder() / "frames" / "0004.png", "damaged");
  EXPECT_TRUE(has_golden(folder()));
  write();
  put(folder() / "motion.bin", "");
  EXPECT_TRUE(has_golden(folder()));
  write();
  EXPECT_EQ(read_golden(folder()).frames.size(), 2u);
}

TEST_F(GoldenInItsPlace, DoesNotReplaceAFile) {
  put(folder(), "a letter");
  EXPECT_NE(refusal().find("scene.golden: is a file, where the golden should be a folder"), std::string::npos);
  EXPECT_EQ(everything(), (std::map<std::string, std::string>{{"scene.golden", "a letter"}}));
}

TEST_F(GoldenInItsPlace, DoesNotReplaceAFolderOfSomebodysOwn) {
  put(folder() / "letters/1.txt", "a letter");
  put(folder() / "manifest.json", "{\"name\": \"an application of the web\"}");
  const auto before = everything();
  EXPECT_NE(refusal().find("scene.golden: is not a golden"), std::string::npos) << refusal();
  EXPECT_EQ(everything(), before);
}

TEST_F(GoldenInItsPlace, DoesNotReplaceALinkToNothing) {
  fs::create_symlink("nowhere", folder());
  EXPECT_NE(refusal().find("scene.golden: is a broken link"), std::string::npos) << refusal();
  EXPECT_TRUE(fs::is_symlink(folder()));
}

TEST_F(GoldenInItsPlace, DoesNotReplaceLinksAndFoldersWithinIt) {
  for (const char* name : {"manifest.json", "motion.bin", "frames/0004.png", "frames"}) {
    write();
    fs::rename(folder() / name, folder_ / "elsewhere");
    fs::create_symlink("../elsewhere", folder() / name);
    const auto before = everything();
    EXPECT_NE(refusal().find(std::string("scene.golden/") + name + ": is a link"), std::string::npos) << refusal();
    EXPECT_EQ(everything(), before);
    fs::remove_all(folder() / name);
    fs::remove_all(folder_ / "elsewhere");
    if (std::string_view(name) == "frames") {
      put(folder() / name, "");
    } else {
      fs::create_directory(folder() / name);
    }
    EXPECT_NE(refusal().find(std::string("scene.golden/") + name + ": is "), std::string::npos) << refusal();
    fs::remove_all(folder());
  }
}

TEST_F(GoldenInItsPlace, KeepsWhatIsNotItsOwn) {
  write();
  put(folder() / ".gitattributes", "*.bin binary");
  put(folder() / "frames" / "notes.txt", "frame 4 is the best");
  put(folder() / "notes/deep/1.txt", "a note");
  fs::create_directory(folder() / "empty");
  fs::create_symlink("nowhere", folder() / "link");
  fs::permissions(folder() / "notes/deep/1.txt", fs::perms::owner_read);
  fs::permissions(folder() / "notes", fs::perms::owner_all);
  const auto before = everything();
  Golden other = golden();
  other.windows[1].start.x(0, 0) = 1;
  write(other);
  auto after = everything();
  for (const char* name : {"scene.golden/motion.bin", "scene.golden/manifest.json"}) {
    EXPECT_NE(after[name], before.at(name));
    after[name] = before.at(name);
  }
  EXPECT_EQ(after, before);
  EXPECT_EQ(fs::status(folder() / "notes/deep/1.txt").permissions(), fs::perms::owner_read);
  EXPECT_EQ(fs::status(folder() / "notes").permissions(), fs::perms::owner_all);
}

TEST_F(GoldenInItsPlace, KeepsPermissions) {
  write();
  const fs::perms ours = fs::perms::owner_read | fs::perms::owner_write;
  for (const char* name : {"manifest.json", "motion.bin", "frames/0004.png"}) fs::permissions(folder() / name, ours);
  for (const char* name : {"", "frames"}) fs::permissions(folder() / name, fs::perms::owner_all);
  write();
  for (const char* name : {"manifest.json", "motion.bin", "frames/0004.png"}) {
    EXPECT_EQ(fs::status(folder() / name).permissions(), ours) << name;
  }
  for (const char* name : {".", "frames"}) {
    EXPECT_EQ(fs::status(folder() / name).permissions(), fs::perms::owner_all) << name;
  }
}

TEST_F(GoldenInItsPlace, StaysWhereALinkLeads) {
  write();
  fs::create_directory(folder_ / "store");
  fs::rename(folder(), folder_ / "store/kept");
  fs::create_directory_symlink("store/kept", folder());
  Golden other = golden();
  other.date = "2027-01-31T12:00:00Z";
  write(other);
  EXPECT_TRUE(fs::is_symlink(folder()));
  EXPECT_EQ(fs::read_symlink(folder()), "store/kept");
  EXPECT_EQ(read_golden(folder_ / "store/kept").date, other.date);
  EXPECT_EQ(file_count(), 4u);
}

}  // namespace
}  // namespace drape
