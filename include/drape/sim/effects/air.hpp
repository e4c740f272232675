#pragma once

// Example:
//   drape::Effects effects{drape::Air{.velocity = {4, 0, 0}, .gusts = {.speed = 2}}};

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Parameters of a wind's gusts.
struct GustValues {
  double speed = 0;     ///< largest change of each component of the wind; 0: no gusts [m/s]
  double size = 1;      ///< distance from one gust to the next, in every direction [m]
  double duration = 1;  ///< lifetime of a gust, in the frame moving with the wind [s]
  int seed = 1;         ///< seed of the random numbers

  void describe(Keys& keys);
};

/// Gusts as a pure function of seed, position and time. Uses value noise in four dimensions (random numbers at lattice
/// points, smoothly interpolated) that moves with the wind (Taylor's frozen turbulence, 1938).
class Gusts {
 public:
  Gusts(const GustValues& values, const Eigen::Vector3d& wind) : values_(values), wind_(wind) {}

  /// Returns the change of the wind [m/s] at a position [m] and time [s]. Each component is between −speed and speed,
  /// continuously differentiable, and 0 on average.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& place, double time) const {
    std::optional<Cell> none;
    return at(place, time, none);
  }

  /// A cell of the lattice with the random vectors at its corners.
  struct Cell {
    std::array<std::int64_t, 4> place = {};
    std::array<Eigen::Vector3d, 16> corners;
  };
  /// Works like at(place, time), but reuses and updates the last cell: the next position is likely to be in it.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& place, double time, std::optional<Cell>& last) const;

 private:
  [[nodiscard]] Cell cell_at(const std::array<std::int64_t, 4>& place) const;

  GustValues values_;
  Eigen::Vector3d wind_;
};

/// Drag and lift of the air on every triangle, from a wind or from still air that slows the cloth down.
struct Air {
  static constexpr std::string_view name = "air";
  static constexpr EffectCost cost{.evaluated = 0.3e-6, .solved = 1.5e-6};

  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< wind velocity [m/s]
  double density = 1.2;                                ///< [kg/m³]
  double drag = 1.2;                                   ///< coefficient C_D of the force along the flow past a triangle
  double lift = 0.6;                                   ///< coefficient C_L of the force across the flow; requires drag
  GustValues gusts = {};

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
