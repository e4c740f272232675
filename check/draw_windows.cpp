#include "check/draw_windows.hpp"

#include <algorithm>
#include <stdexcept>

#include "check/golden_file.hpp"
#include "check/picture.hpp"
#include "output/png_encoder.hpp"

namespace drape {
namespace {

std::int64_t picture_count(const std::vector<GoldenWindow>& windows) {
  return std::count_if(windows.begin(), windows.end(), [](const GoldenWindow& w) { return w.frame.has_value(); });
}

FrameResult compare_frame(const std::filesystem::path& golden_file, const Image& actual, const PictureLimits& limits) {
  const Eigen::Vector2i size(actual.width, actual.height);
  FrameResult result;
  result.expected = read_golden_file(golden_file, most_png_bytes(size));
  Image expected;
  try {
    expected = decode_png(result.expected, size);
  } catch (const std::invalid_argument& error) {
    fail_to_read(golden_file, error.what());
  }
  const PictureComparison comparison = compare_pictures(expected, actual, limits);
  result.difference = comparison.difference;
  if (result.difference.verdict == PictureVerdict::exact) return result;
  result.actual = encode_png(actual);
  result.amplified = encode_png(amplified_difference(expected, actual, amplification(result.difference)));
  result.flip_map = encode_png(magma(comparison.flip));
  return result;
}

}  // namespace

DrawWindows::DrawWindows(const Scene& scene, const Eigen::Vector2i& size, const View& view, GlBackend backend)
    : simulation_(scene.simulation),
      renderer_(data_folder(), size, view, scene.look, scene.simulation.cloth.vertex_count(),
                scene.simulation.cloth.triangles, scene.uvs, backend) {}

Image DrawWindows::draw(int frame, double time, const Vertices& positions) {
  return renderer_.draw(
      {.index = frame, .time = time, .positions = positions, .colliders = simulation_.colliders(time)});
}

std::vector<Png> DrawWindows::draw(const std::vector<GoldenWindow>& windows, const std::stop_token& stop,
                                   Progress& progress) {
  progress.begin("drawing", "pictures", picture_count(windows));
  std::vector<Png> pictures;
  for (const GoldenWindow& window : windows) {
    if (!window.frame || stop.stop_requested()) continue;
    pictures.push_back(encode_png(draw(*window.frame, window.time, window.picture_positions())));
    ++progress.done;
  }
  return pictures;
}

std::vector<FrameResult> DrawWindows::compare(const std::vector<GoldenWindow>& golden,
                                              const std::vector<GoldenWindow>& shown,
                                              const std::filesystem::path& folder, const PictureLimits& limits,
                                              const std::stop_token& stop, Progress& progress) {
  progress.begin("comparing", "pictures", picture_count(golden));
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < std::min(golden.size(), shown.size()) && !stop.stop_requested(); ++i) {
    if (!golden[i].frame) continue;
    const int frame = *golden[i].frame;
    const Image actual = draw(frame, shown[i].time, shown[i].picture_positions());
    FrameResult& result = results.emplace_back(compare_frame(golden_picture(folder, frame), actual, limits));
    result.frame = frame;
    result.time = shown[i].time;
    ++progress.done;
  }
  return results;
}

}  // namespace drape
