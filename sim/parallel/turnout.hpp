#pragma once

#include <chrono>

namespace drape {

/// Whether threads that share loops are there when they are needed. On a machine that is busy with other programs the
/// system now and then keeps one of them from its processor in the middle of a part, and all others wait for it. Where
/// waiting has taken so much of the time of some loops that little was gained, whoever divides them computes alone for
/// many times as long: so no more than a small part of all time is ever lost.
class Turnout {
 public:
  using Time = std::chrono::nanoseconds;

  /// Takes note of a loop that was divided.
  /// @param taken  by the loop
  /// @param waited of that, for others
  /// @param now    since some moment
  void note(Time taken, Time waited, Time now) {
    taken_ += taken;
    waited_ += waited;
    if (taken_ < enough) return;
    if (static_cast<double>(waited_.count()) > too_much * static_cast<double>(taken_.count())) {
      alone_until_ = now + times_alone * waited_;
    }
    taken_ = waited_ = Time{0};
  }

  /// Whether to compute alone.
  [[nodiscard]] bool poor(Time now) const { return now < alone_until_; }

 private:
  static constexpr double too_much = 0.4;  // two threads that wait so long are 1.2 times as fast as one
  static constexpr int times_alone = 20;   // of what was lost
  static constexpr Time enough = std::chrono::milliseconds(2);

  Time taken_{0}, waited_{0}, alone_until_{0};
};

}  // namespace drape
