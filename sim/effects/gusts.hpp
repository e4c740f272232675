#pragma once

#include <Eigen/Core>

namespace drape {

class Keys;

/// What the gusts of a wind are like.
struct GustValues {
  double speed = 0;     ///< the most that each component of the wind changes by; 0: there are none [m/s]
  double size = 1;      ///< from one gust to the next, in every direction [m]
  double duration = 1;  ///< lifetime of a gust, in the frame moving with the wind [s]
  int seed = 1;         ///< another number gives other gusts

  void describe(Keys& keys);
};

/// Gusts as a pure function of seed, place and time: value noise in four dimensions (random numbers at the points of a
/// lattice, smoothly interpolated), carried along by the wind (Taylor's frozen turbulence, 1938).
class Gusts {
 public:
  Gusts(const GustValues& values, const Eigen::Vector3d& wind) : values_(values), wind_(wind) {}

  /// What is added to the wind [m/s] at a place [m] and time [s]; each component is between −speed and speed,
  /// continuous with its first derivatives, and 0 on average.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& place, double time) const;

 private:
  GustValues values_;
  Eigen::Vector3d wind_;
};

}  // namespace drape
