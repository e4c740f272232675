#include "run/frame_source.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stop_token>
#include <string_view>
#include <utility>

#include "drape/core/error.hpp"
#include "drape/sim/simulation.hpp"
#include "run/run_scene.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

// A frame that falls on a step must be found despite the rounding of its decimal time [steps].
constexpr double rounding = 1e-9;

/// Returns the share of the interval between a time and the end of a step. It is exactly 0 at the end and 1 at the
/// previous moment, `duration` seconds earlier.
double part_back(double time, double end, double duration) {
  const double back = std::clamp((end - time) / duration, 0.0, 1.0);
  return back < rounding ? 0 : back;
}

Vertices between(const Vertices& now, const Vertices& before, double back) {
  return back == 0 ? now : Vertices((1 - back) * now + back * before);
}

Energies between(const Energies& now, const Energies& before, double back) {
  const auto blend = [back](double a, double b) { return back == 0 ? a : (1 - back) * a + back * b; };
  return {.kinetic = blend(now.kinetic, before.kinetic),
          .gravity = blend(now.gravity, before.gravity),
          .elastic = blend(now.elastic, before.elastic)};
}

}  // namespace

FilmExtent::FilmExtent(const Video& video, double h, std::int64_t step_count,
                       const std::optional<FrameRange>& frame_range, std::optional<std::int64_t> every_steps)
    : steps(step_count),
      step(h),
      every(every_steps),
      seconds_per_frame(every ? static_cast<double>(*every) * h : video.speed / video.fps) {
  const std::int64_t whole = every ? steps / *every : 0;
  const double last = every ? static_cast<double>(whole) : video.last_frame(static_cast<double>(steps) * h);
  if (last >= std::numeric_limits<int>::max()) throw UsageError("a film of more than two thousand million frames");
  frames = frame_range.value_or(FrameRange{0, static_cast<int>(last)});
  if (frames.last > last) {
    throw UsageError(fmt::format("--frames {}..{}: the film ends with frame {}", frames.first, frames.last, last));
  }
  if (frame_range) {
    steps = std::min(steps, static_cast<std::int64_t>(std::ceil(time(frames.last) / h - rounding)));
  }
}

FrameInterpolator::FrameInterpolator(const FilmExtent& extent, Receiver receiver, FrameContents contents)
    : extent_(extent), receiver_(std::move(receiver)), contents_(contents), next_(extent.frames.first) {}

void FrameInterpolator::add(const Moment& moment) {
  if (previous_.x.size() == 0) keep(moment);
  while (!done() && extent_.time(next_) <= time_of(moment.state.step) + rounding * extent_.step) {
    receiver_(frame(next_++, moment));
  }
  keep(moment);
}

void FrameInterpolator::keep(const Moment& moment) {
  previous_.x = moment.state.x;
  previous_.step = moment.state.step;
  const bool soon = !done() && extent_.time(next_) < time_of(moment.next) - rounding * extent_.step;
  if (contents_ == FrameContents::places || !soon) return;
  previous_.v = moment.state.v;
  previous_energies_ = moment.energies();
}

Frame FrameInterpolator::frame(int index, const Moment& moment) const {
  const double time = extent_.time(index), end = time_of(moment.state.step);
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, moment.state.step - previous_.step));
  const double back = part_back(time, end, steps * extent_.step);
  Frame frame{.index = index,
              .time = time,
              .positions = between(moment.state.x, previous_.x, back),
              .colliders = moment.colliders(time),
              .velocities = {},
              .energies = {},
              .iterations = moment.iterations};
  if (contents_ == FrameContents::motion) {
    frame.velocities = between(moment.state.v, previous_.v, back);
    frame.energies = between(moment.energies(), previous_energies_, back);
  }
  return frame;
}

void FrameSampler::begin(const Simulation& simulation) { add(simulation, 0); }

void FrameSampler::after_step(const Simulation& simulation, const StepReport& report, double) {
  add(simulation, report.iterations);
}

void FrameSampler::add(const Simulation& simulation, int iterations) {
  interpolator_.add({.state = simulation.state(),
                     .iterations = iterations,
                     .next = simulation.state().step + 1,
                     .energies = [&] { return simulation.energies(); },
                     .colliders = [&](double time) { return simulation.colliders(time); }});
}

namespace {

std::size_t bytes_of(const Vertices& rows) { return static_cast<std::size_t>(rows.size()) * sizeof(double); }

void append(Spool& spool, const Vertices& rows) {
  const Eigen::Index count = rows.rows();
  spool.append({reinterpret_cast<const char*>(&count), sizeof count});
  spool.append({reinterpret_cast<const char*>(rows.data()), bytes_of(rows)});
}

Vertices next(Spool& spool) {
  Eigen::Index count = 0;
  spool.read(&count, sizeof count);
  Vertices rows(count, 3);
  spool.read(rows.data(), bytes_of(rows));
  return rows;
}

}  // namespace

void FrameTape::add(Frame frame) {
  const std::size_t bytes = bytes_of(frame.positions) + bytes_of(frame.velocities);
  if (!spool_ && bytes <= memory_) {
    memory_ -= bytes;
    ++in_memory_;
  } else {
    if (!spool_) spool_.emplace("the motion");
    append(*spool_, std::exchange(frame.positions, {}));
    append(*spool_, std::exchange(frame.velocities, {}));
  }
  frames_.push_back(std::move(frame));
}

