#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

// Animated pictures are read by others: WebP by libwebp's own decoder, APNG by FFmpeg's, and its clock from its chunks.

using namespace drape;
using namespace drape::test;

namespace {

struct Shown {
  std::vector<Image> frames;
  std::vector<double> ends;  // when each frame's time is over [s]
  std::uint32_t repetitions = 0;
};

Shown read_webp(const std::string& bytes) {
  Shown shown;
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
  if (decoder == nullptr) throw std::runtime_error("no animated WebP");
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  shown.repetitions = info.loop_count;
  while (WebPAnimDecoderHasMoreFrames(decoder) != 0) {
    std::uint8_t* rgba = nullptr;
    int end = 0;
    if (WebPAnimDecoderGetNext(decoder, &rgba, &end) == 0) throw std::runtime_error("a damaged WebP");
    Image image(static_cast<int>(info.canvas_width), static_cast<int>(info.canvas_height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = rgba[i / 3 * 4 + i % 3];
    shown.frames.push_back(std::move(image));
    shown.ends.push_back(end / 1000.0);
  }
  WebPAnimDecoderDelete(decoder);
  return shown;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at, int count) {
  std::uint32_t number = 0;
  for (int i = 0; i < count; ++i)
    number = number << 8 | static_cast<std::uint8_t>(bytes.at(at + static_cast<std::size_t>(i)));
  return number;
}

Shown read_apng(const std::string& file, const std::string& bytes) {
  Shown shown;
  shown.frames = decoded_film(file);
  double end = 0;
  for (std::size_t at = 8; at < bytes.size(); at += 12 + big_endian(bytes, at, 4)) {
    const std::string type = bytes.substr(at + 4, 4);
    if (type == "acTL") {
      EXPECT_EQ(big_endian(bytes, at + 8, 4), shown.frames.size());
      shown.repetitions = big_endian(bytes, at + 12, 4);
    } else if (type == "fcTL") {
      end += static_cast<double>(big_endian(bytes, at + 28, 2)) / big_endian(bytes, at + 30, 2);
      shown.ends.push_back(end);
    }
  }
  return shown;
}

class Animation : public InScratchFolder, public ::testing::WithParamInterface<std::string> {
 protected:
  [[nodiscard]] std::unique_ptr<Encoder> encoder(double fps = 25) const {
    return make_encoder(file(), {.scene = "test", .fps = fps});
  }
  void write(int frames, int width, int height, double fps = 25) const {
    const auto animation = encoder(fps);
    for (int k = 0; k < frames; ++k) animation->add(synthetic_frame(k, width, height));
    const OutputFile written = animation->finish().at(0);
    EXPECT_EQ(written.size, std::filesystem::file_size(file()));
  }
  [[nodiscard]] Shown shown() const {
    const std::string bytes = content(file());
    return GetParam() == ".webp" ? read_webp(bytes) : read_apng(file(), bytes);
  }
  [[nodiscard]] std::string file() const { return path("x" + GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Formats, Animation, ::testing::Values(".webp", ".apng"),
                         [](const auto& format) { return format.param.substr(1); });

TEST_P(Animation, ShowsTheFilm) {
  write(30, 241, 199);
  const std::vector<Image> frames = shown().frames;
  ASSERT_EQ(frames.size(), 30u);
  for (int k = 0; k < 30; ++k) {
    const Image frame = synthetic_frame(k, 241, 199);
    if (GetParam() == ".apng") {
      EXPECT_EQ(frames[k].pixels, frame.pixels) << k;
    } else {
      EXPECT_GT(psnr(frame, frames[k]), 30) << k;
      // Another frame must be farther away, or the bound says nothing.
      EXPECT_LT(psnr(synthetic_frame(k + 8, 241, 199), frames[k]), 22) << k;
    }
  }
}

// Frame k ends at (k + 1)/fps, to the millisecond: the rounding does not add up.
TEST_P(Animation, ShowsEveryFrameAtItsTime) {
  for (const double fps : {25.0, 30.0, 60.0, 12.5}) {
    const auto animation = encoder(fps);
    for (int k = 0; k < 40; ++k) {  // of which none is like the one before, with which libwebp would merge it
      animation->add(
          plain_image(32, 16, {static_cast<std::uint8_t>(k % 2 * 255), static_cast<std::uint8_t>(6 * k), 0}));
    }
    animation->finish();
    const std::vector<double> ends = shown().ends;
    ASSERT_EQ(ends.size(), 40u) << fps;
    for (int k = 0; k < 40; ++k) EXPECT_NEAR(ends[k], (k + 1) / fps, 0.00101) << "frame " << k << " at " << fps;
  }
}

TEST_P(Animation, RepeatsForEver) {
  write(3, 32, 24);
  EXPECT_EQ(shown().repetitions, 0u);
}

TEST_P(Animation, MayHaveOneFrame) {
  write(1, 64, 48);
  EXPECT_EQ(shown().frames.size(), 1u);
}

TEST_P(Animation, MayRestAWhile) {
  const auto animation = encoder();
  for (int k = 0; k < 10; ++k) animation->add(synthetic_frame(k / 5, 64, 48));
  animation->finish();
  EXPECT_NEAR(shown().ends.back(), 0.4, 0.001);  // however many frames it has
}

TEST_P(Animation, LeavesTheOldFileAndNothingElseWithoutFinish) {
  put(file(), "old");
  encoder()->add(synthetic_frame(0, 64, 48));
  EXPECT_EQ(content(file()), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_P(Animation, LeavesTheOldFileOnAFullDisk) {
  put(file(), "old");
  const FileSizeLimit limit(10'000);
  try {
    write(40, 240, 200);
    ADD_FAILURE() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot write " + file() + ": File too large");
  }
  EXPECT_EQ(content(file()), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_P(Animation, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  write(3, 61, 41);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(Animation, RefusesRatesThatBrowsersDoNotPlay) {
  EXPECT_THROW((void)encoder(100), UsageError);
  EXPECT_THROW((void)encoder(0), UsageError);
  EXPECT_THROW((void)encoder(std::nan("")), UsageError);
  EXPECT_NO_THROW((void)encoder(90));
}

TEST_P(Animation, RefusesFramesOfDifferentSizes) {
  const auto animation = encoder();
  animation->add(Image(32, 24));
  EXPECT_THROW(animation->add(Image(24, 32)), std::invalid_argument);
}

}  // namespace
