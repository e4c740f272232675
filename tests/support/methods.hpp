#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>
#include <utility>

#include "sim/settings.hpp"

namespace drape::test {

/// A method, for an implicit one the scheme, and for Newton's method the way its equations are solved.
struct Solver {
  Method method = Method::liu13;
  LinearSolver linear_solver = LinearSolver::automatic;
  TimeScheme scheme = TimeScheme::backward_euler;

  // Implicit: where nothing is said about the others, a method is all that a test needs to name.
  constexpr Solver(Method m, LinearSolver l = LinearSolver::automatic) : method(m), linear_solver(l) {}
  constexpr Solver(Method m, TimeScheme s) : method(m), scheme(s) {}

  [[nodiscard]] constexpr bool is_explicit() const { return drape::is_explicit(method); }
  /// Whether its motions are of second order; those of the others are of first.
  [[nodiscard]] constexpr bool second_order() const {
    return method == Method::verlet || (!is_explicit() && scheme == TimeScheme::sdirk2);
  }
};

struct NamedMethod : Solver {
  const char* name = "";
};

/// Every method. A new one is tested by everything that is parametrised over methods once it stands here.
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

/// `count` of them from the one at `first` on.
template <std::size_t first, std::size_t count>
inline constexpr auto some_methods = [] {
  auto some = [&]<std::size_t... i>(std::index_sequence<i...>) { return std::array{all_methods[first + i]...}; };
  return some(std::make_index_sequence<count>());
}();

/// Those that minimise nothing.
inline constexpr std::array explicit_methods{all_methods[0], all_methods[5]};
/// Those that minimise the steps of backward Euler.
inline constexpr auto implicit_methods = some_methods<1, 4>;
/// Those whose motions are of second order.
inline constexpr auto second_order_methods = some_methods<5, 4>;
/// Those that minimise the stages of SDIRK2.
inline constexpr auto sdirk2_methods = some_methods<6, 3>;

inline void PrintTo(const NamedMethod& method, std::ostream* out) { *out << method.name; }

/// Ends the name of a parametrised test with the method's.
inline std::string method_name(const testing::TestParamInfo<NamedMethod>& info) { return info.param.name; }

}  // namespace drape::test
