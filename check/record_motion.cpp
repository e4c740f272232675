#include "check/record_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "run/frame_sampler.hpp"
#include "run/run_steps.hpp"

namespace drape {
namespace {

constexpr int default_frames = 8;
constexpr double rounding = 1e-9;  // of times that are products of decimal fractions, in steps

FilmExtent whole_film(const Scene& scene) {
  return FilmExtent(scene.video, scene.simulation.step, scene.step_count(), std::nullopt);
}

/// The last step that is not after a frame.
std::int64_t step_of(const FilmExtent& film, int frame) {
  return static_cast<std::int64_t>(std::floor(film.time(frame) / film.step + rounding));
}

/// Spread from the first frame to the last one after which a whole window fits.
std::vector<int> spread_frames(const FilmExtent& film, int window) {
  int last = film.frames.last;
  while (last > 0 && step_of(film, last) + window > film.steps) --last;
  std::vector<int> frames;
  for (int i = 0; i < default_frames; ++i) {
    const auto frame = static_cast<int>(std::lround(static_cast<double>(last) * i / (default_frames - 1)));
    if (frames.empty() || frame > frames.back()) frames.push_back(frame);
  }
  return frames;
}

/// Keeps what a plan asks for while the motion passes by.
class Recorder final : public StepObserver {
 public:
  explicit Recorder(const std::vector<WindowPlan>& plan) : plan_(plan) {}

  void begin(const Simulation& simulation) override { see(simulation); }
  void after_step(const Simulation& simulation, const StepReport&, double) override { see(simulation); }

  std::vector<GoldenWindow> windows;

 private:
  void see(const Simulation& simulation) {
    const State& state = simulation.state();
    for (std::size_t i = 0; i < windows.size(); ++i) extend(windows[i], plan_[i], simulation);
    while (windows.size() < plan_.size() && plan_[windows.size()].first == state.step) {
      const WindowPlan& plan = plan_[windows.size()];
      GoldenWindow& window = windows.emplace_back();
      window.frame = plan.frame;
      window.time = plan.time;
      window.start = state;
    }
  }

  static void extend(GoldenWindow& window, const WindowPlan& plan, const Simulation& simulation) {
    const State& state = simulation.state();
    const double h = simulation.settings().step;
    if (plan.frame && state.step == plan.first + 1 && plan.time > (static_cast<double>(plan.first) + rounding) * h) {
      window.shown = positions_at(plan.time, simulation, window.start.x);
    }
    if (state.step > plan.last) return;
    window.steps.push_back({state_bits(state), state.x, simulation.energies()});
  }

  const std::vector<WindowPlan>& plan_;
};

double aspect(const Eigen::Vector2i& size) { return static_cast<double>(size.x()) / size.y(); }

}  // namespace

Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings) {
  return settings.size.value_or(scene.video.size);
}

std::vector<WindowPlan> plan_windows(const Scene& scene, const CheckSettings& settings) {
  const FilmExtent film = whole_film(scene);
  std::vector<int> frames = settings.frames;
  if (frames.empty()) frames = spread_frames(film, settings.window);
  std::vector<WindowPlan> plan;
  const auto add = [&](std::optional<int> frame, double time, std::int64_t first) {
    plan.push_back({frame, time, first, std::min(first + settings.window, film.steps)});
  };
  if (frames.front() > 0) add(std::nullopt, 0, 0);
  for (const int frame : frames) {
    if (frame > film.frames.last) {
      throw UsageError(fmt::format("{}: frame {} is to be compared, the film ends with frame {}", scene.file.string(),
                                   frame, film.frames.last));
    }
    const FilmExtent extent(scene.video, film.step, film.steps, FrameRange{frame, frame});
    add(frame, extent.time(frame), step_of(extent, frame));
  }
  return plan;
}

View view_of_windows(const Camera& camera, const Eigen::Vector2i& size, const std::vector<GoldenWindow>& windows,
                     const Simulation& simulation) {
  if (!needs_motion(camera)) return fixed_view(camera);
  Framing framing(camera, aspect(size));
  for (const GoldenWindow& window : windows) {
    framing.add(window.picture_positions());
    for (const Collider& collider : simulation.colliders(window.time)) framing.add(collider);
  }
  return framing.view();
}

std::optional<Golden> record_motion(const Scene& scene, const CheckSettings& settings,
                                    const std::vector<WindowPlan>& plan, const std::stop_token& stop,
                                    Progress& progress) {
  Golden golden;
  golden.scene_digest = scene.digest;
  golden.size = picture_size(scene, settings);
  golden.step = scene.simulation.step;
  golden.step_count = scene.step_count();
  golden.vertex_count = scene.simulation.cloth.vertex_count();
  golden.camera = scene.camera;
  const FilmExtent film = whole_film(scene);
  golden.seconds_per_frame = film.seconds_per_frame;
  // A tenth of what is tolerated, so that the rounding decides nothing.
  golden.quantum = std::max(0.1 * settings.motion_tolerance, least_quantum);

  Framing framing(scene.camera, aspect(golden.size));
  FrameSampler sampler(film, [&](const Frame& frame) {
    framing.add(frame.positions);
    for (const Collider& collider : frame.colliders) framing.add(collider);
  });
  Recorder recorder(plan);
  StepCounter counter(progress);
  const bool framed = needs_motion(scene.camera);
  std::int64_t steps = framed ? film.steps : 0;
  for (const WindowPlan& window : plan) {
    // A picture between two steps needs the second of them.
    steps = std::max(steps, std::min(film.steps, std::max(window.last, window.first + 1)));
  }
  progress.begin("simulating", "steps", steps);
  std::vector<StepObserver*> observers{&recorder, &counter};
  if (framed) observers.push_back(&sampler);
  Simulation simulation(scene.simulation);
  run_steps(simulation, steps, observers, stop);
  if (stop.stop_requested()) return std::nullopt;

  golden.view = framed ? framing.view() : fixed_view(scene.camera);
  golden.windows = std::move(recorder.windows);
  if (!plan.empty()) golden.window_view = view_of_windows(scene.camera, golden.size, golden.windows, simulation);
  return golden;
}

}  // namespace drape
