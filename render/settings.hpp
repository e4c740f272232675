#pragma once

// Example:
//   drape::Camera camera{.azimuth = -60, .elevation = 20};
//   drape::Look look{.color = {0.2, 0.3, 0.8}, .mesh_lines = true};

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/rgb.hpp"

namespace drape {

/// Where the picture is taken from. With a position, the camera looks from there to `target`; without one it is placed
/// so that the whole motion is in view, seen from the direction that `azimuth` and `elevation` give, or, where one of
/// them is absent, from a direction that shows the motion well: see well_placed().
struct Camera {
  static constexpr double usual_azimuth = -60, usual_elevation = 20;  ///< where nothing says more [degrees]

  std::optional<Eigen::Vector3d> position = {};  ///< [m]
  std::optional<Eigen::Vector3d> target = {};    ///< [m]; absent: the middle of the motion
  Eigen::Vector3d up{0, 0, 1};
  double field_of_view = 30;           ///< of the picture's height [degrees]
  std::optional<double> azimuth = {};  ///< from the target to the camera in the xy plane, from +x towards +y [degrees]
  std::optional<double> elevation = {};  ///< of that direction above the xy plane [degrees]
  double margin = 0.06;                  ///< free border around the motion, as a fraction of the picture
  bool follow = false;                   ///< stays near what moves, instead of where all of the motion is in view
  double orbit = 0;                      ///< how far it goes around the target, about `up`, in the whole film [degrees]
  double outside = 0;  ///< part of the frames whose farthest points a camera that stays may leave outside the picture
};

/// What the colours of a cloth's vertices show, in place of its texture and its colour. The order is that of the names
/// in a scene.
enum class ColorBy { stretch, speed, curvature };

/// The look of a picture. Colours are sRGB.
struct Look {
  std::filesystem::path texture = {};  ///< an image file; empty: the plain `color`
  Rgb color{0.85, 0.65, 0.13};         ///< of the cloth, where it has no texture
  int anisotropy = 1;                  ///< of the texture's filter, 1 is off: in software it is slow
  bool mesh_lines = false;             ///< draw the triangles' edges as thin dark lines
  Rgb line_color{0.16, 0.12, 0.06};
  double line_width = 0.8;                 ///< [pixels]
  std::optional<Rgb> background = {};      ///< at the bottom of the picture, and everywhere without the next
  std::optional<Rgb> background_top = {};  ///< at the top: a gradient; absent, with the other: the grey of a studio
  Rgb sphere_color{0.75, 0.04, 0.04};
  Rgb body_color{0.47, 0.52, 0.58};
  Rgb ground_color{0.84, 0.83, 0.81};
  double ground_grid = 0.5;  ///< distance of the lines on the ground, 0 without lines [m]
  int samples = 4;           ///< per pixel: 1 (off), 2, 4
  std::optional<ColorBy> color_by = {};
  std::optional<double> color_limit = {};  ///< what the last colour stands for: as a part of 1, [m/s] or [1/m]
  bool shadows = true;                     ///< of cloth and spheres, in the key light
  bool ambient_occlusion = true;
  double translucency = 0.3;                 ///< part of the key light that shines through the cloth
  double thickness = 0.003;                  ///< of the cloth's hem, 0 without one [m]
  double exposure = 1;                       ///< by what all light is multiplied
  std::optional<double> key_azimuth = {};    ///< of the key light, as the camera's; absent: it goes with the camera
  std::optional<double> key_elevation = {};  ///< likewise [degrees]
  bool backdrop = false;                     ///< a floor below the picture's lower edge, where the scene has no ground

  /// The background at the bottom and at the top of the picture. Without one it is the grey of a studio: darker than
  /// white cloth in the light, brighter than any in the shade, and of a colour that little cloth has.
  [[nodiscard]] Rgb lower_background() const { return background.value_or(Rgb{0.84, 0.85, 0.86}); }
  [[nodiscard]] Rgb upper_background() const {
    return background_top.value_or(background ? *background : Rgb{0.66, 0.71, 0.77});
  }
};

/// The film: its size in pixels, its frames per second, and how much faster than the scene's time it plays.
struct Video {
  double fps = 25;
  double speed = 1;
  Eigen::Vector2i size{480, 400};

  /// The number of a motion's last frame. Frame k is taken at k·speed/fps seconds.
  /// @param duration of the motion [s]
  [[nodiscard]] double last_frame(double duration) const {
    // Both are products of decimal fractions: a frame at the motion's end must not miss it by their rounding.
    constexpr double rounding = 1e-9;
    return std::floor(duration / (speed / fps) + rounding);
  }
};

}  // namespace drape
