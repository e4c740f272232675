#include "run/run_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "render/renderer.hpp"
#include "render/view.hpp"
#include "run/annotations.hpp"
#include "run/bounded_queue.hpp"
#include "run/outputs.hpp"
#include "run/run_steps.hpp"

namespace drape {
namespace {

using Clock = std::chrono::steady_clock;

// Frames in flight between two stages: enough to ride out an uneven step or frame, little enough to hold in memory.
constexpr std::size_t queue_capacity = 8;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

FilmInfo with_progress(FilmInfo film, Progress& progress) {
  film.progress = [&progress](int done, int total) {
    if (done <= 1) progress.begin("encoding", "frames", total);
    progress.done = done;
  };
  return film;
}

/// The three threads of a run and what flows between them.
class Pipeline {
 public:
  Pipeline(const Scene& scene, const RunOptions& options, Progress& progress)
      : scene_(scene),
        options_(options),
        progress_(progress),
        extent_(film_extent(scene, options)),
        simulation_(scene.simulation, options.time_effects ? Timing::effects : Timing::none),
        outputs_(options.outputs, with_progress(film_info(scene, options), progress), options.poster),
        drawn_(outputs_.drawn()),
        records_(options.records) {
    if (drawn_ && Annotations::wanted(scene)) annotations_.emplace(scene);
    result_.steps_wanted = extent_.steps;
    if (!outputs_.none()) result_.frames_wanted = extent_.frames.count();
  }

  RunResult run(const std::stop_token& stop) {
    const auto begin = Clock::now();
    const std::stop_callback pass_on(stop, [this] { stop_.request_stop(); });
    std::vector<std::jthread> threads;
    try {
      // The consumers first: where a thread cannot be had, those that run already end when their queues close.
      if (result_.frames_wanted > 0) threads.emplace_back([this] { guarded([this] { write(); }); });
      if (drawn_) threads.emplace_back([this] { guarded([this] { draw(); }); });
      threads.emplace_back([this] { guarded([this] { simulate(); }); });
    } catch (...) {
      fail();
    }
    threads.clear();  // waits for them
    if (error_) std::rethrow_exception(error_);

    if (nothing_left_) throw OutputError(fmt::format("{}", fmt::join(outputs_.problems(), "\n")));
    finish_records();
    result_.elapsed_seconds = seconds_since(begin);
    return std::move(result_);
  }

 private:
  /// Runs one thread's work; an exception ends the whole run.
  template <class Work>
  void guarded(Work work) {
    try {
      work();
    } catch (...) {
      fail();
    }
  }

  /// Ends the run with the exception that is being handled, unless there is one already.
  void fail() {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::current_exception();
    stop_.request_stop();
    view_.close();
    frames_.close();
    film_.close();
  }

  void finish_records() {
    result_.problems = outputs_.problems();
    if (!whole_ && result_.outcome == Outcome::completed) result_.outcome = Outcome::interrupted;
    if (result_.outcome == Outcome::interrupted && result_.statistics.steps() == 0) return;
    result_.records = records_.finish(simulation_, result_.statistics, outcome_name(result_.outcome),
                                      whole_ ? Ending::complete : Ending::early, result_.problems);
  }

  void simulate() {
    std::vector<StepObserver*> observers{&result_.statistics};
    for (StepObserver* record : records_.observers()) observers.push_back(record);
    if (options_.observer != nullptr) observers.push_back(options_.observer);

    const auto send = [this](Frame frame) {
      if (drawn_) {
        frames_.push(std::move(frame));
      } else {
        film_.push({std::move(frame), std::nullopt});
      }
    };
    const FrameContents shown = annotations_ ? annotations_->contents() : FrameContents::places;
    FrameSampler sampler(extent_, send, std::max(outputs_.contents(), shown));
    StepCounter counter(progress_);
    if (result_.frames_wanted > 0) {
      if (drawn_ && !find_view()) return close_queues();
      progress_.begin(drawn_ ? "drawing" : "simulating", "frames", extent_.frames.count());
      observers.push_back(&sampler);
    } else {
      progress_.begin("simulating", "steps", extent_.steps);
      observers.push_back(&counter);
    }
    try {
      run_steps(simulation_, extent_.steps, observers, stop_.get_token());
      result_.statistics.finish(simulation_);
      whole_ = simulation_.state().step == extent_.steps;
    } catch (const DivergedError& diverged) {
      result_.outcome = Outcome::diverged;
      result_.divergence = diverged.what();
    }
    close_queues();
  }

  /// Ends the flow of frames where it begins. What is on its way is still drawn and written.
  void close_queues() {
    view_.close();
    frames_.close();
    if (!drawn_) film_.close();
  }

