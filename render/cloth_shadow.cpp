#include "render/cloth_shadow.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace drape {
namespace {

/// Texels per row of the picture, and least and most texels across it: edges are a few pixels wide.
constexpr double texels_per_row = 0.75, least_resolution = 300, most_resolution = 600;
/// Largest side of the map [texels], if the camera sees only a part of the cloth.
constexpr int largest_map = 1536;
/// Depths in texels under perpendicular light: least height above a surface at which an object blocks light, and the
/// further height over which the shadow becomes full.
constexpr double lift = 0.8, softness = 1.6;
/// Radius around a point within which the filter reads the map [texels].
constexpr int filtered = 4;
/// Side of the blocks that are tested first [texels].
constexpr int block = 8;
static_assert(DepthMap::block % block == 0);

}  // namespace

ClothShadow::ClothShadow(const GlFunctions& gl, int rows)
    : gl_(gl), resolution_(std::clamp(texels_per_row * rows, least_resolution, most_resolution)), texture_(gl) {
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
  map_.draw(occluders.positions(), occluders.triangles(), shot.extent / resolution_, largest_map);
  find_layers();
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

void ClothShadow::find_layers() {
  const auto columns = static_cast<std::size_t>(map_.columns()), rows = static_cast<std::size_t>(map_.rows());
  const auto tolerated = static_cast<float>(lift * map_.texel());
  layered_.assign(columns / block * (rows / block), 0);
  for (std::size_t row = 0; row < rows; ++row) {
    const float* nearest = map_.nearest().data() + row * columns;
    const float* farthest = map_.farthest().data() + row * columns;
    for (std::size_t k = 0; k < columns / block; ++k, nearest += block, farthest += block) {
      float most = 0;
      for (int i = 0; i < block; ++i) most = std::max(most, nearest[i] - farthest[i]);
      layered_[row / block * (columns / block) + k] |= most > tolerated ? 1 : 0;
    }
  }
}

bool ClothShadow::has_layers(const Texels& texels) const {
  for (int row = texels.bottom / block; row <= texels.top / block; ++row) {
    const auto* first = layered_.data() + static_cast<std::ptrdiff_t>(row) * (map_.columns() / block);
    for (int k = texels.left / block; k <= texels.right / block; ++k) {
      if (first[k] != 0) return true;
    }
  }
  return false;
}

ClothShadow::Light ClothShadow::light_on(const Triangle& triangle) const {
  if (map_.columns() == 0) return Light::past_cloth;
  const Light light = past_cloth(triangle);
  return light == Light::whole && is_behind_a_sphere(triangle) ? Light::past_spheres : light;
}

// Searches the triangle's bounding rectangle plus the filter's radius. It is lit fully unless two layers overlap there
// and one lies above the triangle's plane; it is dark if one lies far above everywhere. A single layer above the plane
// is the curved surface itself.
ClothShadow::Light ClothShadow::past_cloth(const Triangle& triangle) const {
  const auto corner = [&](std::size_t c) { return map_.places().row(triangle[c]).transpose().eval(); };
  const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2);
  const Eigen::Array3d low = a.array().min(b.array()).min(c.array()), high = a.array().max(b.array()).max(c.array());
  const Texels texels{.left = std::max(static_cast<int>(low[0]) - filtered, 0),
                      .right = std::min(static_cast<int>(high[0]) + filtered, map_.columns() - 1),
                      .bottom = std::max(static_cast<int>(low[1]) - filtered, 0),
                      .top = std::min(static_cast<int>(high[1]) + filtered, map_.rows() - 1)};
  if (!has_layers(texels)) return Light::whole;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double slope = -normal[0] / normal[2], rise = -normal[1] / normal[2], steep = std::hypot(slope, rise);
  if (!(steep < 1e3 * map_.texel())) return Light::past_cloth;
  const auto tolerated = static_cast<float>(0.5 * lift * map_.texel()), step = static_cast<float>(slope);
  const auto deep = static_cast<float>(2 * (lift + softness) * (map_.texel() + steep));
  bool any = false, all = true;
  for (int row = texels.bottom; row <= texels.top; ++row) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * map_.columns() + texels.left;
    const float* nearest = map_.nearest().data() + first;
    const float* farthest = map_.farthest().data() + first;
    const auto start = static_cast<float>(a[2] + (texels.left + 0.5 - a[0]) * slope + (row + 0.5 - a[1]) * rise);
    int above = 0, near = 0;
    for (int k = 0; k <= texels.right - texels.left; ++k) {
      const float plane = start + static_cast<float>(k) * step;
      above |= nearest[k] - std::max(plane, farthest[k]) > tolerated ? 1 : 0;
      near |= nearest[k] - plane > deep ? 0 : 1;
    }
    any = any || above != 0;
    all = all && near == 0;
    if (any && !all) return Light::past_cloth;
  }
  return all ? Light::none : any ? Light::past_cloth : Light::whole;
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
  const Eigen::Vector4d middle(0, 0, 0, -0.5);  // moves middles of texels to whole numbers for the shader
  set("shadow_u", empty ? Eigen::Vector4d::Zero().eval() : (map_.u() + middle).eval());
  set("shadow_v", empty ? Eigen::Vector4d::Zero().eval() : (map_.v() + middle).eval());
  set("shadow_depth", empty ? Eigen::Vector4d::Zero().eval() : map_.depth());
  program.set("shadow_lift", static_cast<float>(lift * map_.texel()));
  // Points behind the whole cloth count as half a block behind it, in front of the value of empty texels.
  program.set("shadow_lowest", static_cast<float>(-0.5 * DepthMap::block * map_.texel()));
  set("shadow_texel",
      empty ? Eigen::Vector4d(0, 0, 0, 1)
            : Eigen::Vector4d(1.0 / map_.columns(), 1.0 / map_.rows(), map_.texel(), 1 / (softness * map_.texel())));
  program.set("shadow_map", texture_unit);
  gl_.ActiveTexture(GL_TEXTURE0 + texture_unit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace drape