void FrameTape::for_each(const std::function<void(const Frame&)>& visit, const std::stop_token& stop) {
  if (spool_) spool_->rewind();
  for (std::size_t i = 0; i < frames_.size() && !stop.stop_requested(); ++i) {
    if (i < in_memory_) {
      visit(frames_[i]);
      continue;
    }
    Frame frame = frames_[i];
    frame.positions = next(*spool_);
    frame.velocities = next(*spool_);
    visit(frame);
  }
}

FrameSource::FrameSource(const Scene& scene, std::shared_ptr<MotionReader> recorded, const FilmExtent& extent,
                         std::optional<std::size_t> memory)
    : scene_(scene), recorded_(std::move(recorded)), extent_(extent) {
  if (!recorded_ && memory) tape_.emplace(*memory);
}

void FrameSource::pass(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop) {
  if (recorded_) return read(receiver, stop);
  if (tape_ && known_) return tape_->for_each(receiver, stop);
  simulate(receiver, stop);
}

void FrameSource::simulate(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop) {
  const auto take = [&](Frame frame) {
    if (tape_) tape_->add(frame);
    receiver(std::move(frame));
  };
  FrameSampler sampler(extent_, take, FrameContents::motion);
  const std::array<StepObserver*, 2> observers{&statistics_, &sampler};
  try {
    Simulation simulation(scene_.simulation, Timing::none, make_stop(stop));
    run_steps(simulation, extent_.steps, observers, stop);
    if (simulation.state().step == extent_.steps) {
      statistics_.finish(simulation);
      divergence_ = statistics_.instability().value_or("");
    }
  } catch (const DivergedError& diverged) {
    divergence_ = diverged.what();
  } catch (const Interrupted&) {
  }
  known_ = !stop.stop_requested();
}

void FrameSource::read(const FrameInterpolator::Receiver& receiver, const std::stop_token& stop) {
  sample_motion(*recorded_, scene_, extent_, FrameContents::motion, receiver, stop);
  if (known_ || stop.stop_requested()) return;
  for (std::int64_t step = 0; step <= extent_.steps; ++step) {
    statistics_.replay(recorded_->row(step), static_cast<double>(step) * extent_.step, 0);
  }
  known_ = true;
}

FramePlayer::FramePlayer(FrameSource& source)
    : thread_([this, &source](const std::stop_token& stop) {
        try {
          source.pass([this](Frame frame) { frames_.push(std::move(frame)); }, stop);
        } catch (...) {
          error_ = std::current_exception();
        }
        frames_.close();
      }) {}

FramePlayer::~FramePlayer() {
  thread_.request_stop();
  frames_.close();
}

const Frame& FramePlayer::next() {
  if (over_) return now_;
  if (std::optional<Frame> frame = frames_.pop()) {
    now_ = std::move(*frame);
    return now_;
  }
  thread_.join();
  over_ = true;
  if (error_) std::rethrow_exception(error_);
  return now_;
}

namespace {

/// Returns the last state before a time; the first state if there is none.
std::size_t last_before(const MotionReader& motion, double time, double h) {
  std::size_t first = 0, end = motion.states();
  while (end - first > 1) {
    const std::size_t middle = first + (end - first) / 2;
    (static_cast<double>(motion.step(middle)) * h < time ? first : end) = middle;
  }
  return first;
}

}  // namespace

void sample_motion(MotionReader& motion, const Scene& scene, const FilmExtent& extent, FrameContents contents,
                   const FrameInterpolator::Receiver& receiver, const std::stop_token& stop) {
  const System system = make_system(scene.simulation);
  FrameInterpolator interpolator(extent, receiver, contents);
  const std::size_t first = last_before(motion, extent.time(extent.frames.first), extent.step);
  // Begin one state earlier, so that a frame which falls on a state by rounding has its predecessor.
  for (std::size_t i = first > 0 ? first - 1 : 0; i < motion.states() && !interpolator.done() && !stop.stop_requested();
       ++i) {
    const State& state = motion.state(i);
    interpolator.add({.state = state,
                      .iterations = motion.row(state.step).iterations,
                      .next = i + 1 < motion.states() ? motion.step(i + 1) : state.step + 1,
                      .energies = [&] { return motion.row(state.step).energies; },
                      .colliders = [&](double time) { return system.colliders_at(time); }});
  }
}

int frames_in_gaps(const MotionReader& motion, const FilmExtent& extent) {
  constexpr double on_a_step = 1e-9;  // tolerance [steps]
  int count = 0;
  for (int frame = extent.frames.first; frame <= extent.frames.last; ++frame) {
    const double time = extent.time(frame);
    const std::size_t i = last_before(motion, time + on_a_step * extent.step, extent.step);
    const double after = time - static_cast<double>(motion.step(i)) * extent.step;
    const bool gap = i + 1 < motion.states() && motion.step(i + 1) - motion.step(i) > 1;
    if (gap && after > on_a_step * extent.step) ++count;
  }
  return count;
}

}  // namespace drape
