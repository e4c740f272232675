#pragma once

#include <Eigen/Core>

namespace drape {

class Keys;

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
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& place, double time) const;

 private:
  GustValues values_;
  Eigen::Vector3d wind_;
};

}  // namespace drape
