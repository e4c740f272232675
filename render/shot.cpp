#include "render/shot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "render/unit_vector.hpp"

namespace drape {

Shot::Shot(const Frame& shown, const View& view, double aspect) : frame(shown) {
  const DepthRange depth = depth_range(view, shown);
  view_projection = (view.projection_matrix(aspect, depth) * view.view_matrix()).cast<float>();
  eye = view.position.cast<float>();

  const Eigen::Matrix3d axes = view.axes();
  const Eigen::Vector3d sky = unit_vector(view.up);
  const auto towards = [&](double right, double upwards, double backwards) {
    return (right * axes.row(0).transpose() + upwards * sky + backwards * axes.row(2).transpose())
        .normalized()
        .cast<float>()
        .eval();
  };
  constexpr double degree = std::numbers::pi / 180;
  extent = 2 * std::tan(view.field_of_view * degree / 2) * (view.position - view.target).norm();
  back = axes.row(2).transpose().cast<float>();
  up = sky.cast<float>();
  key_direction = towards(-0.75, 0.8, 0.5);
  fill_direction = towards(0.8, 0.15, 0.5);

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
}

void Shot::set_uniforms(const Program& program) const {
  program.set("view_projection", view_projection);
  program.set("eye", eye);
  program.set("up", up);
  program.set("key_direction", key_direction);
  program.set("fill_direction", fill_direction);
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
