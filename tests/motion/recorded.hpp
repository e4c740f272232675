#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "motion/reader.hpp"
#include "run/run_scene.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {

/// Requests a stop after a step.
class StopAfter final : public StepObserver {
 public:
  explicit StopAfter(std::int64_t step) : step_(step) {}
  void after_step(const Simulation& simulation, const StepReport&, double) override {
    if (simulation.state().step == step_) stop_.request_stop();
  }
  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  std::int64_t step_;
  std::stop_source stop_;
};

/// Runs a scene and writes a motion file.
/// @param stop_after step at which it stops; 0: the last
inline RunResult record(const LoadedScene& scene, const std::string& file, RunOptions options = {},
                        std::int64_t stop_after = 0) {
  if (!options.motion) options.motion.emplace();
  options.motion->path = file;
  StopAfter stop(stop_after);
  options.observer = &stop;
  Progress progress;
  return run_scene(scene, options, stop.token(), progress);
}

/// Resumes a recorded motion.
inline RunResult resume(const std::string& file, RunOptions options = {}, std::int64_t stop_after = 0) {
  const auto from = std::make_shared<const ResumePoint>(read_resumption(file));
  const MotionScene folder(*from->partial);
  options.from = from;
  options.steps = from->partial->header().steps;
  options.motion = MotionOptions{.path = file, .recorded = from->partial->header().recorded};
  return record(folder.scene(), file, options, stop_after);
}

/// A cloth that swings on its pins past a moving sphere.
const std::string recorded_scene = R"(
[cloth]
mesh = { grid = [5, 4] }
stiffness = 50
pins = ["corner:x-y-", "corner:x+y-"]
[time]
step = 0.02
duration = 1
[video]
fps = 20
size = [64, 48]
[effects.gravity]
[effects.sphere]
center = [0, 0, -0.5]
radius = 0.3
velocity = [0.1, 0.2, 0]
)";

}  // namespace drape::test
