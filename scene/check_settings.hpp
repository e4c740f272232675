#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace drape {

/// How far two pictures may be apart and still count as the same but for rounding. All of them must hold.
struct PictureLimits {
  int channel = 3;        ///< the largest difference of a pixel in any channel, of 255
  double pixels = 0.005;  ///< the largest fraction of pixels that differ at all
  double flip = 0.05;     ///< the largest FLIP error of a pixel
};

/// A rectangle of golden pixels: column and row of its top left one, width and height.
using PixelRectangle = std::array<int, 4>;

/// A scene's [check] table: what its golden frames and golden motion are, and what still counts as the same.
struct CheckSettings {
  std::vector<int> frames;              ///< of the film, ascending; empty: those in which something happens
  std::optional<Eigen::Vector2i> size;  ///< of the golden pictures [pixels]; absent: the film's
  double window_time = 0.4;             ///< after which the motion starts again from a golden state [s]
  double motion_tolerance = 1e-6;       ///< how far a vertex may be from its golden place [m]
  PictureLimits limits;
  std::optional<double> time;  ///< how many times as long as the golden the first steps may take; absent: not measured
  std::vector<PixelRectangle> ignore;  ///< what is not judged in any picture
  std::vector<int> ignore_frames;      ///< whose pictures are not judged at all
};

}  // namespace drape
