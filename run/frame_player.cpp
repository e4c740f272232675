#include "run/frame_player.hpp"

#include <stop_token>
#include <utility>

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

}  // namespace drape
