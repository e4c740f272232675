#pragma once

#include "sim/kernels/kernels.hpp"

namespace drape {

/// Kernels of a substitution in one number type.
template <class T>
struct Substitution;
template <>
struct Substitution<float> {
  static constexpr auto pack = &Kernels::pack_single;
  static constexpr auto solve = &Kernels::solve_single;
  static constexpr auto forward = &Kernels::forward_single;
  static constexpr auto backward = &Kernels::backward_single;
  static constexpr auto unpack = &Kernels::unpack_single;
  static constexpr auto subtract = &Kernels::subtract_packed_single;
};
template <>
struct Substitution<double> {
  static constexpr auto pack = &Kernels::pack_double;
  static constexpr auto solve = &Kernels::solve_double;
  static constexpr auto forward = &Kernels::forward_double;
  static constexpr auto backward = &Kernels::backward_double;
  static constexpr auto unpack = &Kernels::unpack_double;
  static constexpr auto subtract = &Kernels::subtract_packed_double;
};

}  // namespace drape
