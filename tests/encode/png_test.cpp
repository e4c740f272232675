#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;
using namespace drape::test;

namespace {

class Png : public InScratchFolder {
 protected:
  [[nodiscard]] static Image read(const std::string& file) {
    const cv::Mat bgr = cv::imread(file);
    Image image(bgr.cols, bgr.rows);
    cv::Mat rgb(bgr.size(), CV_8UC3, image.pixels.data());
    if (!bgr.empty()) cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    return image;
  }
};

TEST_F(Png, HoldsTheLastFrameExactly) {
  const auto png = make_encoder(path("{scene}.png"), {.scene = "flag"});
  png->add(synthetic_frame(0, 33, 21));
  png->add(synthetic_frame(1, 33, 21));
  EXPECT_EQ(file_count(), 0u);
  const auto files = png->finish();
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].path, path("flag.png"));
  EXPECT_EQ(files[0].size, std::filesystem::file_size(path("flag.png")));
  EXPECT_EQ(read(path("flag.png")), synthetic_frame(1, 33, 21));
}

TEST_F(Png, SequenceHoldsEveryFrameExactlyUnderItsNumber) {
  const auto png =
      make_encoder(path("f/{scene}-{frame:04}.png"), {.scene = "flag", .first_frame = 9, .expected_frames = 3});
  for (int k = 9; k < 12; ++k) png->add(synthetic_frame(k, 33, 21));
  const auto files = png->finish();
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(file_count(), 3u);
  for (int k = 9; k < 12; ++k) {
    const std::string name = path("f/flag-00" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".png");
    EXPECT_EQ(files[k - 9].path, name);
    EXPECT_EQ(files[k - 9].size, std::filesystem::file_size(name));
    EXPECT_EQ(read(name), synthetic_frame(k, 33, 21));
  }
}

TEST_F(Png, SequenceSortsByNameWithoutAWidth) {
  const auto png = make_encoder(path("{frame}.png"), {.scene = "flag", .first_frame = 95, .expected_frames = 10});
  png->add(Image(4, 4));
  EXPECT_EQ(png->finish().at(0).path, path("095.png"));
}

TEST_F(Png, SequenceMayHaveAFolderPerFrame) {
  const auto png = make_encoder(path("{frame:2}/x.png"), {.scene = "flag"});
  png->add(Image(4, 4));
  png->add(Image(4, 4));
  EXPECT_EQ(png->finish().at(1).path, path("01/x.png"));
}

TEST_F(Png, SequenceLeavesAloneWhatItDoesNotReplace) {
  put(path("0.png"), "old");
  put(path("1.png"), "old");
  const auto png = make_encoder(path("{frame}.png"), {.scene = "flag"});
  png->add(Image(4, 4));
  png->finish();
  EXPECT_NE(test::content(path("0.png")), "old");
  EXPECT_EQ(test::content(path("1.png")), "old");
}

TEST_F(Png, HasTheSameBytesEveryTime) {
  const auto bytes = [this] {
    const auto png = make_encoder(path("x.png"), {.scene = "flag"});
    png->add(synthetic_frame(0, 120, 100));
    png->finish();
    return test::content(path("x.png"));
  };
  const std::string first = bytes();
  EXPECT_EQ(bytes(), first);
}

TEST_F(Png, LeavesTheOldFileOnAFullDisk) {
  put(path("x.png"), "old");
  put(path("0.png"), "old");
  for (const std::string name : {"x.png", "{frame}.png"}) {
    const FileSizeLimit limit(500);
    const auto png = make_encoder(path(name), {.scene = "flag"});
    EXPECT_THROW(
        {
          png->add(synthetic_frame(0, 120, 100));
          png->finish();
        },
        OutputError);
  }
  EXPECT_EQ(test::content(path("x.png")), "old");
  EXPECT_EQ(test::content(path("0.png")), "old");
  EXPECT_EQ(file_count(), 2u);
}

}  // namespace
