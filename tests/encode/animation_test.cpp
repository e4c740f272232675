#include <gtest/gtest.h>
#include <webp/demux.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

// Independent readers of animated pictures: libwebp's decoder for WebP, FFmpeg's for APNG, whose times come from its
// chunks.

using namespace drape;
using namespace drape::test;

namespace {

struct Shown {
  std::vector<Image> frames;
  std::vector<double> ends;  // end of each frame's time [s]
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

/// Returns the picture shown at a time.
const Image& frame_at(const Shown& shown, double time) {
  const auto next = std::upper_bound(shown.ends.begin(), shown.ends.end(), time);
  return shown.frames.at(static_cast<std::size_t>(std::min(next, shown.ends.end() - 1) - shown.ends.begin()));
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
  const Shown film = shown();
  EXPECT_NEAR(film.ends.back(), 30 / 25.0, 0.001);
  for (int k = 0; k < 30; ++k) {
    const Image frame = synthetic_frame(k, 241, 199);
    const Image& seen = frame_at(film, (k + 0.2) / 25);
    if (GetParam() == ".apng") {
      EXPECT_EQ(seen.pixels, frame.pixels) << k;
    } else {
      EXPECT_GT(psnr(frame, seen), 30) << k;
      // Another frame must be farther away, or the bound is meaningless.
      EXPECT_LT(psnr(synthetic_frame(k + 8, 241, 199), seen), 22) << k;
    }
  }
}

/// Makes a frame of a soft shadow that crosses a ground with lines, below a sharp-edged cloth that comes to rest.
Image shadow_frame(int k, int width, int height) {
  Image image(width, height);
  const double middle = 20 + 3.0 * k, cloth = std::min(40.0 + 2 * k, 100.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double light = 222 - 0.05 * y;
      if (x % 40 == 7 || (y + x / 4) % 30 == 3) light -= 14;
      light *= 1 - 0.35 * std::exp(-((x - middle) * (x - middle) + (y - 90.0) * (y - 90.0)) / 450);
      const bool covered = y < 60 && x >= cloth && x < cloth + 50;
      const bool red = (x - static_cast<int>(cloth)) / 6 % 2 == y / 6 % 2;
      for (int c = 0; c < 3; ++c) {
        image.at(x, y)[c] = static_cast<std::uint8_t>(covered ? (red && c > 0 ? 40 : 205) : light + 2 * c);
      }
    }
  }
  return image;
}

/// Returns the largest error of a film where nothing has moved for `still` frames.
int residual(const Shown& film, const std::vector<Image>& drawn, double fps, int still) {
  int worst = 0;
  for (int k = still; k < static_cast<int>(drawn.size()); ++k) {
    const Image& seen = frame_at(film, (k + 0.9) / fps);
    for (std::size_t i = 0; i < seen.pixels.size(); i += 3) {
      const auto same = [&](const Image& other) {
        return std::equal(other.pixels.begin() + i, other.pixels.begin() + i + 3, drawn[k].pixels.begin() + i);
      };
      if (!std::all_of(drawn.begin() + k - still, drawn.begin() + k, same)) continue;
      for (std::size_t c = i; c < i + 3; ++c) worst = std::max(worst, std::abs(seen.pixels[c] - drawn[k].pixels[c]));
    }
  }
  return worst;
}

// A resting pixel is correct, as in a GIF: moving objects leave no traces.
TEST_P(Animation, LeavesNothingWhereAShadowWas) {
  // If frames are too short to be split, errors of lossy compression are corrected every twelfth frame.
  for (const auto& [fps, still] : {std::pair{25.0, 4}, std::pair{60.0, 17}}) {
    std::vector<Image> drawn;
    const auto animation = encoder(fps);
    for (int k = 0; k < 60; ++k) {
      drawn.push_back(shadow_frame(k, 240, 136));
      animation->add(drawn.back());
    }
    const std::uintmax_t size = animation->finish().at(0).size;
    const Shown film = shown();
    EXPECT_EQ(residual(film, drawn, fps, still), 0) << fps;
    EXPECT_NEAR(film.ends.back(), 60 / fps, 0.001);
    for (std::size_t i = 1; i < film.ends.size(); ++i) EXPECT_GT(film.ends[i] - film.ends[i - 1], 0.0105) << i;
    if (GetParam() == ".webp") {
      EXPECT_LT(size, 150'000U);
    }
  }
}

// A film at rest is one frame, however long.
TEST_P(Animation, OfWhatRestsIsSmall) {
  const auto animation = encoder();
  for (int k = 0; k < 200; ++k) animation->add(shadow_frame(100, 240, 136));
  animation->finish();
  EXPECT_NEAR(shown().ends.back(), 8, 0.001);
  EXPECT_LT(content(file()).size(), 40'000U);
}

// Frame k ends at (k + 1)/fps, to the millisecond: rounding errors do not accumulate.
TEST_P(Animation, ShowsEveryFrameAtItsTime) {
  for (const double fps : {25.0, 30.0, 60.0, 12.5}) {
    const auto animation = encoder(fps);
    for (int k = 0; k < 40; ++k) {  // all different, because libwebp merges equal frames
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
  EXPECT_NEAR(shown().ends.back(), 0.4, 0.001);  // for any number of frames
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
