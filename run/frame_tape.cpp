#include "run/frame_tape.hpp"

#include <string_view>
#include <utility>

namespace drape {
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

}  // namespace drape
