#include "sim/parallel/threads.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace drape {
namespace {

// Awake for about the time of a wake-up, some tens of microseconds, which exceeds the time between two loops of a step.
constexpr int give_way_at = 1000;
constexpr int asleep_at = 1100;

// The rest of a loop in one number: the loop's number and the count of parts not begun. So a late thread cannot take a
// part of the next loop by mistake.
constexpr int bits_of_parts = 32;
constexpr std::uint64_t one_loop = std::uint64_t{1} << bits_of_parts;
constexpr std::uint64_t parts_mask = one_loop - 1;

BusyBackoff::Time now() { return std::chrono::steady_clock::now().time_since_epoch(); }

}  // namespace

bool SpinWait::wait() {
  if (++waits_ > give_way_at) {
    std::this_thread::yield();
  } else {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
  }
  return waits_ > asleep_at;
}

/// The other threads, and the current divided loop.
class Threads::Crew {
 public:
  explicit Crew(int others) {
    members_.reserve(static_cast<std::size_t>(others));
    try {
      for (int i = 0; i < others; ++i) members_.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {
      // The system has no more threads; use those started.
    }
  }
  ~Crew() {
    ending_ = true;
    left_.fetch_add(one_loop);  // an empty loop, which wakes them
    left_.notify_all();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void divide(const Threads& threads, int parts, void* given, void (*call)(void* given, int part)) {
    divider_ = std::this_thread::get_id();
    given_ = given;
    call_ = call;
    parts_ = parts;
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t loop = left_.load(std::memory_order_relaxed) / one_loop + 1;
    left_.store(loop * one_loop + static_cast<std::uint64_t>(parts));
    left_.notify_all();
    take_parts();
    wait(threads, parts);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

  /// Returns true if this thread divides the current loop.
  [[nodiscard]] bool divided_here() const { return divider_ == std::this_thread::get_id(); }

  BusyBackoff backoff;
  BusyBackoff::Time waited{0};  // time that the dividing thread has waited in the current loop

 private:
  /// Waits until all parts are done.
  void wait(const Threads& threads, int parts) {
    int done = done_.load(std::memory_order_acquire);
    if (done == parts) return;
    Wait wait(threads);
    for (; done < parts; done = done_.load(std::memory_order_acquire)) {
      if (wait.keep_waiting()) done_.wait(done, std::memory_order_acquire);
    }
  }

  void serve() {
    SpinWait patience;
    while (!ending_) {
      const std::uint64_t seen = left_.load();
      if ((seen & parts_mask) != 0) {
        take_parts();
        patience = {};
      } else if (patience.wait()) {
        left_.wait(seen);
        patience = {};
      }
    }
  }

  /// Computes parts of the loop until none is left.
  void take_parts() {
    std::uint64_t left = left_.load();
    while ((left & parts_mask) != 0) {
      if (!left_.compare_exchange_weak(left, left - 1)) continue;
      // A thread with an unfinished part keeps the loop from ending, so the loop's data do not change.
      const int part = parts_ - static_cast<int>(left & parts_mask);
      try {
        call_(given_, part);
      } catch (...) {
        note(part, std::current_exception());
      }
      const int all = parts_;
      if (done_.fetch_add(1, std::memory_order_acq_rel) + 1 == all) done_.notify_one();
      left = left_.load();
    }
  }

  void note(int part, std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    if (error_ && part_of_error_ < part) return;
    error_ = std::move(error);
    part_of_error_ = part;
  }

  // On separate cache lines: all threads write one of them for each part and poll it.
  alignas(64) std::atomic<std::uint64_t> left_ = 0;
  alignas(64) std::atomic<int> done_ = 0;
  alignas(64) std::atomic<bool> ending_ = false;
  std::thread::id divider_;
  void* given_ = nullptr;
  void (*call_)(void*, int) = nullptr;
  int parts_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
  int part_of_error_ = 0;
  std::vector<std::jthread> members_;  // last, so that the threads end before the other members are destroyed
};

Threads::Threads(int count, bool spare) : count_(std::max(1, count)), spare_(spare) {}
Threads::~Threads() = default;

void Threads::divide(int parts, void* given, void (*call)(void* given, int part)) const {
  if (!crew_) crew_ = std::make_unique<Crew>(count_ - 1);
  if (!spare_) {
    crew_->divide(*this, parts, given, call);
    return;
  }
  crew_->waited = {};
  const BusyBackoff::Time begin = now();
  crew_->divide(*this, parts, given, call);
  const BusyBackoff::Time end = now();
  crew_->backoff.note(end - begin, crew_->waited, end);
}

bool Threads::alone() const { return spare_ && crew_ && crew_->backoff.active(now()); }

const Threads& one_thread() {
  static const Threads one;
  return one;
}

Wait::Wait(const Threads& threads)
    : threads_(threads),
      measured_(threads.spare_ && threads.crew_->divided_here()),
      begin_(measured_ ? now() : BusyBackoff::Time{}) {}

Wait::~Wait() {
  if (measured_) threads_.crew_->waited += now() - begin_;
}

}  // namespace drape
