#pragma once

#include <fenv.h>

namespace drape::test {

/// While it lives, an invalid operation, a division by zero or an overflow of floating-point numbers ends the program
/// with SIGFPE, where it happens.
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
