#pragma once

#include <array>
#include <string>
#include <vector>

#include "run/run_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {

/// A cloth that swings above a moving ball and over a ground. Frames fall on steps and between them.
const std::string moving_scene = R"(
[cloth]
mesh = { grid = [4, 3] }
stiffness = 50
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 0.4
[video]
fps = 20
[look]
color = "#ff8000"
[effects.gravity]
[effects.sphere]
center = [0, 0, -0.5]
radius = 0.3
velocity = [0.5, 0, 0]
[effects.ground]
height = -1.25
)";

/// Result of writing a motion, and the expected frames.
struct WrittenMotion {
  RunResult result;
  std::vector<Frame> frames;
};

/// Runs a scene with outputs, and again without any.
inline WrittenMotion write_motion(const LoadedScene& scene, const std::vector<std::string>& outputs,
                                  const RunOptions& other = {}) {
  RunOptions options = other;
  options.outputs = outputs;
  Progress progress;
  WrittenMotion written{.result = run_scene(scene, options, {}, progress), .frames = {}};
  const FilmExtent film(scene.video, scene.simulation.step, scene.step_count(), options.frames, options.every);
  FrameSampler sampler(
      film, [&](Frame frame) { written.frames.push_back(std::move(frame)); }, FrameContents::motion);
  Simulation simulation(scene.simulation);
  run_steps(simulation, film.steps, std::array<StepObserver*, 1>{&sampler}, {});
  return written;
}

/// Reads a number at an offset of a file's bytes.
template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number number{};
  EXPECT_LE(offset + sizeof number, bytes.size());
  if (offset + sizeof number <= bytes.size()) bytes.copy(reinterpret_cast<char*>(&number), sizeof number, offset);
  return number;
}

/// Reads vertices from a file's numbers, x, y, z of each.
template <class Number>
Vertices vertices_at(const std::string& bytes, std::size_t offset, Eigen::Index count) {
  Vertices vertices(count, 3);
  for (Eigen::Index i = 0; i < 3 * count; ++i) {
    vertices(i / 3, i % 3) = number_at<Number>(bytes, offset + static_cast<std::size_t>(i) * sizeof(Number));
  }
  return vertices;
}

}  // namespace drape::test
