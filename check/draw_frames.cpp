#include "check/draw_frames.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/golden.hpp"
#include "check/name_difference.hpp"
#include "check/picture.hpp"
#include "core/files.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "output/codecs/codecs.hpp"
#include "output/html_writer.hpp"
#include "output/png_encoder.hpp"
#include "sim/system.hpp"

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

namespace {

constexpr int gap = 4;                               // gap between two pictures [pixels]
constexpr int neighbours = 2;                        // compared frames on each side of the first bad one
constexpr std::size_t most_windows = 6;              // windows of a changed motion
constexpr double picture_rate = 2, motion_rate = 3;  // [1/s]
constexpr std::uint8_t gap_gray = 128;

struct Pair {
  Image expected, actual;
};

Image decode(const Png& png) {
  const cv::Mat bgr = decode_picture(png, cv::IMREAD_COLOR);
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

/// Returns the camera view of the compared frame nearest in time.
const View& view_near(const Golden& golden, double time) {
  const auto nearer = [time](const GoldenFrame& a, const GoldenFrame& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  };
  return std::min_element(golden.frames.begin(), golden.frames.end(), nearer)->view;
}

/// Two motions for interactive viewing, dropped if too large for a browser.
class Players {
 public:
  explicit Players(const Scene& scene, const Golden& golden) : film_(film(scene, golden)) {}

  void add(double time, const WindowPositions& at, std::vector<Collider> colliders) {
    try {
      expected_.add({.time = time, .positions = at.golden, .colliders = colliders});
      actual_.add({.time = time, .positions = at.actual, .colliders = std::move(colliders)});
    } catch (const OutputError&) {
      whole_ = false;
    }
  }
  void finish(const View& first, const Eigen::Vector3d& up, DifferenceAnimation& made) {
    if (!whole_ || actual_.frames() == 0) return;
    made.expected = expected_.finish(first, up);
    made.actual = actual_.finish(first, up);
  }

 private:
  static FilmInfo film(const Scene& scene, const Golden& golden) {
    FilmInfo film;
    film.scene = scene.name;
    film.fps = motion_rate;
    film.seconds_per_frame = golden.step * static_cast<double>(golden.window_steps) / 2;  // middles and ends of windows
    film.cloth = &scene.simulation.cloth;
    film.look = &scene.look;
    return film;
  }

  FilmInfo film_;
  MotionPacker expected_{film_}, actual_{film_};
  bool whole_ = true;
};

/// @param first the first window to show
/// @param made  gets the motions for interactive viewing
std::vector<Pair> motion_pairs(const Scene& scene, const Golden& golden, std::size_t first, const Eigen::Vector2i& size,
                               PlayedMotion* recorded, GlBackend backend, DifferenceAnimation& made) {
  DrawFrames drawing(scene, size, backend);
  const System system = make_system(scene.simulation);
  Players players(scene, golden);
  std::vector<Pair> pairs;
  for (std::size_t i = first; i < std::min(first + most_windows, golden.windows.size() - 1); ++i) {
    const auto window =
        recorded != nullptr ? played_window(*recorded, golden, i) : rerun_window(scene.simulation, golden, i);
    for (const WindowPositions& at : window) {
      if (i > 0 && at.step == golden.windows[i].start.step) continue;  // same state in both motions
      const double time = static_cast<double>(at.step) * golden.step;
      const View& view = view_near(golden, time);
      pairs.push_back({drawing.draw(view, 0, time, at.golden), drawing.draw(view, 0, time, at.actual)});
      players.add(time, at, system.colliders_at(time));
    }
  }
  const double begin = static_cast<double>(golden.windows[first].start.step) * golden.step;
  players.finish(view_near(golden, begin), scene.camera.up, made);
  return pairs;
}

/// Returns one amplification factor for all frames, so that the growth of the difference is visible.
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

/// Returns the pair with the largest difference.
std::size_t most_different(const std::vector<Pair>& pairs) {
  const auto difference = [](const Pair& pair) { return summed_difference(pair.expected, pair.actual); };
  return static_cast<std::size_t>(std::ranges::max_element(pairs, {}, difference) - pairs.begin());
}

Image side_by_side(const Pair& pair, double factor) {
  const Image difference = amplified_difference(pair.expected, pair.actual, factor);
  return montage({&pair.expected, &pair.actual, &difference}, 3, gap, gap_gray);
}

}  // namespace

DifferenceAnimation difference_animation(const Scene& scene, const Golden& golden, const SceneResult& result,
                                         PlayedMotion* recorded, GlBackend backend,
                                         const std::filesystem::path& folder) {
  const Comparison& shown = result.windows.first_bad_frame || !result.end_to_end ? result.windows : *result.end_to_end;
  if (!shown.first_bad_frame) return {};
  const auto changed = std::find_if(shown.windows.begin(), shown.windows.end(), [](const WindowResult& window) {
    return window.verdict == MotionVerdict::changed;
  });
  const bool moved = changed != shown.windows.end();
  const Eigen::Vector2i size(result.size[0], result.size[1]);
  const auto at = static_cast<std::size_t>(changed - shown.windows.begin());
  DifferenceAnimation made;
  const std::vector<Pair> pairs = moved ? motion_pairs(scene, golden, at, size, recorded, backend, made)
                                        : picture_pairs(shown.frames, *shown.first_bad_frame);
  if (pairs.empty()) return {};

  const std::filesystem::path file = folder / result.name / "difference.gif";
  const double factor = common_amplification(pairs);
  made.film = write_page_film(file, moved ? motion_rate : picture_rate,
                              {.count = pairs.size(),
                               .first = most_different(pairs),
                               .picture = [&](std::size_t i) { return side_by_side(pairs[i], factor); },
                               .columns = 1,
                               .gap = gap,
                               .gray = gap_gray});
  return made;
}

}  // namespace drape
