#include "check/record_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "check/chained_motion.hpp"
#include "check/played_motion.hpp"
#include "check/survey_motion.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "render/camera_path.hpp"
#include "run/frame_sampler.hpp"
#include "run/frame_tape.hpp"
#include "run/known_film.hpp"
#include "run/run_steps.hpp"

namespace drape {
namespace {

FilmExtent whole_film(const Scene& scene) {
  return FilmExtent(scene.video, scene.simulation.step, scene.step_count(), std::nullopt);
}

/// Observer that stores the windows of a motion.
class Recorder final : public StepObserver {
 public:
  /// @param recorded source of the energies; null: the simulation
  Recorder(const std::vector<std::int64_t>& starts, const RoundingUnits& quanta, PlayedMotion* recorded)
      : starts_(starts), quanta_(quanta), recorded_(recorded) {}

  void begin(const Simulation& simulation) override {
    GoldenWindow& window = windows.emplace_back();
    window.start = simulation.state();
    window.energies = energies(simulation);
  }

  void after_step(const Simulation& simulation, const StepReport&, double) override {
    GoldenWindow& window = windows.back();
    GoldenStep& step = window.steps.emplace_back();
    step.hash = step_hash(simulation);
    step.bodies = rounded(body_numbers(simulation), quanta_.compared);
    body_count = std::max(body_count, static_cast<int>(step.bodies.size()));
    const std::int64_t end = starts_[windows.size()], now = simulation.state().step;
    if (now == window.start.step + (end - window.start.step) / 2) {
      window.middle = rounded(simulation.state().x, quanta_.compared);
    }
    if (now == end) window.energies = energies(simulation);
  }

  std::vector<GoldenWindow> windows;
  int body_count = 0;

 private:
  [[nodiscard]] Energies energies(const Simulation& simulation) const {
    return recorded_ != nullptr ? recorded_->energies(simulation.state().step) : simulation.energies();
  }

  const std::vector<std::int64_t>& starts_;
  RoundingUnits quanta_;
  PlayedMotion* recorded_;
};

/// Returns the index distance between rows of a grid mesh: the most frequent distance of a spring's ends except 1.
int row_of(const Cloth& cloth) {
  std::map<int, int> count;
  for (const Spring& spring : cloth.springs) ++count[spring.j - spring.i];
  count.erase(1);
  const auto commonest =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return commonest == count.end() ? 1 : commonest->first;
}

/// Returns the known parts of a golden before its motion is run.
Golden described(const Scene& scene, const CheckSettings& settings, const RecordPlan& plan) {
  Golden golden;
  golden.scene_digest = scene.digest;
  golden.size = picture_size(scene, settings);
  golden.step = scene.simulation.step;
  golden.step_count = scene.step_count();
  golden.window_steps = plan.window_steps;
  golden.vertex_count = scene.simulation.cloth.vertex_count();
  golden.row = row_of(scene.simulation.cloth);
  golden.camera = scene.camera;
  golden.seconds_per_frame = whole_film(scene).seconds_per_frame;
  golden.film = film_of(scene);
  if (scene.choice) {
    const IntegratorSettings& integrator = scene.simulation.integrator;
    golden.method = {.method = integrator.method, .substeps = integrator.substeps};
  }
  golden.quanta = plan.quanta;
  for (const ChosenFrame& chosen : plan.frames) {
    golden.frames.push_back(
        {.frame = chosen.frame, .time = whole_film(scene).time(chosen.frame), .why = chosen.why, .x = {}});
  }
  return golden;
}

}  // namespace

GoldenFilm film_of(const Scene& scene) {
  return {.fps = scene.video.fps, .speed = scene.video.speed, .size = scene.video.size, .samples = scene.look.samples};
}

Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings) {
  return settings.size.value_or(scene.video.size);
}

std::optional<RecordPlan> plan_recording(const Scene& scene, const CheckSettings& settings, const std::stop_token& stop,
                                         Progress& progress, PlayedMotion* recorded) {
  const FilmExtent film = whole_film(scene);
  RecordPlan plan;
  plan.window_steps = std::max<std::int64_t>(1, std::llround(std::min(settings.window_time / film.step, 1e9)));
  plan.quanta = quanta_for(scene.simulation, settings.motion_tolerance);
  for (const int frame : settings.frames) {
    if (frame > film.frames.last) {
      throw UsageError(fmt::format("{}: frame {} cannot be compared: the film ends with frame {}", shown(scene.file),
                                   frame, film.frames.last));
    }
    plan.frames.push_back({frame, "named by the scene"});
  }
  if (!plan.frames.empty()) return plan;
  const std::optional<FilmFacts> facts = survey_motion(scene, plan.window_steps, plan.quanta, stop, progress, recorded);
  if (!facts) return std::nullopt;
  plan.frames = choose_frames(*facts);
  return plan;
}

RecordPlan plan_of(const Golden& golden) {
  RecordPlan plan{.frames = {}, .window_steps = golden.window_steps, .quanta = golden.quanta};
  for (const GoldenFrame& frame : golden.frames) plan.frames.push_back({frame.frame, frame.why});
  return plan;
}

std::vector<View> views_of_frames(const Scene& scene, const Eigen::Vector2i& size,
                                  const std::vector<GoldenFrame>& frames) {
  if (frames.empty()) return {};
  const Simulation simulation(scene.simulation);
  const auto pass = [&](const std::function<void(const Frame&)>& visit) {
    for (const GoldenFrame& frame : frames) {
      visit({.index = frame.frame,
             .time = frame.time,
             .positions = frame.x,
             .colliders = simulation.colliders(frame.time)});
    }
  };
  const int count = static_cast<int>(frames.size());
  const CameraPath path = camera_path(scene.camera, known_film(scene, size, count, pass));
  std::vector<View> views;
  for (int i = 0; i < count; ++i) views.push_back(path.at(i));
  return views;
}

std::optional<Golden> record_motion(const Scene& scene, const CheckSettings& settings, const RecordPlan& plan,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  Golden golden = described(scene, settings, plan);
  const FilmExtent film = whole_film(scene);
  FrameTape tape;
  auto wanted = golden.frames.begin();
  FrameSampler sampler(film, [&](Frame frame) {
    if (wanted != golden.frames.end() && wanted->frame == frame.index) {
      wanted++->x = rounded(frame.positions, plan.quanta.position);
    }
    tape.add(std::move(frame));
  });
  const std::vector<std::int64_t> starts = window_starts(film.steps, plan.window_steps);
  Recorder recorder(starts, plan.quanta, recorded);
  StepCounter counter(progress);
  progress.begin(recorded != nullptr ? "reading" : "simulating", "steps", film.steps);
  const std::array<StepObserver*, 3> observers{&recorder, &counter, &sampler};
  Simulation simulation(scene.simulation);
  if (recorded != nullptr) {
    play_chained(*recorded, simulation, starts, plan.quanta, observers, stop);
  } else {
    run_chained(simulation, starts, plan.quanta, observers, stop);
  }
  if (stop.stop_requested()) return std::nullopt;

  const auto pass = [&tape](const auto& visit) { tape.for_each(visit); };
  const CameraPath path = camera_path(scene.camera, known_film(scene, golden.size, tape.count(), pass));
  for (GoldenFrame& frame : golden.frames) frame.view = path.at(frame.frame);
  golden.frames_views = views_of_frames(scene, golden.size, golden.frames);
  golden.windows = std::move(recorder.windows);
  golden.body_count = recorder.body_count;
  return golden;
}

}  // namespace drape
