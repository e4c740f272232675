#include "check/golden.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>

#include "output/png_encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/sample_golden.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

class GoldenFolder : public test::InScratchFolder {
 protected:
  static Golden golden() { return test::sample_golden(12, 23, 10, {0, 40}); }

  Png picture() const { return encode_png(test::plain_image(32, 24, {1, 2, 3})); }
  fs::path folder() const { return folder_ / "scene.golden"; }
};

TEST_F(GoldenFolder, GivesBackWhatWasWritten) {
  const Golden written = golden();
  const std::uintmax_t size = write_golden(folder(), written, {picture(), picture()});
  EXPECT_EQ(size, fs::file_size(folder() / "manifest.json") + fs::file_size(folder() / "motion.bin") +
                      fs::file_size(golden_picture(folder(), 0)) + fs::file_size(golden_picture(folder(), 40)));
  const Golden read = read_golden(folder());
  EXPECT_EQ(read.scene_digest, written.scene_digest);
  EXPECT_EQ(read.date, written.date);
  EXPECT_EQ(read.machine.renderer, written.machine.renderer);
  EXPECT_EQ(read.size, written.size);
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.step_count, written.step_count);
  EXPECT_EQ(read.seconds_per_frame, written.seconds_per_frame);
  EXPECT_TRUE(same_camera(read.camera, written.camera));
  EXPECT_EQ(read.quanta, written.quanta);
  EXPECT_EQ(read.windows.size(), 4u);
  ASSERT_EQ(read.frames.size(), 2u);
  EXPECT_EQ(read.frames[1].why, "the start");
  EXPECT_EQ(read.frames[1].view.position, written.frames[1].view.position);
  EXPECT_EQ(read.frames[1].pixels, pixel_hash(test::plain_image(32, 24, {1, 2, 3})));
  Camera moved = written.camera;
  moved.orbit += 1e-9;
  EXPECT_FALSE(same_camera(read.camera, moved));
}

TEST_F(GoldenFolder, IsRefusedIfAnyByteIsChanged) {
  write_golden(folder(), golden(), {picture(), picture()});
  const auto message = [&] { return test::usage_error([&] { read_golden(folder()); }); };
  ASSERT_EQ(message(), "(no error)");
  for (const char* name : {"manifest.json", "motion.bin"}) {
    const std::string good = test::content(folder() / name);
    const std::size_t stride = good.size() / 100 + 1;
    for (std::size_t i = 0; i < good.size(); i += stride) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 1);
      put(folder() / name, bad);
      const std::string said = message();
      EXPECT_EQ(said.find((folder() / name).string() + ": "), 0u) << said;
      EXPECT_NE(said.find("; restore it, or record it again with drape bless"), std::string::npos) << said;
    }
    put(folder() / name, good.substr(0, good.size() / 2));
    EXPECT_NE(message(), "(no error)");
    put(folder() / name, good);
    EXPECT_EQ(message(), "(no error)");
  }
  Golden other = golden();
  other.windows.back().start.v(2, 1) += 1;  // at the end of the motion, where no step begins
  write_golden(folder_ / "other", other, {picture(), picture()});
  fs::copy(folder_ / "other/motion.bin", folder() / "motion.bin", fs::copy_options::overwrite_existing);
  EXPECT_EQ(message(),
            (folder() / "motion.bin").string() +
                ": has been modified since it was recorded; restore it, or record it again with drape bless");
}

TEST_F(GoldenFolder, OfAnOlderDrapeIsToBeRecordedAnew) {
  put(folder() / "manifest.json", "{\"format\": 1, \"scene_hash\": \"0\"}");
  put(folder() / "motion.bin", "drape motion 1\n");
  const std::string message = test::usage_error([&] { read_golden(folder()); });
  EXPECT_EQ(message, (folder() / "manifest.json").string() +
                         ": was recorded by an older drape in format 1; this one reads formats 3 and 4; restore it, or "
                         "record it again with drape bless");
  EXPECT_TRUE(has_golden(folder()));  // bless may replace it
}

TEST_F(GoldenFolder, SaysWhichFileIsNone) {
  const auto message = [&] { return test::usage_error([&] { read_golden(folder()); }); };
  for (const char* name : {"manifest.json", "motion.bin"}) {
    const fs::path file = folder() / name;
    const auto expect = [&](const std::string& problem) {
      EXPECT_EQ(message(), file.string() + ": " + problem + "; restore it, or record it again with drape bless");
      fs::remove_all(folder());
      write_golden(folder(), golden(), {picture(), picture()});
      fs::remove(file);
    };
    fs::remove_all(folder());
    write_golden(folder(), golden(), {picture(), picture()});
    fs::remove(file);
    expect("is missing");
    fs::create_directory(file);
    expect("is a folder, not a file");
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    expect("is not a regular file");
    fs::create_symlink("/dev/zero", file);
    expect("is not a regular file");
    fs::create_symlink(file, file);
    EXPECT_NE(message().find(file.string() + ": cannot be read"), std::string::npos) << message();
    fs::remove(file);
    std::ofstream(file).close();
    fs::resize_file(file, std::uintmax_t{1} << 40);
    EXPECT_NE(message().find(file.string() + ": the file is too large"), std::string::npos) << message();
  }
}

}  // namespace
}  // namespace drape
