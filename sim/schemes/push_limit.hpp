#pragma once

#include <vector>

#include "sim/system.hpp"

namespace drape {

/// Keeps what is solved for from throwing off faster than it may. A stage of SDIRK2 in which a stiff push stops a
/// vertex goes on with that push into a stage in which the vertex is no longer pushed, and would send it away with up
/// to √2 times the speed of its arrival. What is not the cloth's own energy is that of single vertices, so what one
/// gives to a vertex in a step is known: an impulse that turns it round leaves it no more than the energy that the push
/// held when the step began, and one that speeds it up adds no more than that. Where the step resolves the push,
/// neither is ever less than what the push gives.
class PushLimit {
 public:
  explicit PushLimit(const System& system);

  /// Takes note of the pushes on the vertices at the start of a step, and of one in it that gives them `share` of the
  /// step's length, each with its time [s].
  void begin(const Vertices& x, double time);
  void add(const Vertices& x, double time, double share);
  /// Takes from the velocities at the end of the step what no push may have given.
  void limit(double start, double end, Vertices& v) const;

 private:
  struct Push {
    const Energy* energy;
    Eigen::VectorXd bound;  // of its Hessian [N/m]
    Vertices held, mean;    // its gradient at the start, and its mean over the step [N]
  };

  std::vector<Push> pushes_;
  Eigen::VectorXd weight_;  // 1/m, 0 for pins [1/kg]
  Vertices gradient_;       // scratch
};

}  // namespace drape
