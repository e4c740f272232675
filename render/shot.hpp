#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "render/gl/program.hpp"
#include "render/settings.hpp"
#include "render/view.hpp"
#include "sim/frame.hpp"

namespace drape {

/// What everything that is drawn in one frame shares: the camera and the lights.
struct Shot {
  const Frame& frame;
  Eigen::Matrix4f view_projection;       ///< from the world to clip space
  Eigen::Vector3f eye;                   ///< [m]
  Eigen::Vector3f back;                  ///< unit vector from where the camera looks to the camera
  double extent;                         ///< what the picture's height shows, where the camera looks [m]
  Eigen::Vector3f up;                    ///< the sky is there
  Eigen::Vector3f key_direction;         ///< unit vector towards the key light
  Eigen::Vector3f fill_direction;        ///< unit vector towards the fill light
  std::vector<Eigen::Vector4f> spheres;  ///< center and radius of each [m]
  std::vector<GroundShape> grounds;      ///< those that are seen from above
  std::vector<const MeshShape*> bodies;  ///< of the frame
  float exposure;                        ///< by what light is multiplied
  bool backdrop = false;                 ///< whether the only ground is a backdrop's floor

  /// The lights stand with the camera, so that a scene looks alike from every side, unless the look places the key
  /// light.
  Shot(const Frame& shown, const View& view, double aspect, const Look& look = {});

  /// Hands all of it to a program that includes lighting.glsl and is in use.
  void set_uniforms(const Program& program) const;
};

/// The unit vector towards the key light.
Eigen::Vector3d key_light(const View& view, const Look& look);

/// What shaders that include shadow.glsl are compiled with: what the look switches off is not in them.
/// @param shadows whether what they draw may have shadows on it
std::vector<std::string> light_defines(const Look& look, std::size_t sphere_count, bool shadows);

}  // namespace drape
