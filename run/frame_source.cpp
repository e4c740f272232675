#include "run/frame_source.hpp"

#include <array>
#include <utility>

#include "core/error.hpp"
#include "run/motion_frames.hpp"
#include "run/run_steps.hpp"

namespace drape {

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
    if (simulation.state().step == extent_.steps) statistics_.finish(simulation);
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

}  // namespace drape
