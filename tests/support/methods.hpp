#pragma once

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>
#include <utility>

#include "sim/settings.hpp"

namespace drape::test {

/// A method, and for Newton's method the way its equations are solved.
struct Solver {
  Method method = Method::liu13;
  LinearSolver linear_solver = LinearSolver::automatic;

  // Implicit: where nothing is said about the linear solver, a method is all that a test needs to name.
  constexpr Solver(Method m, LinearSolver l = LinearSolver::automatic) : method(m), linear_solver(l) {}
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
};

/// Those that minimise the implicit step, all but the first.
inline constexpr auto implicit_methods = [] {
  auto rest = [&]<std::size_t... i>(std::index_sequence<i...>) { return std::array{all_methods[i + 1]...}; };
  return rest(std::make_index_sequence<all_methods.size() - 1>());
}();

inline void PrintTo(const NamedMethod& method, std::ostream* out) { *out << method.name; }

/// Ends the name of a parametrised test with the method's.
inline std::string method_name(const testing::TestParamInfo<NamedMethod>& info) { return info.param.name; }

}  // namespace drape::test
