#include "run/frame_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

// Times are products of decimal fractions; a frame that falls on a step must not miss it by their rounding.
constexpr double rounding = 1e-9;

}  // namespace

FilmExtent::FilmExtent(const Video& video, double h, std::int64_t step_count,
                       const std::optional<FrameRange>& frame_range)
    : steps(step_count), step(h), seconds_per_frame(video.speed / video.fps) {
  const double last = video.last_frame(static_cast<double>(steps) * h);
  if (last >= std::numeric_limits<int>::max()) throw UsageError("a film of more than two thousand million frames");
  frames = frame_range.value_or(FrameRange{0, static_cast<int>(last)});
  if (frames.last > last) {
    throw UsageError(fmt::format("--frames {}..{}: the film ends with frame {}", frames.first, frames.last, last));
  }
  if (frame_range) {
    steps = std::min(steps, static_cast<std::int64_t>(std::ceil(time(frames.last) / h - rounding)));
  }
}

Vertices positions_at(double time, const Simulation& simulation, const Vertices& before) {
  const Vertices& now = simulation.state().x;
  const double back = std::clamp((simulation.time() - time) / simulation.settings().step, 0.0, 1.0);
  return back < rounding ? now : Vertices((1 - back) * now + back * before);
}

FrameSampler::FrameSampler(const FilmExtent& extent, Receiver receiver)
    : extent_(extent), receiver_(std::move(receiver)), next_(extent.frames.first) {}

void FrameSampler::begin(const Simulation& simulation) {
  previous_ = simulation.state().x;
  emit_until(simulation);
}

void FrameSampler::after_step(const Simulation& simulation, const StepReport&, double) {
  emit_until(simulation);
  previous_ = simulation.state().x;
}

void FrameSampler::emit_until(const Simulation& simulation) {
  const double h = extent_.step;
  while (next_ <= extent_.frames.last && extent_.time(next_) <= simulation.time() + rounding * h) {
    const double time = extent_.time(next_);
    Frame frame{.index = next_, .time = time, .positions = {}, .colliders = simulation.colliders(time)};
    frame.positions = positions_at(time, simulation, previous_);
    ++next_;
    receiver_(std::move(frame));
  }
}

}  // namespace drape
