#include "run/motion_recorder.hpp"

#include <cmath>
#include <utility>

#include "sim/system.hpp"

namespace drape {
namespace {

constexpr std::size_t tasks_in_flight = 8;

/// Returns true if a frame needs the state after this step: it lies at the step's end or less than a step away.
bool is_near_frame(const FilmExtent& extent, std::int64_t step) {
  constexpr double nearly_a_step = 1 - 1e-10;
  const double time = static_cast<double>(step) * extent.step, reach = nearly_a_step * extent.step;
  return std::floor((time - reach) / extent.seconds_per_frame) + 1 <=
         std::ceil((time + reach) / extent.seconds_per_frame) - 1;
}

MotionFileWriter make_writer(const MotionOptions& options, const ResumePoint* from, const LoadedScene& scene,
                             const FilmExtent& extent) {
  if (from != nullptr) return MotionFileWriter(options.path, *from);
  const MotionHeader header{.steps = extent.steps,
                            .recorded = options.recorded,
                            .colliders = collider_kinds(make_system(scene.simulation).colliders_at(0))};
  return MotionFileWriter(options.path, header, scene);
}

}  // namespace

MotionRecorder::MotionRecorder(const MotionOptions& options, const ResumePoint* from, const LoadedScene& scene,
                               const FilmExtent& extent, const Statistics& statistics, std::function<void()> given_up)
    : options_(options),
      extent_(extent),
      statistics_(statistics),
      given_up_(std::move(given_up)),
      writer_(make_writer(options, from, scene, extent)),
      kept_(std::chrono::steady_clock::now()),
      tasks_(tasks_in_flight),
      begun_(from != nullptr),
      thread_([this] { write(); }) {}

MotionRecorder::~MotionRecorder() {
  tasks_.close();
  if (thread_.joinable()) thread_.join();
  if (!finished_) discard_if_empty();
}

/// Deletes the file if no step was done, since nothing is lost then.
void MotionRecorder::discard_if_empty() {
  if (statistics_.steps() == 0 && !begun_) writer_.discard();
}

void MotionRecorder::begin(const Simulation& simulation) {
  if (begun_) return;
  add(simulation, {});
  keep(simulation);
}

void MotionRecorder::after_step(const Simulation& simulation, const StepReport& report, double /*seconds*/) {
  add(simulation, report);
  const auto now = std::chrono::steady_clock::now();
  const bool last = simulation.state().step == extent_.steps;  // a complete motion needs no checkpoint
  if (last || std::chrono::duration<double>(now - kept_).count() < options_.checkpoint_seconds) return;
  keep(simulation);
  kept_ = now;
}

void MotionRecorder::add(const Simulation& simulation, const StepReport& report) {
  const std::int64_t step = simulation.state().step;
  tasks_.push([row = StepRow{.step = step,
                             .energies = simulation.energies(),
                             .iterations = report.iterations,
                             .converged = report.converged,
                             .substeps = report.substeps,
                             .estimate = report.estimate,
                             .residual = step == 0 ? 0 : simulation.residual(),
                             .error = step == 0 ? std::nullopt : statistics_.exactness().error_of(step),
                             .colliders = simulation.colliders(simulation.time()),
                             .cloths = simulation.cloth().pieces.size() > 1
                                           ? simulation.piece_energies()
                                           : std::vector<Energies>()}](MotionFileWriter& to) { to.add(row); });
  if (is_recorded(step)) tasks_.push([state = simulation.state()](MotionFileWriter& to) { to.add(state); });
}

bool MotionRecorder::is_recorded(std::int64_t step) const {
  if (step == 0 || step == extent_.steps) return true;
  return options_.recorded.every ? step % *options_.recorded.every == 0 : is_near_frame(extent_, step);
}

void MotionRecorder::keep(const Simulation& simulation) {
  tasks_.push([checkpoint = simulation.checkpoint(), times = statistics_.microseconds()](MotionFileWriter& to) {
    to.keep(checkpoint, times);
  });
}

void MotionRecorder::write() {
  try {
    while (const std::optional<Task> task = tasks_.pop()) (*task)(writer_);
    return;
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
  tasks_.close();
  given_up_();
}

MotionOutcome MotionRecorder::finish(bool whole, const Simulation* last, std::vector<std::string>& problems) {
  if (!whole && last != nullptr) keep(*last);
  tasks_.close();
  if (thread_.joinable()) thread_.join();
  MotionOutcome outcome{.complete = {}, .growing = {}, .file = options_.path};
  try {
    if (problem_.empty() && whole) outcome.complete = OutputFile{options_.path, writer_.finish()};
  } catch (const Error& error) {
    problem_ = error.what();
  }
  if (!problem_.empty()) problems.push_back(problem_);
  if (!outcome.complete) {
    discard_if_empty();
    if (statistics_.steps() > 0) outcome.growing = growing_name(options_.path).string();
  }
  finished_ = true;  // the statistics may have moved away from here on
  return outcome;
}

}  // namespace drape
