// The cloth is the subject of the showcase, so it fills much of the golden pictures. They are moments of each film, not
// its average: films that come to rest early show less cloth. Whole films take minutes, at night.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "check/draw_frames.hpp"
#include "check/golden.hpp"
#include "drape/render/renderer.hpp"
#include "drape/scene/scene.hpp"
#include "render/camera_path.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"

namespace drape::coverage {
namespace {

namespace fs = std::filesystem;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Draws green cloth, red objects and a blue background, without shadows.
Look signal_colors() {
  Look look;
  look.color = {0, 1, 0};
  look.sphere_color = look.body_color = look.ground_color = {1, 0, 0};
  look.background = Rgb{0, 0, 1};
  look.shadows = look.ambient_occlusion = false;
  look.thickness = 0;
  look.samples = 1;
  return look;
}

/// Returns the fraction of green pixels.
double green(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      count += pixel[1] > std::max(pixel[0], pixel[2]) ? 1 : 0;
    }
  }
  return count / static_cast<double>(image.width * image.height);
}

/// Returns the median of the cloth's fraction of the picture over a scene's golden frames.
double coverage(const fs::path& file) {
  Scene scene = load_scene(file);
  scene.look = signal_colors();
  const Golden golden = read_golden(golden_folder(file));
  DrawFrames drawing(scene, golden.size, GlBackend::automatic);
  std::vector<double> fractions;
  for (const GoldenFrame& frame : golden.frames) {
    fractions.push_back(green(drawing.draw(frame.view, frame.frame, frame.time, frame.x)));
  }
  return median(fractions);
}

TEST(Coverage, OfTheShowcasesGoldenPicturesIsThirtyPercentInTheMedian) {
  std::vector<double> medians;
  for (const auto& entry : fs::directory_iterator(fs::path(DRAPE_SOURCE_DIR) / "scenes/showcase")) {
    if (entry.path().extension() != ".toml") continue;
    medians.push_back(coverage(entry.path()));
    RecordProperty(entry.path().stem().string(), std::to_string(medians.back()));
    EXPECT_GT(medians.back(), 0.1) << entry.path();
  }
  ASSERT_GE(medians.size(), 10U);
  EXPECT_GE(median(medians), 0.3);
}

/// Returns every frame of a scene's film.
std::vector<Frame> film_frames(const Scene& scene) {
  const auto last = static_cast<int>(scene.video.last_frame(scene.duration));
  const auto steps = static_cast<std::int64_t>(std::llround(scene.duration / scene.simulation.step));
  const FilmExtent extent(scene.video, scene.simulation.step, steps, FrameRange{0, last});
  std::vector<Frame> frames;
  FrameSampler sampler(extent, [&](Frame frame) { frames.push_back(std::move(frame)); });
  const std::array<StepObserver*, 1> observers{&sampler};
  Simulation simulation(scene.simulation);
  run_steps(simulation, extent.steps, observers, {});
  return frames;
}

/// Returns the median of the cloth's fraction of the picture over all frames of a scene's film.
double coverage_of_film(const fs::path& file) {
  Scene scene = load_scene(file);
  Look look = signal_colors();
  std::swap(look, scene.look);
  const std::vector<Frame> frames = film_frames(scene);
  const KnownFilm film{.aspect = scene.video.size.cast<double>().x() / scene.video.size.y(),
                       .fps = scene.video.fps,
                       .count = static_cast<int>(frames.size()),
                       .triangles = scene.simulation.cloth.triangles,
                       .start = scene.simulation.cloth.positions,
                       .look = look,
                       .pass = [&](const auto& visit) { std::ranges::for_each(frames, visit); }};
  const CameraPath path = camera_path(scene.camera, film);
  constexpr double pixels = 12000;
  const double smaller = std::sqrt(pixels / scene.video.size.cast<double>().prod());
  const Eigen::Vector2i size = (smaller * scene.video.size.cast<double>()).array().round().cast<int>();
  Renderer renderer(DRAPE_SOURCE_DIR, size, path.at(0), scene.look, scene.simulation.cloth.vertex_count(),
                    scene.simulation.cloth.triangles, scene.uvs);
  std::vector<double> fractions;
  for (const Frame& frame : frames) {
    renderer.look_from(path.at(static_cast<int>(fractions.size())));
    fractions.push_back(green(renderer.draw(frame)));
  }
  return median(fractions);
}

class CoverageOfFilms : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Nightly, CoverageOfFilms, testing::Values("showcase", "validation"));

// Validation also has threads and bobs, which no picture can fill.
TEST_P(CoverageOfFilms, IsThirtyPercentInTheMedian) {
  std::vector<double> medians;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(DRAPE_SOURCE_DIR) / "scenes" / GetParam())) {
    if (entry.path().extension() != ".toml") continue;
    medians.push_back(coverage_of_film(entry.path()));
    RecordProperty(entry.path().stem().string(), std::to_string(medians.back()));
  }
  ASSERT_GE(medians.size(), 10U);
  EXPECT_GE(median(medians), 0.3);
}

}  // namespace
}  // namespace drape::coverage
