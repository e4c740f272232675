#pragma once

#include <pybind11/pybind11.h>

namespace drape::python {

/// Releases Python's lock during its lifetime, as pybind11::gil_scoped_release, also in a thread that outlives Python.
/// An ending interpreter kills threads that retake the lock in the middle of C++, which aborts the process. Such a
/// thread waits here until the process is over.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* thread_;
};

/// Calls work() with Python's lock, on a thread that has released it.
/// @returns its result; true, without a call, if Python ends
bool with_lock(bool (*work)());

/// Makes the end of Python wait for all computing threads, for two seconds at most.
void watch_end();

}  // namespace drape::python
