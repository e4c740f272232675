#include "run/frame_player.hpp"

#include <stop_token>
#include <utility>

#include "sim/system.hpp"

namespace drape {

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
  FrameInterpolator taker(extent, receiver, contents);
  const std::size_t first = last_before(motion, extent.time(extent.frames.first), extent.step);
  // Begin one state earlier, so that a frame which falls on a state by rounding has its predecessor.
  for (std::size_t i = first > 0 ? first - 1 : 0; i < motion.states() && !taker.done() && !stop.stop_requested(); ++i) {
    const State& state = motion.state(i);
    taker.add({.state = state,
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
