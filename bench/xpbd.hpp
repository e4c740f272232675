#pragma once

#include <vector>

#include "bench/textbook.hpp"

namespace drape::textbook {

/// Extended position-based dynamics with small steps (Macklin, Müller and Chentanez 2016, "XPBD", equations 17 and 18;
/// Macklin et al. 2019, "Small steps in physics simulation", algorithm 2): one pass over the springs per step, as
/// constraints C = ‖x₂−x₁‖ − L with the compliance 1/k. Springs of a colour share no vertex, so a colour is one loop of
/// vector instructions. Without sphere.
class Xpbd final : public Stepper {
 public:
  Xpbd(const Cloth& cloth, const Settings& settings);
  void step() override;

 private:
  /// Springs that share no vertex, as arrays.
  struct Color {
    std::vector<int> first, second;
    std::vector<double> rest;        ///< [m]
    std::vector<double> compliance;  ///< w₁ + w₂ + 1/(k h²) [1/kg]
  };

  std::vector<Color> colors_;
  Eigen::ArrayXd inverse_masses_;  ///< per vertex, 0 for pins [1/kg]
};

}  // namespace drape::textbook
