#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace drape {

/// How far two pictures may be apart and still count as the same but for rounding. All of them must hold.
struct PictureLimits {
  int channel = 3;        ///< the largest difference of a pixel in any channel, of 255
  double pixels = 0.005;  ///< the largest fraction of pixels that differ at all
  double flip = 0.05;     ///< the largest FLIP error of a pixel
};

/// A scene's [check] table: what its golden frames and golden motion are, and what still counts as the same.
struct CheckSettings {
  std::vector<int> frames;              ///< of the film, ascending; empty: eight, spread over the motion
  std::optional<Eigen::Vector2i> size;  ///< of the golden pictures [pixels]; absent: the film's
  int window = 20;                      ///< steps of motion that are compared from each of the frames on
  double motion_tolerance = 1e-6;       ///< how far a vertex may end from its golden place [m]
  PictureLimits limits;
};

}  // namespace drape
