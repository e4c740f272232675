#pragma once

#include "sim/integrators/implicit_euler.hpp"
#include "sim/linear/newton_solver.hpp"

namespace drape {

/// Implicit Euler by Newton's method on g, with a backtracking line search, so that no iteration raises g.
class ImplicitNewton final : public ImplicitEuler {
 public:
  ImplicitNewton(const System& system, const IntegratorSettings& settings);

 private:
  double iterate(Point& point) override;

  std::unique_ptr<NewtonSolver> solver_;
  Vertices direction_;
};

}  // namespace drape