  /// Hands the camera's view to the drawing thread. One that has to show the whole motion is found by running the
  /// motion once before: all of it, so that a frame looks the same whichever range of frames is drawn. So is what
  /// annotations must know of it.
  /// @returns whether there is one: not if the run was interrupted before it was known
  bool find_view() {
    const bool annotated = annotations_ && annotations_->needs_motion();
    const bool framed = needs_motion(scene_.camera);
    if (!framed && !annotated) return view_.push(fixed_view(scene_.camera));
    Framing framing(scene_.camera, static_cast<double>(scene_.video.size[0]) / scene_.video.size[1]);
    const FilmExtent whole(scene_.video, scene_.simulation.step, options_.steps.value_or(scene_.step_count()), {},
                           options_.every);
    const auto look_at = [&](const Frame& frame) {
      framing.add(frame.positions);
      for (const Collider& collider : frame.colliders) framing.add(collider);
      if (annotated) annotations_->survey(frame);
    };
    FrameSampler sampler(whole, look_at, annotated ? annotations_->contents() : FrameContents::places);
    StepCounter counter(progress_);
    progress_.begin("framing", "steps", whole.steps);
    const std::array<StepObserver*, 2> observers{&sampler, &counter};
    Simulation scout(scene_.simulation);
    try {
      run_steps(scout, whole.steps, observers, stop_.get_token());
    } catch (const DivergedError&) {
      // The run itself will say so; up to here there is something to see.
    }
    return !stop_.stop_requested() && view_.push(framed ? framing.view() : fixed_view(scene_.camera));
  }

  void draw() {
    const std::optional<View> view = view_.pop();
    if (!view) return film_.close();
    Renderer renderer(data_folder(), scene_.video.size, *view, Annotations::look(scene_),
                      simulation_.cloth().vertex_count(), simulation_.cloth().triangles, scene_.uvs, options_.backend);
    result_.renderer = renderer.description();
    while (std::optional<Frame> frame = frames_.pop()) {
      const auto begin = Clock::now();
      std::optional<Image> image;
      if (!undrawn_.stop_requested()) image.emplace(picture(renderer, *frame));
      result_.draw_seconds += seconds_since(begin);
      film_.push({std::move(*frame), std::move(image)});
    }
    film_.close();
  }

  /// The film's picture of a frame.
  Image picture(Renderer& renderer, const Frame& frame) {
    if (!annotations_) return renderer.draw(frame);
    const std::vector<Rgb> colors = annotations_->colors(frame);
    return annotations_->annotate(colors.empty() ? renderer.draw(frame) : renderer.draw(frame, colors), frame);
  }

  void write() {
    while (const std::optional<FilmFrame> frame = film_.pop()) {
      const auto begin = Clock::now();
      outputs_.add(*frame);
      result_.write_seconds += seconds_since(begin);
      if (outputs_.none()) return stop_writing();
      if (!outputs_.drawn()) undrawn_.request_stop();
      progress_.done = ++result_.frames;
    }
    {
      const std::scoped_lock lock(mutex_);
      if (error_) return;
    }
    const auto begin = Clock::now();
    result_.outputs = outputs_.finish(result_.frames == result_.frames_wanted ? Ending::complete : Ending::early);
    result_.write_seconds += seconds_since(begin);
    if (outputs_.none()) stop_writing();
  }

  /// When no output is left. The run goes on for the sake of its records, if there are any.
  void stop_writing() {
    close_queues();
    film_.close();
    if (records_.wanted()) return;
    nothing_left_ = true;
    stop_.request_stop();
  }

  const Scene& scene_;
  const RunOptions& options_;
  Progress& progress_;
  FilmExtent extent_;
  Simulation simulation_;
  Outputs outputs_;
  const bool drawn_;  // whether there is anything to draw
  Records records_;
  std::optional<Annotations> annotations_;  // where there is anything to draw, and the scene asks for them

  BoundedQueue<View> view_{1};
  BoundedQueue<Frame> frames_{queue_capacity};
  BoundedQueue<FilmFrame> film_{queue_capacity};
  std::stop_source stop_;
  std::stop_source undrawn_;  // of the drawing, when no output takes images any more

  std::mutex mutex_;
  std::exception_ptr error_;
  bool whole_ = false;         // every step was taken
  bool nothing_left_ = false;  // every output was given up, and there are no records
  RunResult result_;
};

}  // namespace

const char* outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::completed:
      return "completed";
    case Outcome::interrupted:
      return "interrupted";
    case Outcome::diverged:
      return "diverged";
  }
  return "";
}

RunResult run_scene(const Scene& scene, const RunOptions& options, const std::stop_token& stop, Progress& progress) {
  return Pipeline(scene, options, progress).run(stop);
}

}  // namespace drape
