#include "study/kernel_clock.hpp"

#include <chrono>

namespace drape {
namespace {

using Clock = std::chrono::steady_clock;

// Kernels are plain functions, so the times are global: one clock at a time.
std::array<double, kernel_part_count> part_seconds;
const Kernels* original = nullptr;

/// A stopwatch that adds its lifetime to the time of a part.
struct Stopwatch {
  std::size_t part;
  Clock::time_point begin = Clock::now();
  ~Stopwatch() { part_seconds[part] += std::chrono::duration<double>(Clock::now() - begin).count(); }
};

/// A kernel of the same type that calls and times the original.
template <auto Member, KernelPart Part>
struct Timed;
template <class Result, class... Arguments, Result (*Kernels::*Member)(Arguments...), KernelPart Part>
struct Timed<Member, Part> {
  static Result call(Arguments... arguments) {
    const Stopwatch watch{static_cast<std::size_t>(Part)};
    return (original->*Member)(arguments...);
  }
};

template <auto Member, KernelPart Part>
void wrap(Kernels& kernels) {
  kernels.*Member = &Timed<Member, Part>::call;
}

Kernels timed_version(const Kernels& plain) {
  Kernels k = plain;
  wrap<&Kernels::add_list_gradient, KernelPart::local>(k);
  wrap<&Kernels::add_list_value_gradient, KernelPart::local>(k);
  wrap<&Kernels::add_band_value_gradient, KernelPart::local>(k);
  wrap<&Kernels::evaluate_bands, KernelPart::local>(k);
  wrap<&Kernels::kick_bands, KernelPart::local>(k);
  wrap<&Kernels::band_blocks, KernelPart::assembly>(k);
  wrap<&Kernels::list_blocks, KernelPart::assembly>(k);
  wrap<&Kernels::add_band_product, KernelPart::product>(k);
  wrap<&Kernels::add_list_product, KernelPart::product>(k);
  wrap<&Kernels::add_scaled, KernelPart::vectors>(k);
  wrap<&Kernels::add_multiple, KernelPart::vectors>(k);
  wrap<&Kernels::dots, KernelPart::vectors>(k);
  wrap<&Kernels::add_multiples, KernelPart::vectors>(k);
  wrap<&Kernels::pack_single, KernelPart::global>(k);
  wrap<&Kernels::pack_double, KernelPart::global>(k);
  wrap<&Kernels::unpack_single, KernelPart::global>(k);
  wrap<&Kernels::unpack_double, KernelPart::global>(k);
  wrap<&Kernels::subtract_packed_single, KernelPart::global>(k);
  wrap<&Kernels::subtract_packed_double, KernelPart::global>(k);
  wrap<&Kernels::solve_single, KernelPart::global>(k);
  wrap<&Kernels::solve_double, KernelPart::global>(k);
  return k;
}

}  // namespace

KernelClock::KernelClock() : timed_(timed_version(kernels())), plain_(replace_kernels(timed_)) {
  original = &plain_;
  reset();
}

KernelClock::~KernelClock() { replace_kernels(plain_); }

void KernelClock::reset() { part_seconds.fill(0); }

double KernelClock::seconds(KernelPart part) const { return part_seconds[static_cast<std::size_t>(part)]; }

}  // namespace drape
