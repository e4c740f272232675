#include "render/draw_ground.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "render/color.hpp"

namespace drape {
namespace {

/// How far the ground is seen, in distances from the camera to where it looks.
constexpr double reach = 2.6;
/// What the cloth may sink below the surface that is drawn without being hidden by it, in layers of contact: a fast
/// cloth does so for a moment.
constexpr double hidden_below = 3;

/// Where on the ground the camera looks, and how far from there the ground is seen [m].
Eigen::Vector4d focus_of(const Shot& shot, const GroundShape& ground) {
  const Eigen::Vector3d eye = shot.eye.cast<double>(), forward = -shot.back.cast<double>();
  const double above = ground.normal.dot(eye) - ground.height, descent = -ground.normal.dot(forward);
  const double distance = descent > 0.1 ? above / descent : 3 * above;
  const Eigen::Vector3d ahead = eye + distance * forward;
  const Eigen::Vector3d focus = ahead - (ground.normal.dot(ahead) - ground.height) * ground.normal;
  return {focus[0], focus[1], focus[2], reach * distance};
}

}  // namespace

DrawGround::DrawGround(const GlFunctions& gl, const std::filesystem::path& data_folder, const Look& look,
                       const std::vector<Triangle>& triangles, std::size_t sphere_count)
    : gl_(gl),
      program_(gl, data_folder, "ground", {fmt::format("SPHERES {}", sphere_count)}),
      array_(gl),
      texture_(gl),
      shadow_(triangles) {
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  program_.use();
  program_.set("cloth_shadow", 0);
  program_.set("ground_color", linear_color(look.ground_color));
  program_.set("grid_spacing", static_cast<float>(look.ground_grid));
}

void DrawGround::draw(const Shot& shot) {
  program_.use();
  shot.set_uniforms(program_);
  program_.set("from_clip", Eigen::Matrix4f(shot.view_projection.cast<double>().inverse().cast<float>()));
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.BindVertexArray(array_.id());
  const auto set = [this](const char* name, const Eigen::Vector4d& value) {
    const Eigen::Vector4f single = value.cast<float>();
    program_.set(name, std::span(&single, 1));
  };
  for (const GroundShape& ground : shot.grounds) {
    shadow_.cast(shot.frame.positions, ground, shot.key_direction.cast<double>());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R16, GroundShadow::size, GroundShadow::size, 0, GL_RED, GL_UNSIGNED_SHORT,
                   shadow_.pixels().data());
    set("shadow_u", shadow_.u());
    set("shadow_v", shadow_.v());
    set("ground", {ground.normal[0], ground.normal[1], ground.normal[2], ground.height});
    set("focus", focus_of(shot, ground));
    program_.set("sunk", static_cast<float>(hidden_below * ground.thickness));
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

}  // namespace drape
