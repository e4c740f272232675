#include "check/draw_frames.hpp"

#include <algorithm>
#include <stdexcept>

#include "check/golden_file.hpp"
#include "check/name_difference.hpp"
#include "check/picture.hpp"
#include "output/png_encoder.hpp"

namespace drape {
namespace {

FrameResult compare_frame(const GoldenFrame& golden, const std::filesystem::path& golden_file, const Image& actual,
                          const CheckSettings& settings) {
  const Eigen::Vector2i size(actual.width, actual.height);
  FrameResult result;
  result.frame = golden.frame;
  result.time = golden.time;
  result.why = golden.why;
  const std::vector<int>& ignored = settings.ignore_frames;
  result.judged = std::find(ignored.begin(), ignored.end(), golden.frame) == ignored.end();
  result.expected = read_golden_file(golden_file, most_png_bytes(size));
  Image expected;
  try {
    expected = decode_png(result.expected, size);
  } catch (const std::invalid_argument& error) {
    fail_to_read(golden_file, error.what());
  }
  if (pixel_hash(expected) != golden.pixels) fail_to_read(golden_file, "has been modified since it was recorded");
  const PictureComparison comparison = compare_pictures(expected, actual, settings.limits, settings.ignore);
  result.difference = comparison.difference;
  if (result.difference.verdict == PictureVerdict::exact) return result;
  result.actual = encode_png(actual);
  if (result.difference.verdict == PictureVerdict::changed) result.kind = classify_difference(expected, actual);
  result.amplified = encode_png(amplified_difference(expected, actual, amplification(result.difference)));
  result.flip_map = encode_png(magma(comparison.flip));
  return result;
}

}  // namespace

DrawFrames::DrawFrames(const Scene& scene, const Eigen::Vector2i& size, GlBackend backend)
    : simulation_(scene.simulation),
      renderer_(data_folder(), size, View{}, scene.look, scene.simulation.cloth.vertex_count(),
                scene.simulation.cloth.triangles, scene.uvs, backend) {
  renderer_.set_weave(scene.simulation.cloth.rest, scene.uvs);
}

Image DrawFrames::draw(const View& view, int frame, double time, const Vertices& positions) {
  renderer_.look_from(view);
  return renderer_.draw(
      {.index = frame, .time = time, .positions = positions, .colliders = simulation_.colliders(time)});
}

std::vector<Png> DrawFrames::draw(const std::vector<GoldenFrame>& frames, const std::stop_token& stop,
                                  Progress& progress) {
  progress.begin("drawing", "pictures", static_cast<std::int64_t>(frames.size()));
  std::vector<Png> pictures;
  for (const GoldenFrame& frame : frames) {
    if (stop.stop_requested()) break;
    pictures.push_back(encode_png(draw(frame.view, frame.frame, frame.time, frame.x)));
    ++progress.done;
  }
  return pictures;
}

std::vector<FrameResult> DrawFrames::compare(const std::vector<GoldenFrame>& frames,
                                             const std::filesystem::path& folder, const CheckSettings& settings,
                                             const std::stop_token& stop, Progress& progress) {
  progress.begin("comparing", "pictures", static_cast<std::int64_t>(frames.size()));
  std::vector<FrameResult> results;
  for (const GoldenFrame& frame : frames) {
    if (stop.stop_requested()) break;
    const Image actual = draw(frame.view, frame.frame, frame.time, frame.x);
    results.push_back(compare_frame(frame, golden_picture(folder, frame.frame), actual, settings));
    ++progress.done;
  }
  return results;
}

}  // namespace drape
