#include "render/cloth_shadow.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace drape {
namespace {

/// Texels across what the picture shows: a shadow's edge is as soft in a large picture as in a small one.
constexpr double resolution = 400;
/// Texels that no side of the map exceeds, where the camera sees only a part of the cloth.
constexpr int largest_map = 1024;
/// Of a shadow, in texels: what the cloth must be above a point to take all of its light.
constexpr double edge_width = 2;

/// Texels around a point that its shadow may be of: it is lifted by a diagonal, and read a diagonal away.
constexpr int filtered = 3;

}  // namespace

ClothShadow::ClothShadow(const GlFunctions& gl) : gl_(gl), texture_(gl) {
  gl_.ActiveTexture(GL_TEXTURE0 + texture_unit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void ClothShadow::cast(const Shot& shot, const Occluders& occluders) {
  const Eigen::Vector3d light = shot.key_direction.cast<double>().normalized();
  map_.look(light, shot.up.cast<double>());
  map_.draw(occluders.positions(), occluders.triangles(), shot.extent / resolution, largest_map);
  softness_ = edge_width * map_.texel();
  spheres_.clear();
  for (const Eigen::Vector4f& sphere : shot.spheres) {
    Eigen::Vector4d center = sphere.cast<double>();
    center[3] = 1;
    spheres_.emplace_back(map_.u().dot(center), map_.v().dot(center), map_.depth().dot(center), double{sphere[3]});
  }

  constexpr std::array<float, 1> nothing{-std::numeric_limits<float>::max()};
  const bool empty = map_.columns() == 0;
  const Eigen::Vector2i size = empty ? Eigen::Vector2i(1, 1) : Eigen::Vector2i(map_.columns(), map_.rows());
  const float* depths = empty ? nothing.data() : map_.nearest().data();
  gl_.ActiveTexture(GL_TEXTURE0 + texture_unit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (size == size_) {
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x(), size.y(), GL_RED, GL_FLOAT, depths);
  } else {
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, size.x(), size.y(), 0, GL_RED, GL_FLOAT, depths);
  }
  size_ = size;
}

bool ClothShadow::may_fall_on(const Triangle& triangle) const {
  if (map_.columns() == 0) return true;
  return is_behind_cloth(triangle) || is_behind_a_sphere(triangle);
}

// Whether there are two layers anywhere, of which one is above the triangle's plane, in the rectangle around it and
// what the filter takes in. What is above the plane and the only layer is the surface itself, which curves.
bool ClothShadow::is_behind_cloth(const Triangle& triangle) const {
  const auto corner = [&](std::size_t c) { return map_.places().row(triangle[c]).transpose().eval(); };
  const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2), normal = (b - a).cross(c - a);
  if (std::abs(normal[2]) < 1e-3) return true;
  const double slope = -normal[0] / normal[2], rise = -normal[1] / normal[2];
  const Eigen::Array3d low = a.array().min(b.array()).min(c.array()), high = a.array().max(b.array()).max(c.array());
  const int left = std::max(static_cast<int>(low[0]) - filtered, 0);
  const int right = std::min(static_cast<int>(high[0]) + filtered, map_.columns() - 1);
  const int bottom = std::max(static_cast<int>(low[1]) - filtered, 0);
  const int top = std::min(static_cast<int>(high[1]) + filtered, map_.rows() - 1);
  const auto tolerated = static_cast<float>(map_.texel()), step = static_cast<float>(slope);
  for (int row = bottom; row <= top; ++row) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * map_.columns() + left;
    const float* nearest = map_.nearest().data() + first;
    const float* farthest = map_.farthest().data() + first;
    const auto start = static_cast<float>(a[2] + (left + 0.5 - a[0]) * slope + (row + 0.5 - a[1]) * rise);
    int above = 0;
    for (int k = 0; k <= right - left; ++k) {
      const float lower = std::max(start + static_cast<float>(k) * step, farthest[k]);
      above |= nearest[k] - lower > tolerated ? 1 : 0;
    }
    if (above != 0) return true;
  }
  return false;
}

// As past_spheres() in shadow.glsl, by how far away from the sphere's axis in the light the triangle comes at most.
bool ClothShadow::is_behind_a_sphere(const Triangle& triangle) const {
  if (spheres_.empty()) return false;
  const auto corner = [&](std::size_t c) { return map_.places().row(triangle[c]).transpose().array(); };
  const Eigen::Array3d low = corner(0).min(corner(1)).min(corner(2)), high = corner(0).max(corner(1)).max(corner(2));
  return std::ranges::any_of(spheres_, [&](const Eigen::Vector4d& sphere) {
    const double radius = sphere[3], along = sphere[2] - low[2];
    if (along < -0.3 * radius) return false;
    const Eigen::Array2d center = sphere.head<2>().array();
    const Eigen::Array2d beside = (low.head<2>() - center).max(center - high.head<2>()).max(0.0);
    return beside.matrix().norm() * map_.texel() <= 1.05 * radius + 0.22 * std::max(along, 0.0);
  });
}

void ClothShadow::set_uniforms(const Program& program) const {
  const auto set = [&program](const char* name, const Eigen::Vector4d& value) {
    const Eigen::Vector4f single = value.cast<float>();
    program.set(name, std::span(&single, 1));
  };
  const bool empty = map_.columns() == 0;
  const Eigen::Vector4d middle(0, 0, 0, -0.5);  // of a texel is a whole number for the shader
  set("shadow_u", empty ? Eigen::Vector4d::Zero().eval() : (map_.u() + middle).eval());
  set("shadow_v", empty ? Eigen::Vector4d::Zero().eval() : (map_.v() + middle).eval());
  set("shadow_depth", empty ? Eigen::Vector4d::Zero().eval() : map_.depth());
  // What is behind all of the cloth is as dark as half a block behind it, in front of what an empty texel holds.
  program.set("shadow_lowest", static_cast<float>(-0.5 * DepthMap::block * map_.texel()));
  set("shadow_texel", empty ? Eigen::Vector4d(0, 0, 0, 1)
                            : Eigen::Vector4d(1.0 / map_.columns(), 1.0 / map_.rows(), map_.texel(), 1 / softness_));
  program.set("shadow_map", texture_unit);
  gl_.ActiveTexture(GL_TEXTURE0 + texture_unit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace drape
