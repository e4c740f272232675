#include "run/run_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "render/camera_path.hpp"
#include "run/annotations.hpp"
#include "run/bounded_queue.hpp"
#include "run/film_painter.hpp"
#include "run/frame_tape.hpp"
#include "run/known_film.hpp"
#include "run/motion_frames.hpp"
#include "run/outputs.hpp"
#include "run/run_purposes.hpp"
#include "run/run_steps.hpp"
#include "run/thread_count.hpp"

namespace drape {
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
  Pipeline(const Scene& scene, const RunOptions& options, const std::stop_token& stop, Progress& progress)
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
    while (std::optional<Frame> frame = frames_.pop()) {
      if (held) film_.push({std::move(*std::exchange(held, {})), std::nullopt});
      if (outputs_.needs_picture(frame->index - extent_.frames.first)) {
        paint(painter, std::move(*frame));
      } else {
        held = std::move(frame);
      }
    }
    if (held) paint(painter, std::move(*held));
  }

  void paint(FilmPainter& painter, Frame frame) {
    const auto begin = Clock::now();
    std::optional<Image> image;
    if (!stop_drawing_.stop_requested()) image.emplace(painter.paint(frame));
    result_.draw_seconds += seconds_since(begin);
    film_.push({std::move(frame), std::move(image)});
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
    if (options_.drawn) options_.drawn();
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

RunResult run_scene(const Scene& scene, const RunOptions& options, const std::stop_token& stop, Progress& progress) {
  try {
    return Pipeline(scene, options, stop, progress).run();
  } catch (const Interrupted&) {
    return interrupted_at_once(film_extent(scene, options).steps);
  }
}

}  // namespace drape
