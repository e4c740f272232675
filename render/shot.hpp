#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/render/view.hpp"
#include "drape/sim/state.hpp"
#include "render/gl/program.hpp"

namespace drape {

/// Data of one frame that all draw calls share: camera and lights.
struct Shot {
  const Frame& frame;
  Eigen::Matrix4f view_projection;       ///< from the world to clip space
  Eigen::Vector3f eye;                   ///< [m]
  Eigen::Vector3f back;                  ///< unit vector from the target to the camera
  double extent;                         ///< height of the scene that the picture shows, at the target [m]
  Eigen::Vector3f up;                    ///< direction of the sky
  Eigen::Vector3f key_direction;         ///< unit vector towards the key light
  Eigen::Vector3f fill_direction;        ///< unit vector towards the fill light
  std::vector<Eigen::Vector4f> spheres;  ///< center and radius of each [m]
  std::vector<GroundShape> grounds;      ///< those seen from above
  std::vector<Eigen::Vector4f> cuts;     ///< normal and height of the grounds that cut spheres and bodies
  std::vector<const MeshShape*> bodies;  ///< of the frame
  float exposure;                        ///< factor of all light
  bool backdrop = false;                 ///< true if the only ground is a backdrop's floor

  /// Places the lights relative to the camera, so that a scene looks alike from every side; the look may place the key
  /// light.
  Shot(const Frame& shown, const View& view, double aspect, const Look& look = {});

  /// Sets the uniforms of lighting.glsl in a program that is in use.
  void set_uniforms(const Program& program) const;
};

/// Returns the unit vector towards the key light.
Eigen::Vector3d key_light(const View& view, const Look& look);

/// Returns the preprocessor definitions for shaders that include shadow.glsl; features that the look disables are left
/// out.
/// @param shadows true if shadows may fall on the drawn objects
std::vector<std::string> light_defines(const Look& look, std::size_t sphere_count, bool shadows);

/// Returns true if a length spans so many pixels at some vertex of the cloth.
/// @param length [m]
/// @param height height of the picture [pixels]
bool resolves(const Shot& shot, double length, double pixels, int height);

/// A rectangle of pixels, with its corner counted from the lower left.
struct PixelBox {
  Eigen::Vector2i corner{0, 0};
  Eigen::Vector2i size{0, 0};

  [[nodiscard]] bool empty() const { return size.minCoeff() <= 0; }
};

/// Returns a box with every pixel that the shot may cover; all pixels outside are background. With a ground, or with
/// an object beside or behind the camera, it is the whole picture.
/// @param cloth   drawn vertices of the cloth
/// @param picture width and height [pixels]
PixelBox covered_box(const Shot& shot, const Vertices& cloth, Eigen::Vector2i picture);

/// Returns a box with every pixel of the convex hull of the points; empty without points.
PixelBox box_around(const Shot& shot, const Vertices& points, Eigen::Vector2i picture);

}  // namespace drape
