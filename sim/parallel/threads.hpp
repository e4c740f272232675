#pragma once

#include <chrono>
#include <memory>
#include <type_traits>

namespace drape {

/// Lets a thread that waits for another one's next write spin for a moment, and then give way.
class Patience {
 public:
  /// @returns whether it has waited awake for long enough to sleep
  bool wait();

 private:
  int waits_ = 0;
};

/// Threads that compute the parts of a loop together. How a loop is divided must not depend on how many there are, or
/// its result not on how it is divided: then the bits are the same for any number of them.
///
/// They are started by the first loop that is divided, and wait for the next one awake for some microseconds, then
/// asleep. One thread at a time may divide its loops among them; a part must not divide its own.
class Threads {
 public:
  /// @param count of threads, that which divides its loops included: with one, nothing is ever started
  /// @param spare whether to do without the others for a while where a busy machine keeps them waiting, see Turnout
  explicit Threads(int count = 1, bool spare = false);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  [[nodiscard]] int count() const { return count_; }

  /// Calls work(part) once for every part from 0 on, and returns when all are done. A part begins after all before it
  /// have begun, so it may wait for them. Takes nothing from the heap.
  /// @throws what the first of the parts that threw has thrown; the others are computed all the same
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
  /// Whether it is a time to do without the others.
  [[nodiscard]] bool alone() const;

  int count_;
  bool spare_;
  mutable std::unique_ptr<Crew> crew_;  // once it is needed
};

/// Does all that is divided itself, for who asks for no threads.
const Threads& one_thread();

/// A thread's wait for what another one is about to write: awake for a moment, then giving way.
class Wait {
 public:
  explicit Wait(const Threads& threads);
  ~Wait();
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  /// @returns whether it has waited awake for long enough to sleep
  bool go_on() { return patience_.wait(); }

 private:
  const Threads& threads_;
  bool measured_;
  std::chrono::nanoseconds begin_;
  Patience patience_;
};

}  // namespace drape
