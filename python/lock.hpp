#pragma once

#include <pybind11/pybind11.h>

namespace drape::python {

/// Does without Python's lock, as pybind11::gil_scoped_release, also in a thread that outlives Python: when the
/// interpreter ends, a thread that wants its lock back would be ended in the middle of C++, which aborts the process.
/// Here it waits until the process is over.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* thread_;
};

/// Calls work() with Python's lock, on a thread that does without it.
/// @returns what it returns; true, without a call, where Python ends
bool with_lock(bool (*work)());

/// Has the end of Python wait until all that compute have seen it, for two seconds at most.
void watch_end();

}  // namespace drape::python
