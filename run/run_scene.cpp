#include "run/run_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "render/camera_path.hpp"
#include "run/bounded_queue.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "run/resources.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

class Watch final : public StepObserver {
 public:
  explicit Watch(const std::function<void(const StepReport&)>& after_step) : after_step_(after_step) {}
  void after_step(const Simulation&, const StepReport& report, double) override { after_step_(report); }

 private:
  const std::function<void(const StepReport&)>& after_step_;
};

/// Replays the earlier steps to the observers.
void replay(const ResumePoint& from, double h, std::span<StepObserver* const> observers) {
  if (from.checkpoint.state.step == 0) return;  // a new run
  for (std::int64_t step = 0; step <= from.checkpoint.state.step; ++step) {
    const StepRow& row = from.row(step);
    const double seconds =
        step == 0 ? 0 : 1e-6 * static_cast<double>(from.microseconds[static_cast<std::size_t>(step - 1)]);
    for (StepObserver* observer : observers) observer->replay(row, static_cast<double>(step) * h, seconds);
  }
}

}  // namespace

void require_whole(const ResumePoint& from, const Simulation& simulation) {
  const Simulation::Checkpoint& kept = from.checkpoint;
  const System system = make_system(simulation.settings());
  Restraint expected;
  for (const auto& filter : system.filters) {
    const Restraint* const restraint = filter->restraint();
    if (restraint != nullptr && kept.state.step > 0) expected = *restraint;
  }
  const Restraint& restraint = kept.state.restraint;
  const bool cut = simulation.settings().accuracy && kept.state.step > 0;
  if (kept.energy_memory.has_value() == simulation.checkpoint().energy_memory.has_value() &&
      restraint.tensions.size() == expected.tensions.size() &&
      restraint.acceleration.rows() == expected.acceleration.rows() && cut == (kept.state.substeps > 0)) {
    return;
  }
  throw UsageError(fmt::format("{}: cannot be resumed, because its checkpoint does not have all parts: simulate again",
                               shown(from.partial->file())));
}

Stop make_stop(const std::stop_token& stop) {
  return Stop([stop] { return stop.stop_requested(); });
}

