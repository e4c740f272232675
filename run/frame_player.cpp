#include "run/frame_player.hpp"

#include <array>
#include <stop_token>
#include <utility>

#include "core/error.hpp"
#include "run/run_steps.hpp"

namespace drape {

FramePlayer::FramePlayer(const Scene& scene, const FilmExtent& extent, FrameContents contents)
    : thread_([this, &scene, extent, contents](const std::stop_token& stop) {
        try {
          play(scene, extent, contents, stop);
        } catch (...) {
          error_ = std::current_exception();
        }
        frames_.close();
      }) {}

FramePlayer::~FramePlayer() {
  thread_.request_stop();
  frames_.close();
}

void FramePlayer::play(const Scene& scene, const FilmExtent& extent, FrameContents contents,
                       const std::stop_token& stop) {
  FrameSampler sampler(
      extent, [this](Frame frame) { frames_.push(std::move(frame)); }, contents);
  const std::array<StepObserver*, 2> observers{&statistics_, &sampler};
  Simulation simulation(scene.simulation);
  try {
    run_steps(simulation, extent.steps, observers, stop);
    statistics_.finish(simulation);
  } catch (const DivergedError& diverged) {
    divergence_ = diverged.what();
  }
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

}  // namespace drape
