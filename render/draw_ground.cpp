#include "render/draw_ground.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "render/color.hpp"

namespace drape {
namespace {

/// Radius to which the ground is visible, in distances from the camera to its focus on the ground.
constexpr double reach = 2.6;
/// Depth below the drawn surface at which the ground starts to hide the cloth, in contact layers: a fast cloth
/// penetrates it for a moment.
constexpr double hidden_below = 3;
/// Height of the cloth from which its shadow is soft, in heights of the picture.
constexpr double softening = 0.1;

/// Returns the camera's focus on the ground, and the radius around it to which the ground is visible [m].
Eigen::Vector4d focus_of(const Shot& shot, const GroundShape& ground) {
  const Eigen::Vector3d eye = shot.eye.cast<double>(), forward = -shot.back.cast<double>();
  const double above = ground.normal.dot(eye) - ground.height, descent = -ground.normal.dot(forward);
  const double distance = descent > 0.1 ? above / descent : 3 * above;
  const Eigen::Vector3d ahead = eye + distance * forward;
  const Eigen::Vector3d focus = ahead - (ground.normal.dot(ahead) - ground.height) * ground.normal;
  return {focus[0], focus[1], focus[2], reach * distance};
}

void set(const Program& program, const char* name, const Eigen::Vector4d& value) {
  const Eigen::Vector4f single = value.cast<float>();
  program.set(name, std::span(&single, 1));
}

/// Returns corners of quadrilaterals that hold all shadows on a ground: those of spheres, with the size of
/// past_spheres() in shadow.glsl, and that of the cloth's picture.
Vertices shadow_corners(const Shot& shot, const GroundShape& ground, const GroundShadow& shadow) {
  const Eigen::Vector3d light = shot.key_direction.cast<double>().normalized();
  const double rise = ground.normal.dot(light);
  std::vector<Eigen::Vector3d> corners = shadow.corners(ground);
  const Eigen::Vector3d side = ground.normal.unitOrthogonal(), other = ground.normal.cross(side);
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    const Eigen::Vector3d center = sphere.head<3>().cast<double>();
    const double along = (ground.normal.dot(center) - ground.height) / rise;
    const double radius = double{sphere[3]}, farthest = std::abs(along) + radius / rise;
    const double reached = (1.05 * radius + 0.22 * farthest) / rise;
    for (const double x : {-reached, reached}) {
      for (const double y : {-reached, reached}) corners.emplace_back(center - along * light + x * side + y * other);
    }
  }
  Vertices points(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
  return points;
}

/// Returns the parts of the picture below, above, left and right of a box; some may be empty.
std::array<PixelBox, 4> around(const PixelBox& box, Eigen::Vector2i picture) {
  const Eigen::Vector2i from = box.corner, to = box.corner + box.size;
  return {PixelBox{{0, 0}, {picture.x(), from.y()}}, PixelBox{{0, to.y()}, {picture.x(), picture.y() - to.y()}},
          PixelBox{{0, from.y()}, {from.x(), box.size.y()}},
          PixelBox{{to.x(), from.y()}, {picture.x() - to.x(), box.size.y()}}};
}

}  // namespace

DrawGround::DrawGround(GlDevice& device, const Look& look, std::size_t sphere_count)
    : gl_(device.gl()),
      look_(look),
      lit_(&device.program("ground", light_defines(look, sphere_count, false))),
      array_(gl_),
      texture_(gl_) {
  if (look.shadows) shadowed_ = &device.program("ground", light_defines(look, sphere_count, true));
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// A shadow doubles the cost of a ground's pixel, so only pixels that it may touch use the shader with shadows.
void DrawGround::draw(const Shot& shot, const ClothShadow* shadow, Eigen::Vector2i picture) {
  gl_.BindVertexArray(array_.id());
  for (const GroundShape& ground : shot.grounds) {
    const PixelBox box = shadow != nullptr ? cast(shot, *shadow, ground, picture) : PixelBox{};
    if (!box.empty()) draw(*shadowed_, shot, ground, box);
    for (const PixelBox& rest : around(box, picture)) {
      if (!rest.empty()) draw(*lit_, shot, ground, rest);
    }
  }
  gl_.Scissor(0, 0, picture.x(), picture.y());
}

PixelBox DrawGround::cast(const Shot& shot, const ClothShadow& shadow, const GroundShape& ground,
                          Eigen::Vector2i picture) {
  const Eigen::Vector3d light = shot.key_direction.cast<double>().normalized();
  shadow_.cast(shadow.map(), ground, light, softening * shot.extent);
  if (!shadow_.reaches(ground, light)) return {};
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R16, shadow_.columns(), shadow_.rows(), 0, GL_RED, GL_UNSIGNED_SHORT,
                 shadow_.pixels().data());
  return box_around(shot, shadow_corners(shot, ground, shadow_), picture);
}

void DrawGround::draw(const Program& program, const Shot& shot, const GroundShape& ground, const PixelBox& box) const {
  program.use();
  shot.set_uniforms(program);
  program.set("cloth_shadow", 0);
  program.set("ground_color", linear_color(look_.ground_color));
  program.set("grid_spacing", shot.backdrop ? 0.0F : static_cast<float>(look_.ground_grid));
  program.set("from_clip", Eigen::Matrix4f(shot.view_projection.cast<double>().inverse().cast<float>()));
  set(program, "shadow_u", shadow_.u());
  set(program, "shadow_v", shadow_.v());
  set(program, "ground", {ground.normal[0], ground.normal[1], ground.normal[2], ground.height});
  set(program, "focus", focus_of(shot, ground));
  program.set("sunk", static_cast<float>(hidden_below * ground.thickness));
  gl_.Scissor(box.corner.x(), box.corner.y(), box.size.x(), box.size.y());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace drape
