#include "python/lock.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace py = pybind11;

namespace drape::python {
namespace {

using std::chrono_literals::operator""ms;

std::atomic<bool> ending = false;   // true while Python ends
std::atomic<int> without_lock = 0;  // threads that compute without the lock
std::atomic<int> taking_lock = 0;   // threads that wait for the lock and have not seen the end

/// Marks this thread as waiting for the lock, during its lifetime.
class TakingLock {
 public:
  TakingLock() { ++taking_lock; }
  ~TakingLock() { --taking_lock; }
  TakingLock(const TakingLock&) = delete;
  TakingLock& operator=(const TakingLock&) = delete;
};

void wait_for_exit() {
  while (true) std::this_thread::sleep_for(1000ms);
}

/// Runs with the lock, before Python ends.
void end() {
  constexpr auto patience = 2000ms;
  ending = true;
  const py::gil_scoped_release free;
  while (taking_lock > 0) std::this_thread::sleep_for(1ms);  // they get the lock now
  const auto begin = std::chrono::steady_clock::now();
  while (without_lock > 0 && std::chrono::steady_clock::now() - begin < patience) std::this_thread::sleep_for(1ms);
}

}  // namespace

WithoutLock::WithoutLock() : thread_(PyEval_SaveThread()) { ++without_lock; }

WithoutLock::~WithoutLock() {
  {
    const TakingLock taking;
    if (!ending) {
      PyEval_RestoreThread(thread_);
      --without_lock;
      return;
    }
  }
  --without_lock;
  wait_for_exit();
}

bool with_lock(bool (*work)()) {
  const TakingLock taking;
  if (ending) return true;
  const py::gil_scoped_acquire held;
  return work();
}

void watch_end() { py::module_::import("atexit").attr("register")(py::cpp_function(&end)); }

}  // namespace drape::python
