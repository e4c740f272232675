#pragma once

#include <array>

#include "sim/kernels/kernels.hpp"

namespace drape {

/// What the hot loops are for.
enum class KernelPart { local, assembly, global, product, vectors };
inline constexpr std::size_t kernel_part_count = 5;

/// Measures the time within the hot loops, from its making to its end, on the only thread that computes. One at a time.
class KernelClock {
 public:
  KernelClock();
  KernelClock(const KernelClock&) = delete;
  KernelClock& operator=(const KernelClock&) = delete;
  ~KernelClock();

  /// Forgets what it has measured so far.
  void reset();
  [[nodiscard]] double seconds(KernelPart part) const;

 private:
  Kernels timed_;
  const Kernels& plain_;
};

}  // namespace drape
