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

/// How far a time lies before the end of the last step, in steps: from 0, exactly where it is that end, to 1.
double part_back(double time, const Simulation& simulation) {
  const double back = std::clamp((simulation.time() - time) / simulation.settings().step, 0.0, 1.0);
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
  const double last = every ? static_cast<double>(steps / *every) : video.last_frame(static_cast<double>(steps) * h);
  if (last >= std::numeric_limits<int>::max()) throw UsageError("a film of more than two thousand million frames");
  frames = frame_range.value_or(FrameRange{0, static_cast<int>(last)});
  if (frames.last > last) {
    throw UsageError(fmt::format("--frames {}..{}: the film ends with frame {}", frames.first, frames.last, last));
  }
  if (frame_range || every) {
    steps = std::min(steps, static_cast<std::int64_t>(std::ceil(time(frames.last) / h - rounding)));
  }
}

Vertices positions_at(double time, const Simulation& simulation, const Vertices& before) {
  return between(simulation.state().x, before, part_back(time, simulation));
}

FrameSampler::FrameSampler(const FilmExtent& extent, Receiver receiver, FrameContents contents)
    : extent_(extent), receiver_(std::move(receiver)), contents_(contents), next_(extent.frames.first) {}

void FrameSampler::begin(const Simulation& simulation) {
  keep(simulation);
  emit_until(simulation);
}

void FrameSampler::after_step(const Simulation& simulation, const StepReport& report, double) {
  iterations_ = report.iterations;
  emit_until(simulation);
  keep(simulation);
}

void FrameSampler::keep(const Simulation& simulation) {
  previous_ = simulation.state().x;
  const bool soon =
      next_ <= extent_.frames.last && extent_.time(next_) < simulation.time() + (1 - rounding) * extent_.step;
  if (contents_ == FrameContents::places || !soon) return;
  previous_velocities_ = simulation.state().v;
  previous_energies_ = simulation.energies();
}

Frame FrameSampler::frame(int index, const Simulation& simulation) const {
  const double time = extent_.time(index);
  Frame frame{.index = index,
              .time = time,
              .positions = positions_at(time, simulation, previous_),
              .colliders = simulation.colliders(time),
              .velocities = {},
              .energies = {},
              .iterations = iterations_};
  if (contents_ == FrameContents::motion) {
    const double back = part_back(time, simulation);
    frame.velocities = between(simulation.state().v, previous_velocities_, back);
    frame.energies = between(simulation.energies(), previous_energies_, back);
  }
  return frame;
}

void FrameSampler::emit_until(const Simulation& simulation) {
  const double h = extent_.step;
  while (next_ <= extent_.frames.last && extent_.time(next_) <= simulation.time() + rounding * h) {
    receiver_(frame(next_++, simulation));
  }
}

}  // namespace drape
