#pragma once

#include <chrono>
#include <memory>
#include <type_traits>

namespace drape {

/// Wait strategy of a thread for another one's next write: spin for a moment, then yield.
class SpinWait {
 public:
  /// Waits once. @returns true if it has been awake long enough to sleep
  bool wait();

 private:
  int waits_ = 0;
};

/// Threads that compute the parts of a loop together. The division of a loop must not depend on their number, or its
/// result must not depend on the division. Then the bits are the same for any number of threads.
///
/// They start with the first divided loop. Between loops they stay awake for some microseconds and then sleep. Only one
/// thread at a time may divide loops among them; a part must not divide its own.
class Threads {
 public:
  /// @param count number of threads including the dividing one; with one, none is started
  /// @param spare true to fall back to one thread while a busy machine keeps the others waiting, see BusyBackoff
  explicit Threads(int count = 1, bool spare = false);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  [[nodiscard]] int count() const { return count_; }

  /// Calls work(part) once for every part from 0 on, and returns when all are done. A part begins after all earlier
  /// ones have begun, so it may wait for them. Allocates nothing.
  /// @throws the exception of the lowest part that threw; the other parts are computed nevertheless
  template <class Work>
  void for_each(int parts, Work&& work) const {
    if (count_ == 1 || parts <= 1 || alone()) {
      for (int part = 0; part < parts; ++part) work(part);
      return;
    }
    using Plain = std::remove_reference_t<Work>;
    divide(parts, const_cast<std::remove_const_t<Plain>*>(&work),
           [](void* given, int part) { (*static_cast<Plain*>(given))(part); });
  }

 private:
  class Crew;
  friend class Wait;
  void divide(int parts, void* given, void (*call)(void* given, int part)) const;
  /// Returns true while running on one thread.
  [[nodiscard]] bool alone() const;

  int count_;
  bool spare_;
  mutable std::unique_ptr<Crew> crew_;  // created on first use
};

/// Returns an object without threads, which computes all parts itself.
const Threads& one_thread();

/// A thread's wait for another one's write: awake for a moment, then yielding.
class Wait {
 public:
  explicit Wait(const Threads& threads);
  ~Wait();
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  /// Waits once more. @returns true if it has been awake long enough to sleep
  bool keep_waiting() { return patience_.wait(); }

 private:
  const Threads& threads_;
  bool measured_;
  std::chrono::nanoseconds begin_;
  SpinWait patience_;
};

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
