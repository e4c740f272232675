#pragma once

#include <chrono>

namespace drape {

/// Detector of threads that are kept waiting. On a busy machine the system sometimes takes one of them off its
/// processor in the middle of a part, and all others wait. If waiting has cost so much of some loops that little was
/// gained, the dividing thread computes alone for many times as long. So only a small part of the total time is lost.
class BusyBackoff {
 public:
  using Time = std::chrono::nanoseconds;

  /// Records a divided loop.
  /// @param taken  time of the loop
  /// @param waited time of it spent waiting for others
  /// @param now    time since a fixed moment
  void note(Time taken, Time waited, Time now) {
    taken_ += taken;
    waited_ += waited;
    if (taken_ < enough) return;
    if (static_cast<double>(waited_.count()) > too_much * static_cast<double>(taken_.count())) {
      alone_until_ = now + times_alone * waited_;
    }
    taken_ = waited_ = Time{0};
  }

  /// Returns true if loops should be computed alone.
  [[nodiscard]] bool active(Time now) const { return now < alone_until_; }

 private:
  static constexpr double too_much = 0.4;  // at this waiting time two threads are 1.2 times as fast as one
  static constexpr int times_alone = 20;   // duration alone, in multiples of the time lost
  static constexpr Time enough = std::chrono::milliseconds(2);

  Time taken_{0}, waited_{0}, alone_until_{0};
};

}  // namespace drape
