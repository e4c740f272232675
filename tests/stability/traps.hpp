#pragma once

#include <fenv.h>

namespace drape::test {

/// Makes invalid floating-point operations, divisions by zero and overflows raise SIGFPE during its lifetime, at the
/// place where they happen.
class FloatingPointTraps {
 public:
  FloatingPointTraps() {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  }
  ~FloatingPointTraps() {
    feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_ALL_EXCEPT);
  }
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;
};

}  // namespace drape::test
