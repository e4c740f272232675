#include "check/draw_frames.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "check/golden.hpp"
#include "check/name_difference.hpp"
#include "check/picture.hpp"
#include "output/png_encoder.hpp"

namespace drape {
namespace {

constexpr std::size_t most_chosen = 12;
constexpr std::size_t close_part = 50;  // closer than 1/50 of the film, frames look alike

class FrameChoice {
 public:
  explicit FrameChoice(std::size_t frames) : close_(static_cast<int>(frames / close_part)) {}

  void offer(int frame, const std::string& why) {
    const auto near = std::find_if(chosen_.begin(), chosen_.end(),
                                   [&](const ChosenFrame& other) { return std::abs(other.frame - frame) <= close_; });
    if (near != chosen_.end()) {
      near->why += near->frame == frame ? "; " + why : fmt::format("; {} at frame {}", why, frame);
    } else if (chosen_.size() < most_chosen) {
      chosen_.push_back({frame, why});
    }
  }

  std::vector<ChosenFrame> take() {
    std::sort(chosen_.begin(), chosen_.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return std::move(chosen_);
  }

 private:
  int close_;
  std::vector<ChosenFrame> chosen_;
};

void offer_contacts(const FilmFacts& film, FrameChoice& choice) {
  for (std::size_t body = 0; body < film.bodies.size(); ++body) {
    const auto touches = [&](const FrameProperties& frame) { return (frame.touched >> body & 1) != 0; };
    const auto first = std::find_if(film.frames.begin(), film.frames.end(), touches);
    if (first == film.frames.end()) continue;
    choice.offer(static_cast<int>(first - film.frames.begin()), "first contact with " + film.bodies[body]);
  }
}

void offer_releases(const FilmFacts& film, FrameChoice& choice) {
  for (std::size_t k = 1; k < film.frames.size(); ++k) {
    const std::size_t before = film.frames[k - 1].pins, now = film.frames[k].pins;
    if (now >= before) continue;
    choice.offer(static_cast<int>(k),
                 before - now == 1 ? "a pin is released" : fmt::format("{} pins are released", before - now));
  }
}

void offer_extremes(const FilmFacts& film, FrameChoice& choice) {
  const auto offer = [&](double FrameProperties::*fact, const char* most, const char* least) {
    const auto [lowest, highest] = std::minmax_element(film.frames.begin(), film.frames.end(),
                                                       [&](const auto& a, const auto& b) { return a.*fact < b.*fact; });
    if (!((*lowest).*fact < (*highest).*fact)) return;  // constant
    choice.offer(static_cast<int>(highest - film.frames.begin()), most);
    if (least != nullptr) choice.offer(static_cast<int>(lowest - film.frames.begin()), least);
  };
  offer(&FrameProperties::change, "the picture changes most", nullptr);
  offer(&FrameProperties::kinetic, "most kinetic energy", nullptr);
  offer(&FrameProperties::elastic, "most elastic energy", nullptr);
  offer(&FrameProperties::area, "largest area on screen", "smallest area on screen");
}

}  // namespace

std::vector<ChosenFrame> choose_frames(const FilmFacts& film) {
  FrameChoice choice(film.frames.size());
  choice.offer(0, "the start");
  offer_contacts(film, choice);
  offer_releases(film, choice);
  offer_extremes(film, choice);
  return choice.take();
}

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
