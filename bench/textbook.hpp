#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/cloth.hpp"

/// Plain implementations of the three methods from their formulas, with general-purpose matrices: the reference that
/// drape's solvers are measured against, and an independent check of their results.
namespace drape::textbook {

/// A sphere that pushes: a = stiffness · max(scale·radius − ‖x−center‖, 0) · (x−center)/‖x−center‖ [m/s²].
struct Sphere {
  Eigen::Vector3d center{0, 0, -0.5};  ///< [m]
  double radius = 0.4;                 ///< [m]
  double scale = 1.1;
  double stiffness = 8000;  ///< [1/s²]
};

/// Hessian that Newton's method uses for a compressed spring, where x joins its ends and is shorter than the rest
/// length L. The exact one, k x̂x̂ᵀ + k(1−L/‖x‖)(I − x̂x̂ᵀ), has negative eigenvalues there.
enum class CompressedHessian {
  projected,  ///< k x̂x̂ᵀ: the exact one without its negative eigenvalues
  scaled      ///< k (L/‖x‖) x̂x̂ᵀ
};

struct Settings {
  double step = 0.02;                   ///< h [s]
  double damping = 1;                   ///< fraction of a velocity that remains after one second
  Eigen::Vector3d gravity{0, 0, -9.8};  ///< [m/s²]
  std::optional<Sphere> sphere = std::nullopt;
  double tolerance = 1e-3;                           ///< ε [m], on the 2-norm of the change of all unknowns together
  std::optional<int> max_iterations = std::nullopt;  ///< absent: 20 for Newton, 100 for Liu13
  CompressedHessian compressed = CompressedHessian::projected;
};

/// A cloth with a time-stepping method. The state may be set between steps.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void step() = 0;

  Eigen::MatrixXd positions;   ///< n×3 [m]
  Eigen::MatrixXd velocities;  ///< n×3 [m/s]
  int iterations = 0;          ///< linear solves in the last step
  /// y = xₙ + h vₙ + h² M⁻¹ f_ext of the last step, n×3 [m]; empty if the method has none.
  Eigen::MatrixXd inertial_positions;

 protected:
  Stepper(const Cloth& cloth, const Settings& settings);
  [[nodiscard]] Eigen::MatrixXd external_acceleration() const;
  void find_inertial_positions();
  void finish_implicit_step(const Eigen::MatrixXd& new_positions);

  const Cloth cloth_;
  const Settings settings_;
  std::vector<bool> pinned_;  ///< n
};

/// Makes semi-implicit Euler: v += h a, v *= d^h, x += h v.
std::unique_ptr<Stepper> make_semi_implicit(const Cloth& cloth, const Settings& settings);

/// Makes Newton's method on g(x) = 1/(2h²)‖x−y‖²_M + E(x), from x = y, with full steps; assembles, analyses and factors
/// the matrix in every iteration.
std::unique_ptr<Stepper> make_newton(const Cloth& cloth, const Settings& settings);

/// Makes the method of Liu, Bargteil, O'Brien, Kavan: Fast Simulation of Mass-Spring Systems (2013), section 4: from
/// x = y, alternates dᵢ = Lᵢ x̂ᵢ with (M + h²L) x = h² J d + M y, whose 3n×3n matrix is factored once.
std::unique_ptr<Stepper> make_liu13(const Cloth& cloth, const Settings& settings);

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

/// Computes ‖∇g‖ over the unpinned vertices at the end of the stepper's last step [N].
double gradient_norm(const Cloth& cloth, const Settings& settings, const Stepper& stepper);

/// Energies [J], with gravity = −Σ m g·x.
struct Energies {
  double kinetic = 0, gravity = 0, elastic = 0;
  [[nodiscard]] double total() const { return kinetic + gravity + elastic; }
};
Energies energies(const Cloth& cloth, const Settings& settings, const Stepper& stepper);

}  // namespace drape::textbook
