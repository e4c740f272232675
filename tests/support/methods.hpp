#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>
#include <utility>

#include "drape/sim/settings.hpp"

namespace drape::test {

/// A method, with its scheme if it is implicit, and its linear solver if it is Newton's.
struct Solver {
  Method method = Method::liu13;
  LinearSolver linear_solver = LinearSolver::automatic;
  TimeScheme scheme = TimeScheme::backward_euler;

  // Implicit conversion: most tests only name a method.
  constexpr Solver(Method m, LinearSolver l = LinearSolver::automatic) : method(m), linear_solver(l) {}
  constexpr Solver(Method m, TimeScheme s) : method(m), scheme(s) {}

  [[nodiscard]] constexpr bool is_explicit() const { return drape::is_explicit(method); }
  /// Returns true for second-order motions; all others are first-order.
  [[nodiscard]] constexpr bool second_order() const { return order_of({method, scheme}) == 2; }
};

struct NamedMethod : Solver {
  const char* name = "";
};

/// Every method. Tests parametrised over methods test all methods in this list.
inline constexpr std::array all_methods{
    NamedMethod{Method::semi_implicit, "SemiImplicit"},
    NamedMethod{Method::implicit, "Implicit"},
    NamedMethod{{Method::implicit, LinearSolver::cholesky}, "ImplicitCholesky"},
    NamedMethod{Method::liu13, "Liu13"},
    NamedMethod{Method::quasi_newton, "QuasiNewton"},
    NamedMethod{Method::verlet, "Verlet"},
    NamedMethod{{Method::implicit, TimeScheme::sdirk2}, "ImplicitSdirk2"},
    NamedMethod{{Method::liu13, TimeScheme::sdirk2}, "Liu13Sdirk2"},
    NamedMethod{{Method::quasi_newton, TimeScheme::sdirk2}, "QuasiNewtonSdirk2"},
};

/// `count` methods from index `first` on.
template <std::size_t first, std::size_t count>
inline constexpr auto some_methods = [] {
  auto some = [&]<std::size_t... i>(std::index_sequence<i...>) { return std::array{all_methods[first + i]...}; };
  return some(std::make_index_sequence<count>());
}();

/// Methods without a minimisation.
inline constexpr std::array explicit_methods{all_methods[0], all_methods[5]};
/// Methods that minimise the steps of backward Euler.
inline constexpr auto implicit_methods = some_methods<1, 4>;
/// Methods with second-order motions.
inline constexpr auto second_order_methods = some_methods<5, 4>;
/// Methods that minimise the stages of SDIRK2.
inline constexpr auto sdirk2_methods = some_methods<6, 3>;

inline void PrintTo(const NamedMethod& method, std::ostream* out) { *out << method.name; }

/// Names a parametrised test after its method.
inline std::string method_name(const testing::TestParamInfo<NamedMethod>& info) { return info.param.name; }

}  // namespace drape::test