void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop, const ResumePoint* from) {
  using Clock = std::chrono::steady_clock;
  if (from != nullptr) simulation.restore(from->checkpoint);
  for (StepObserver* observer : observers) observer->begin(simulation);
  if (from != nullptr) replay(*from, simulation.settings().step, observers);
  while (simulation.state().step < steps && !stop.stop_requested()) {
    const auto begin = Clock::now();
    StepReport report;
    try {
      report = simulation.step();
    } catch (const Interrupted&) {
      return;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    try {
      for (StepObserver* observer : observers) observer->after_step(simulation, report, seconds);
    } catch (const Interrupted&) {
      return simulation.undo_step();
    }
  }
}

void run_steps(Simulation& simulation, std::int64_t steps, const std::stop_token& stop,
               const std::function<void(const StepReport&)>& after_step) {
  if (!after_step) return run_steps(simulation, steps, std::span<StepObserver* const>(), stop);
  Watch watch(after_step);
  run_steps(simulation, steps, std::array<StepObserver*, 1>{&watch}, stop);
}

void run_on(const SimulationSettings& settings, const State& state, std::int64_t steps,
            const std::vector<StepObserver*>& observers, const std::stop_token& stop) {
  if (state.step >= steps) return;
  try {
    Simulation simulation(settings, Timing::none, make_stop(stop));
    simulation.restore(state);
    run_steps(simulation, steps, observers, stop);
  } catch (const DivergedError&) {
    // Show the steps before the divergence.
  } catch (const Interrupted&) {  // during setup
  }
}

void StepCounter::after_step(const Simulation& simulation, const StepReport&, double) {
  progress_.done = simulation.state().step;
}

namespace {

using Clock = std::chrono::steady_clock;

// Frames in flight between two stages: enough to absorb an uneven step or frame, few enough for the memory.
constexpr std::size_t queue_capacity = 8;
// Maximum drawing time after an interruption [s].
constexpr double longest_wait = 5;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// The three threads of a run and the queues between them.
class Pipeline {
 public:
  Pipeline(const LoadedScene& scene, const RunOptions& options, const std::stop_token& stop, Progress& progress)
      : scene_(scene),
        options_(options),
        progress_(progress),
        extent_(film_extent(scene, options)),
        outputs_(options.outputs, film_info(scene, options, &progress), options.poster, options.start_at_poster),
        drawn_(outputs_.drawn()),
        records_(options.records),
        reasons_(!outputs_.none(), options.motion.has_value(), records_.wanted()),
        pass_on_(stop, [this] { stop_.request_stop(); }) {
    if (drawn_ && Annotations::wanted(scene)) annotations_.emplace(scene);
    result_.steps_wanted = extent_.steps;
    result_.recorded = options.recorded != nullptr;
    if (!outputs_.none()) result_.frames_wanted = extent_.frames.count();
    const Timing timing = options.time_effects ? Timing::effects : Timing::none;
    if (!options.recorded) {
      simulation_.emplace(with_threads(scene.simulation, options.threads, drawn_), timing,
                          make_stop(stop_.get_token()));
    }
    if (options.from && simulation_) require_whole(*options.from, *simulation_);
    if (!options.motion) return;
    recorder_.emplace(*options.motion, options.from.get(), scene, extent_, result_.statistics, [this] {
      if (reasons_.lose_motion()) stop_.request_stop();
    });
  }

  RunResult run() {
    const auto begin = Clock::now();
    std::vector<std::jthread> threads;
    try {
      // Consumers start first: if a thread cannot be created, those that run end when their queues close.
      if (result_.frames_wanted > 0) threads.emplace_back([this] { guarded(&Pipeline::write); });
      if (drawn_) threads.emplace_back([this] { guarded(&Pipeline::draw); });
      threads.emplace_back([this] { guarded(&Pipeline::simulate); });
    } catch (...) {
      fail();
    }
    threads.clear();  // joins them
    if (error_) std::rethrow_exception(error_);
    finish_motion();
    if (reasons_.none()) throw OutputError(fmt::format("{}", fmt::join(result_.problems, "\n")));
    if (simulation_) finish_records();
    result_.elapsed_seconds = seconds_since(begin);
    return std::move(result_);
  }

 private:
  /// Runs the work of one thread; an exception ends the whole run.
  void guarded(void (Pipeline::*work)()) {
    try {
      (this->*work)();
    } catch (...) {
      fail();
    }
  }

  /// Ends the run with the current exception, unless an earlier one is stored.
  void fail() {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::current_exception();
    stop_.request_stop();
    close_queues();
    film_.close();
  }

  void finish_motion() {
    result_.problems = outputs_.problems();
    if ((!all_steps_done_ || truncated_) && result_.outcome == Outcome::completed)
      result_.outcome = Outcome::interrupted;
    if (!recorder_) return;
    const Simulation* last = result_.outcome == Outcome::diverged ? nullptr : &*simulation_;
    result_.motion = recorder_->finish(all_steps_done_, last, result_.problems);
  }

  void finish_records() {
    if (result_.outcome == Outcome::interrupted && result_.statistics.steps() == 0) return;
    result_.records = records_.finish(*simulation_, result_.statistics, outcome_name(result_.outcome),
                                      all_steps_done_ ? Ending::complete : Ending::early, result_.problems);
  }

  void simulate() {
    if (options_.recorded) return play();
    std::vector<StepObserver*> observers{&result_.statistics};
    if (recorder_) observers.push_back(&*recorder_);
    for (StepObserver* record : records_.observers()) observers.push_back(record);
    if (options_.observer != nullptr) observers.push_back(options_.observer);
    const bool first = drawn_ && ((annotations_ && annotations_->needs_motion()) || needs_motion(scene_.camera));
    first ? simulate_then_draw(std::move(observers)) : simulate_and_draw(std::move(observers));
    close_queues();
  }

  /// Sends each frame as soon as the motion has reached it.
  void simulate_and_draw(std::vector<StepObserver*> observers) {
    FrameSampler sampler(
        extent_, [this](Frame frame) { send(std::move(frame)); }, contents());
    StepCounter counter(progress_);
    if (result_.frames_wanted > 0) {
      if (drawn_) place_camera(whole_extent(scene_, options_).frames.count(), {});
      progress_.begin(drawn_ ? "drawing" : "simulating", "frames", extent_.frames.count());
      observers.push_back(&sampler);
    } else {
      progress_.begin("simulating", "steps", extent_.steps);
      observers.push_back(&counter);
    }
    take_steps(observers);
  }

  /// Surveys the whole motion before drawing, for a camera or annotations that depend on it. So a frame looks the same
  /// in every range of frames. After an interruption, draws the steps done so far as if they were the whole motion.
  void simulate_then_draw(std::vector<StepObserver*> observers) {
    FrameTape tape;
    const FilmExtent whole = whole_extent(scene_, options_);
    const auto keep = [&](Frame frame) {
      if (annotations_ && annotations_->needs_motion()) annotations_->survey(frame);
      tape.add(std::move(frame));
    };
    FrameSampler sampler(whole, keep, contents());
    StepCounter counter(progress_);
    observers.insert(observers.end(), {&sampler, &counter});
    progress_.begin("simulating", "steps", whole.steps);
    take_steps(observers);
    if (all_steps_done_)
      run_on(scene_.simulation, simulation_->state(), whole.steps, {&sampler, &counter}, stop_.get_token());
    truncated_ = stop_.stop_requested();
    if (tape.count() == 0) return;
    place_camera(tape.count(), [&tape](const auto& visit) { tape.for_each(visit); });
    progress_.begin("drawing", "frames", std::min(extent_.frames.count(), tape.count()));
    const auto begin = Clock::now();
    const bool until_here = truncated_;
    tape.for_each([&](const Frame& frame) {
      if (frame.index < extent_.frames.first || frame.index > extent_.frames.last) return;
      truncated_ = truncated_ || stop_.stop_requested();
      if (!truncated_ || (until_here && seconds_since(begin) < longest_wait)) frames_.push(frame);
    });
  }

  void take_steps(const std::vector<StepObserver*>& observers) {
    try {
      run_steps(*simulation_, extent_.steps, observers, stop_.get_token(), options_.from.get());
      if (simulation_->state().step < extent_.steps) return;
      result_.statistics.finish(*simulation_);
      all_steps_done_ = true;
      if (const auto instability = result_.statistics.instability()) {
        result_.outcome = Outcome::diverged;
        result_.divergence = *instability;
      }
    } catch (const Interrupted&) {  // during the error estimate of the last step
    } catch (const DivergedError& diverged) {
      result_.outcome = Outcome::diverged;
      result_.divergence = diverged.what();
    }
  }

  void place_camera(int count, decltype(KnownFilm::pass) pass) {
    path_.push(camera_path(scene_.camera, known_film(scene_, scene_.video.size, count, std::move(pass))));
  }

  /// Returns the frame data that outputs and annotations need.
  [[nodiscard]] FrameContents contents() const {
    return std::max(outputs_.contents(), annotations_ ? annotations_->contents() : FrameContents::places);
  }

  /// Replaces simulate() for a motion file, which is read once per pass.
  void play() {
    const auto read = [this](const FilmExtent& extent, const auto& visit) {
      sample_motion(*options_.recorded, scene_, extent, contents(), visit, stop_.get_token());
      if (stop_.stop_requested()) throw Interrupted();  // a camera needs the whole motion
    };
    const FilmExtent whole = whole_extent(scene_, options_);
    progress_.begin(drawn_ ? "drawing" : "reading", "frames", extent_.frames.count());
    try {
      if (annotations_ && annotations_->needs_motion()) {
        read(whole, [this](const Frame& frame) { annotations_->survey(frame); });
      }
      if (drawn_) place_camera(whole.frames.count(), [&](const auto& visit) { read(whole, visit); });
      read(extent_, [this](Frame frame) { send(std::move(frame)); });
      all_steps_done_ = true;
    } catch (const Interrupted&) {  // the frames sent so far are drawn and written
    }
    close_queues();
  }

  void send(Frame frame) { drawn_ ? frames_.push(std::move(frame)) : film_.push({std::move(frame), std::nullopt}); }

  /// Closes the queues at the source. Frames on their way are still drawn and written.
  void close_queues() {
    path_.close();
    frames_.close();
    if (!drawn_) film_.close();
  }

  void draw() {
    if (const std::optional<CameraPath> path = path_.pop()) paint(*path);
    film_.close();  // after the painter has released OpenGL
  }

  void paint(const CameraPath& path) {
    FilmPainter painter(scene_, path, annotations_, options_.backend);
    result_.renderer = painter.description();
    // Hold back a frame that no output needs: the last frame of a film that ends early must be drawn.
    std::optional<Frame> held;
    while (std::optional<Frame> frame = next_frame(painter)) {
      if (held) film_.push({std::move(*std::exchange(held, {})), std::nullopt});
      if (outputs_.needs_picture(frame->index - extent_.frames.first)) {
        paint(painter, std::move(*frame));
      } else {
        finish_picture(painter);
        held = std::move(frame);
      }
    }
    if (held) paint(painter, std::move(*held));
    finish_picture(painter);
  }

  /// Takes the next frame; finishes the picture before it rather than wait.
  std::optional<Frame> next_frame(FilmPainter& painter) {
    if (frames_.empty()) finish_picture(painter);
    return frames_.pop();
  }

  void paint(FilmPainter& painter, Frame frame) {
    if (stop_drawing_.stop_requested()) {
      finish_picture(painter);
      film_.push({std::move(frame), std::nullopt});
      return;
    }
    const auto begin = Clock::now();
    std::optional<FilmFrame> previous = painter.start(std::move(frame));
    result_.draw_seconds += seconds_since(begin);
    if (previous) film_.push(std::move(*previous));
  }

  void finish_picture(FilmPainter& painter) {
    const auto begin = Clock::now();
    std::optional<FilmFrame> last = painter.finish();
    result_.draw_seconds += seconds_since(begin);
    if (last) film_.push(std::move(*last));
  }

  void write() {
    while (const std::optional<FilmFrame> frame = film_.pop()) {
      const auto begin = Clock::now();
      outputs_.add(*frame);
      result_.write_seconds += seconds_since(begin);
      if (outputs_.none()) return stop_writing();
      if (!outputs_.drawn()) stop_drawing_.request_stop();
      progress_.done = ++result_.frames;
    }
    if (const std::scoped_lock lock(mutex_); error_) return;
    const auto begin = Clock::now();
    const bool complete = result_.frames == result_.frames_wanted && !truncated_;
    result_.outputs = outputs_.finish(complete ? Ending::complete : Ending::early);
    result_.write_seconds += seconds_since(begin);
    if (outputs_.none()) stop_writing();
  }

  /// Ends the run when no output is left, unless its records or motion file still need it.
  void stop_writing() {
    close_queues();
    film_.close();
    if (reasons_.lose_outputs()) stop_.request_stop();
  }

  const Scene& scene_;
  const RunOptions& options_;
  Progress& progress_;
  FilmExtent extent_;
  std::optional<Simulation> simulation_;  // absent if the motion is in a file
  Outputs outputs_;
  const bool drawn_;  // true if any output needs rendering
  Records records_;
  RunPurposes reasons_;
  std::optional<Annotations> annotations_;  // absent if nothing is drawn or the scene asks for none
  std::optional<MotionRecorder> recorder_;
  BoundedQueue<CameraPath> path_{1};
  BoundedQueue<Frame> frames_{queue_capacity};
  BoundedQueue<FilmFrame> film_{queue_capacity};
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> pass_on_;
  std::stop_source stop_drawing_;  // stops the drawing when no output takes images any more
  std::mutex mutex_;
  std::exception_ptr error_;
  bool all_steps_done_ = false;  // every step was taken
  bool truncated_ = false;       // some frames are missing, or were drawn without the whole motion
  RunResult result_;
};

}  // namespace

RunResult run_scene(const LoadedScene& scene, const RunOptions& options, const std::stop_token& stop,
                    Progress& progress) {
  try {
    return Pipeline(scene, options, stop, progress).run();
  } catch (const Interrupted&) {
    return interrupted_at_once(film_extent(scene, options).steps);
  }
}

namespace fs = std::filesystem;
namespace {

// The packed share of a state's 48 bytes per vertex. States further apart are predicted less well from one another.
constexpr double expected_share = 0.6, expected_share_apart = 0.85, undamped = 1.25;

std::string size_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.3g} MB", bytes / 1e6);
  return fmt::format("{:.3g} GB", bytes / 1e9);
}

