#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;
using namespace drape::test;

namespace {

class Video : public InScratchFolder, public ::testing::WithParamInterface<std::string> {
 protected:
  [[nodiscard]] std::unique_ptr<Encoder> encoder(double fps = 25) const {
    return make_encoder(file(), {.scene = "test", .fps = fps});
  }
  void write(int frames, int width, int height, double fps = 25) const {
    const auto video = encoder(fps);
    for (int k = 0; k < frames; ++k) video->add(synthetic_frame(k, width, height));
    const OutputFile written = video->finish().at(0);
    EXPECT_EQ(written.size, std::filesystem::file_size(file()));
  }
  [[nodiscard]] std::string file() const { return path("x" + GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Formats, Video, ::testing::Values(".mp4", ".webm", ".avi"),
                         [](const auto& format) { return format.param.substr(1); });

TEST_P(Video, HasEveryFrameCloseToTheFilm) {
  write(30, 240, 200);
  const std::vector<Image> shown = decoded_film(file());
  ASSERT_EQ(shown.size(), 30u);
  for (int k = 0; k < 30; ++k) {
    const Image frame = synthetic_frame(k, 240, 200);
    EXPECT_GT(psnr(frame, shown[k]), 27) << k;
    // Another frame must be farther away, or the bound is meaningless.
    EXPECT_LT(psnr(synthetic_frame(k + 8, 240, 200), shown[k]), 22) << k;
  }
}

TEST_P(Video, ShowsWhiteAsNearlyWhite) {
  write(5, 240, 200);
  for (const Image& image : decoded_film(file())) {
    for (int c = 0; c < 3; ++c) EXPECT_GE(image.at(2, 2)[c], 249);
  }
}

TEST_P(Video, HasTheRateItIsGiven) {
  for (const double fps : {25.0, 29.97, 12.5, 60.0}) {
    write(10, 64, 48, fps);
    cv::VideoCapture video(file(), cv::CAP_FFMPEG);
    EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), fps, 0.03 * fps);
  }
}

// Frame k is shown at k/fps, to WebM's millisecond. OpenCV does not report times of the last frames, which an H.264
// decoder keeps back until the end.
TEST_P(Video, ShowsEveryFrameAtItsTime) {
  constexpr int frames = 100;
  for (const double fps : {25.0, 12.5, 60.0}) {
    write(frames + 20, 32, 16, fps);
    cv::VideoCapture video(file(), cv::CAP_FFMPEG);
    for (int k = 0; k < frames; ++k) {
      ASSERT_TRUE(video.grab());
      ASSERT_NEAR(video.get(cv::CAP_PROP_POS_MSEC), 1000 * k / fps, 0.501) << "frame " << k << " at " << fps;
    }
  }
}

TEST_P(Video, MayBeSmallAndSlow) {
  // VP8 alone makes an empty file: its bit rate rounds to zero.
  for (const double fps : {0.2, 0.05}) {
    const auto video =
        make_encoder(file(), {.scene = "test", .fps = fps, .expected_frames = 3, .width = 17, .height = 16});
    for (int k = 0; k < 3; ++k) video->add(synthetic_frame(k, 17, 16));
    EXPECT_EQ(video->finish().size(), 1u);
    EXPECT_EQ(decoded_film(file()).size(), 3u);
  }
}

TEST_P(Video, MayHaveOneFrame) {
  write(1, 64, 48);
  EXPECT_EQ(decoded_film(file()).size(), 1u);
}

TEST_P(Video, RepeatsTheLastColumnAndRowOfAnOddSize) {
  const auto video = encoder();
  Image odd = plain_image(61, 41, {255, 255, 255});
  for (int y = 20; y < 41; ++y) {
    for (int x = 0; x < 61; ++x) odd.at(x, y)[0] = odd.at(x, y)[1] = 0;  // the lower half is blue
  }
  for (int k = 0; k < 3; ++k) video->add(odd);
  video->finish();
  const Image shown = decoded_film(file()).at(2);
  ASSERT_EQ(shown.width, 62);
  ASSERT_EQ(shown.height, 42);
  EXPECT_GT(shown.at(61, 2)[0], 240);
  EXPECT_LT(shown.at(61, 41)[0], 30);
  EXPECT_GT(shown.at(61, 41)[2], 225);
}

TEST_P(Video, LeavesTheOldFileAndNothingElseWithoutFinish) {
  put(file(), "old");
  encoder()->add(synthetic_frame(0, 64, 48));
  EXPECT_EQ(test::content(file()), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_P(Video, LeavesTheOldFileOnAFullDisk) {
  put(file(), "old");
  for (const rlim_t bytes : {100, 10'000}) {
    const FileSizeLimit limit(bytes);
    try {
      write(40, 240, 200);
      ADD_FAILURE() << "no error with " << bytes << " bytes";
    } catch (const OutputError& error) {
      EXPECT_EQ(std::string(error.what()), "cannot write " + file() + ": File too large");
    }
    EXPECT_EQ(test::content(file()), "old");
    EXPECT_EQ(file_count(), 1u);
  }
}

TEST_P(Video, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  write(3, 61, 41);
  {
    const FileSizeLimit limit(100);
    EXPECT_THROW(write(3, 64, 48), OutputError);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(Video, RefusesFramesOfDifferentSizes) {
  const auto video = encoder();
  video->add(Image(32, 24));
  EXPECT_THROW(video->add(Image(24, 32)), std::invalid_argument);
}

}  // namespace
