#include "check/animation.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/draw_windows.hpp"
#include "check/picture.hpp"
#include "core/read_file.hpp"
#include "output/gif_encoder.hpp"
#include "render/montage.hpp"

namespace drape {
namespace {

constexpr int gap = 4;                                // between two pictures [pixels]
constexpr int neighbours = 2;                         // compared frames on both sides of the first bad one
constexpr double picture_rate = 2, motion_rate = 10;  // [1/s]
constexpr std::uint8_t gap_gray = 128;

struct Pair {
  Image expected, actual;
};

Image decode(const Png& png) {
  const cv::Mat bytes(1, static_cast<int>(png.size()), CV_8UC1, const_cast<char*>(png.data()));
  const cv::Mat bgr = cv::imdecode(bytes, cv::IMREAD_COLOR);
  Image image(bgr.cols, bgr.rows);
  if (!bgr.empty()) cv::cvtColor(bgr, cv::Mat(bgr.rows, bgr.cols, CV_8UC3, image.pixels.data()), cv::COLOR_BGR2RGB);
  return image;
}

std::vector<Pair> picture_pairs(const std::vector<FrameResult>& frames, int first_bad) {
  const auto bad = std::find_if(frames.begin(), frames.end(), [&](const auto& f) { return f.frame == first_bad; });
  const auto middle = bad - frames.begin(), count = static_cast<std::ptrdiff_t>(frames.size());
  std::vector<Pair> pairs;
  for (auto i = std::max<std::ptrdiff_t>(0, middle - neighbours); i <= std::min(count - 1, middle + neighbours); ++i) {
    const FrameResult& frame = frames[static_cast<std::size_t>(i)];
    Image expected = decode(frame.expected);
    Image actual = frame.actual.empty() ? expected : decode(frame.actual);
    pairs.push_back({std::move(expected), std::move(actual)});
  }
  return pairs;
}

std::vector<Pair> motion_pairs(const Scene& scene, const Golden& golden, const GoldenWindow& window,
                               const Eigen::Vector2i& size, GlBackend backend) {
  DrawWindows drawing(scene, size, golden.view, backend);
  const std::vector<Vertices> actual = rerun_window(scene.simulation, window);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const double time = static_cast<double>(window.start.step + static_cast<std::int64_t>(i)) * golden.step;
    const int frame = window.frame.value_or(0);
    const Vertices& expected = i == 0 ? window.start.x : window.steps[i - 1].x;
    pairs.push_back({drawing.draw(frame, time, expected), drawing.draw(frame, time, actual[i])});
  }
  return pairs;
}

/// The same factor in all frames, so that one sees the difference grow.
double common_amplification(const std::vector<Pair>& pairs) {
  PictureDifference largest;
  for (const Pair& pair : pairs) {
    for (std::size_t i = 0; i < pair.expected.pixels.size(); ++i) {
      largest.largest_channel =
          std::max(largest.largest_channel, std::abs(pair.expected.pixels[i] - pair.actual.pixels[i]));
    }
  }
  return amplification(largest);
}

Image side_by_side(const Pair& pair, double factor) {
  const Image difference = amplified_difference(pair.expected, pair.actual, factor);
  return montage({&pair.expected, &pair.actual, &difference}, 3, gap, gap_gray);
}

}  // namespace

std::string difference_animation(const Scene& scene, const Golden& golden, const std::vector<GoldenWindow>& windows,
                                 const SceneResult& result, GlBackend backend, const std::filesystem::path& folder) {
  const Comparison& shown = result.windows.first_bad_frame || !result.end_to_end ? result.windows : *result.end_to_end;
  if (!shown.first_bad_frame) return {};
  const auto changed = std::find_if(shown.windows.begin(), shown.windows.end(), [](const WindowResult& window) {
    return window.verdict == MotionVerdict::changed && window.last_step > window.first_step;
  });
  const bool moved = changed != shown.windows.end();
  const Eigen::Vector2i size(result.size[0], result.size[1]);
  const auto at = static_cast<std::size_t>(changed - shown.windows.begin());
  const std::vector<Pair> pairs = moved ? motion_pairs(scene, golden, windows[at], size, backend)
                                        : picture_pairs(shown.frames, *shown.first_bad_frame);
  if (pairs.empty()) return {};

  const std::filesystem::path file = folder / result.name / "difference.gif";
  const std::unique_ptr<Encoder> encoder =
      std::make_unique<GifEncoder>(file, moved ? motion_rate : picture_rate, std::function<void(int, int)>());
  const double factor = common_amplification(pairs);
  for (const Pair& pair : pairs) encoder->add(side_by_side(pair, factor));
  encoder->finish();
  return read_file(file, std::filesystem::file_size(file));
}

}  // namespace drape
