#pragma once

// Example:
//   drape::Camera camera{.azimuth = -60, .elevation = 20};
//   drape::Look look{.color = {0.2, 0.3, 0.8}, .mesh_lines = true};

// Example:
//   std::printf("%s", drape::backend_name(drape::GlBackend::osmesa));

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drape/core/rgb.hpp"

namespace drape {

/// Camera of the picture. With a position, it looks from there to `target`. Without one, it is placed so that the whole
/// motion is in view from the direction of `azimuth` and `elevation`. If one of the two angles is absent, well_placed()
/// chooses a direction that shows the motion well.
struct Camera {
  static constexpr double usual_azimuth = -60, usual_elevation = 20;  ///< defaults [degrees]

  std::optional<Eigen::Vector3d> position = {};  ///< [m]
  std::optional<Eigen::Vector3d> target = {};    ///< [m]; absent: the middle of the motion
  Eigen::Vector3d up{0, 0, 1};
  double field_of_view = 30;           ///< vertical field of view [degrees]
  std::optional<double> azimuth = {};  ///< from the target to the camera in the xy plane, from +x towards +y [degrees]
  std::optional<double> elevation = {};  ///< angle of that direction above the xy plane [degrees]
  double margin = 0.06;                  ///< free border around the motion, as a fraction of the picture
  bool follow = false;                   ///< stays near the moving objects instead of showing the whole motion at once
  double orbit = 0;                      ///< angle around the target, about `up`, over the whole film [degrees]
  double outside = 0;  ///< fraction of the frames whose farthest points may leave the picture of a fixed camera
};

/// Quantity that the colours of the cloth's vertices show instead of texture and colour. Enumerators have the order of
/// their names in scenes.
enum class ColorBy { stretch, speed, curvature };

/// The look of one of several cloths.
struct ClothLook {
  int first_triangle = 0;              ///< index of its first triangle; its range ends at the next cloth's first
  Rgb color{};                         ///< colour if there is no texture
  std::filesystem::path texture = {};  ///< an image file; empty: the plain `color`
  std::string place = {};              ///< place of the texture's name, for messages; empty: the look's own texture
};

/// The look of a picture. Colours are sRGB.
struct Look {
  std::filesystem::path texture = {};  ///< an image file; empty: the plain `color`
  Rgb color{0.85, 0.65, 0.13};         ///< colour of the cloth without a texture
  int anisotropy = 4;                  ///< maximum anisotropy of texture filtering; 1: off
  bool mesh_lines = false;             ///< draw the triangles' edges as thin dark lines
  Rgb line_color{0.16, 0.12, 0.06};
  double line_width = 0.8;                 ///< [pixels]
  std::optional<Rgb> background = {};      ///< at the bottom of the picture; everywhere if background_top is absent
  std::optional<Rgb> background_top = {};  ///< at the top: a gradient; both absent: studio grey
  Rgb sphere_color{0.75, 0.04, 0.04};
  Rgb body_color{0.47, 0.52, 0.58};
  Rgb ground_color{0.84, 0.83, 0.81};
  double ground_grid = 0.5;  ///< spacing of the lines on the ground [m]; 0: no lines
  int samples = 1;           ///< samples per pixel: 1 (with smoothed outlines), 2 or 4
  std::optional<ColorBy> color_by = {};
  std::optional<double> color_limit = {};  ///< value at the end of the colour scale: a fraction, [m/s] or [1/m]
  bool shadows = true;                     ///< cast by cloth and spheres in the key light
  bool ambient_occlusion = true;
  double translucency = 0.3;                 ///< fraction of the key light that shines through the cloth
  double thickness = 0.003;                  ///< thickness of the cloth's hem [m]; 0: no hem
  double exposure = 1;                       ///< factor of all light
  std::optional<double> key_azimuth = {};    ///< like Camera::azimuth [degrees]; absent: moves with the camera
  std::optional<double> key_elevation = {};  ///< like Camera::elevation [degrees]; absent: moves with the camera
  bool backdrop = false;                     ///< a floor below the picture's lower edge, if the scene has no ground
  std::vector<ClothLook> cloths = {};        ///< replace `color` and `texture` for several cloths; empty: one cloth

  /// Background at the bottom and at the top of the picture. The default is a studio grey: darker than white cloth in
  /// light, brighter than any cloth in shade, and in a colour that cloth rarely has.
  [[nodiscard]] Rgb lower_background() const { return background.value_or(Rgb{0.84, 0.85, 0.86}); }
  [[nodiscard]] Rgb upper_background() const {
    return background_top.value_or(background ? *background : Rgb{0.66, 0.71, 0.77});
  }
};

/// Size [pixels], frame rate, and playback speed of the film relative to the scene's time.
struct Video {
  double fps = 25;
  double speed = 1;
  Eigen::Vector2i size{480, 400};

  /// Returns the number of the motion's last frame. Frame k shows k·speed/fps seconds.
  /// @param duration length of the motion [s]
  [[nodiscard]] double last_frame(double duration) const {
    // The tolerance keeps rounding of duration·fps/speed from dropping the last frame.
    constexpr double rounding = 1e-9;
    return std::floor(duration / (speed / fps) + rounding);
  }
};

/// Source of the OpenGL context. OSMesa and EGL produce identical pictures with Mesa's software renderer.
enum class GlBackend {
  automatic,  ///< the first available of the following
  osmesa,     ///< OSMesa: Mesa up to 25.0
  egl         ///< EGL without a surface
};

/// Returns "auto", "osmesa" or "egl".
const char* backend_name(GlBackend backend);

}  // namespace drape