/// Returns the folder of a file, or its nearest existing parent folder.
fs::path folder_there(const fs::path& file) {
  std::error_code ignored;
  fs::path folder = fs::absolute(file, ignored).parent_path();
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

std::string MotionSpace::text(const std::string& file) const {
  return fmt::format("{} will take about {} (at most {}), and {} are free there", file, size_text(expected),
                     size_text(most), size_text(free));
}

MotionSpace motion_space(const Scene& scene, const RunOptions& options) {
  const MotionOptions& motion = *options.motion;
  const FilmExtent extent = film_extent(scene, options);
  const auto steps = static_cast<double>(extent.steps);
  const double states = motion.recorded.every ? steps / static_cast<double>(*motion.recorded.every) + 2
                                              : std::min(steps + 1, 2.0 * extent.frames.count() + 2);
  const auto vertices = static_cast<double>(scene.simulation.cloth.vertex_count());
  const double colliders = static_cast<double>(scene.simulation.effects.size());
  const double most = states * (64 + 48 * vertices) + (steps + 1) * (72 + 32 * colliders);

  const double usual = motion.recorded.every == 1 ? expected_share : expected_share_apart;
  // Motions without numerical damping are less smooth and harder to predict.
  const double share = is_explicit(scene.simulation.integrator.method) ? std::min(1.0, undamped * usual) : usual;
  std::error_code error;
  const double there = options.from ? static_cast<double>(options.from->length) : 0;
  const fs::space_info space = fs::space(folder_there(growing_name(motion.path)), error);
  // If the file system does not tell its free space, assume that there is enough.
  const double free = error ? most : static_cast<double>(space.available);
  return {.expected = std::max(0.0, share * most - there), .most = std::max(0.0, most - there), .free = free};
}

void require_motion_file(const MotionOptions& options, const MotionSpace& space, bool begun) {
  if (!begun) {
    require_writable(options.path);
    require_not_growing(options.path);
  }
  if (space.expected <= space.free) return;
  throw UsageError(
      space.text(options.path) +
      ": free some space, or store fewer states with --every frames or --every N, or use a shorter [time] duration");
}

}  // namespace drape
