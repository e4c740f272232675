#pragma once

#include <array>

#include "sim/kernels/kernels.hpp"

namespace drape {

/// The purpose of a kernel.
enum class KernelPart { local, assembly, global, product, vectors };
inline constexpr std::size_t kernel_part_count = 5;

/// Timer of the kernels during its lifetime, for single-threaded computations. Only one may exist at a time.
class KernelClock {
 public:
  KernelClock();
  KernelClock(const KernelClock&) = delete;
  KernelClock& operator=(const KernelClock&) = delete;
  ~KernelClock();

  /// Sets all times to zero.
  void reset();
  [[nodiscard]] double seconds(KernelPart part) const;

 private:
  Kernels timed_;
  const Kernels& plain_;
};

}  // namespace drape
