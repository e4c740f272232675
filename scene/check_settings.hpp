#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace drape {

/// Largest difference between two pictures that still count as equal up to rounding. All limits must hold.
struct PictureLimits {
  int channel = 3;        ///< largest difference of a pixel in any channel, of 255
  double pixels = 0.005;  ///< largest fraction of pixels that differ at all
  double flip = 0.05;     ///< largest FLIP error of a pixel
};

/// A rectangle of golden pixels: column and row of its top left one, width and height.
using PixelRectangle = std::array<int, 4>;

/// The [check] table of a scene: which golden frames and motion to compare, and with which tolerances.
struct CheckSettings {
  std::vector<int> frames;              ///< film frames to compare, ascending; empty: chosen automatically, where
                                        ///< something happens
  std::optional<Eigen::Vector2i> size;  ///< size of the golden pictures [pixels]; absent: film size
  double window_time = 0.4;             ///< interval between restarts of the motion from a golden state [s]
  double motion_tolerance = 1e-6;       ///< largest distance of a vertex from its golden position [m]
  PictureLimits limits;
  std::optional<double> time;          ///< largest ratio of the first steps' time to the golden's; absent: not measured
  std::vector<PixelRectangle> ignore;  ///< rectangles left out of the comparison in every picture
  std::vector<int> ignore_frames;      ///< frames whose pictures are not compared
};

}  // namespace drape
