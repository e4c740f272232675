#pragma once

#include "sim/integrators/implicit_euler.hpp"
#include "sim/linear/newton_system.hpp"

namespace drape {

/// Implicit Euler by Newton's method on g, with a backtracking line search, so that no iteration raises g.
class ImplicitNewton final : public ImplicitEuler {
 public:
  ImplicitNewton(const System& system, const IntegratorSettings& settings);

 private:
  double iterate(Point& point) override;

  NewtonSystem newton_;
  Vertices direction_;
};

}  // namespace drape
