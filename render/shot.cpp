#include "render/shot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/unit_vector.hpp"

namespace drape {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Returns a direction in a view's axes, with the second axis towards the sky instead of the picture's top.
Eigen::Vector3d towards(const View& view, double right, double upwards, double backwards) {
  const Eigen::Matrix3d axes = view.axes();
  return (right * axes.row(0).transpose() + upwards * unit_vector(view.up) + backwards * axes.row(2).transpose())
      .normalized();
}

/// Returns the floor of a backdrop, at or a little below the picture's lower edge at the target's depth. It hides
/// nothing.
GroundShape backdrop_floor(const View& view, double extent) {
  const Eigen::Vector3d sky = unit_vector(view.up);
  const double upright = view.axes().row(1).dot(sky);
  return {.normal = sky, .height = sky.dot(view.target) - 0.55 * extent * upright, .thickness = extent};
}

}  // namespace

Eigen::Vector3d key_light(const View& view, const Look& look) {
  Eigen::Vector3d usual = towards(view, -0.75, 0.8, 0.5);
  if (!look.key_azimuth && !look.key_elevation) return usual;
  const double azimuth = look.key_azimuth ? *look.key_azimuth * degree : std::atan2(usual.y(), usual.x());
  const double elevation =
      look.key_elevation ? *look.key_elevation * degree : std::asin(std::clamp(usual.z(), -1.0, 1.0));
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Shot::Shot(const Frame& shown, const View& view, double aspect, const Look& look)
    : frame(shown), exposure(static_cast<float>(look.exposure)) {
  const DepthRange depth = depth_range(view, shown, look.thickness);
  view_projection = (view.projection_matrix(aspect, depth) * view.view_matrix()).cast<float>();
  eye = view.position.cast<float>();

  const Eigen::Matrix3d axes = view.axes();
  const Eigen::Vector3d sky = unit_vector(view.up);
  extent = 2 * std::tan(view.field_of_view * degree / 2) * (view.position - view.target).norm();
  back = axes.row(2).transpose().cast<float>();
  up = sky.cast<float>();
  key_direction = key_light(view, look).cast<float>();
  fill_direction = towards(view, 0.8, 0.15, 0.5).cast<float>();

  for (const Collider& collider : shown.colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      const Eigen::Vector4d packed{sphere->center.x(), sphere->center.y(), sphere->center.z(), sphere->radius};
      spheres.push_back(packed.cast<float>());
    } else if (const auto* ground = std::get_if<GroundShape>(&collider)) {
      if (ground->normal.dot(view.position) > ground->height) grounds.push_back(*ground);
    } else if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
      bodies.push_back(mesh);
    }
  }
  if (look.backdrop && grounds.empty()) {
    const GroundShape floor = backdrop_floor(view, extent);
    backdrop = floor.normal.dot(view.position) > floor.height;
    if (backdrop) grounds.push_back(floor);
  }
}

void Shot::set_uniforms(const Program& program) const {
  program.set("view_projection", view_projection);
  program.set("eye", eye);
  program.set("up", up);
  program.set("key_direction", key_direction);
  program.set("fill_direction", fill_direction);
  program.set("exposure", exposure);
  program.set("spheres", spheres);
  std::vector<Eigen::Vector4f> planes;
  for (const GroundShape& ground : grounds) {
    planes.emplace_back();
    planes.back() << ground.normal.cast<float>(), static_cast<float>(ground.height);
  }
  program.set("grounds", planes);
}

std::vector<std::string> light_defines(const Look& look, std::size_t sphere_count, bool shadows) {
  std::vector<std::string> defines{fmt::format("SPHERES {}", sphere_count)};
  if (shadows) defines.emplace_back("SHADOWS");
  if (look.ambient_occlusion) defines.emplace_back("OCCLUSION");
  if (look.translucency > 0) defines.emplace_back("TRANSLUCENCY");
  return defines;
}

}  // namespace drape
