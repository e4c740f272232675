#include "render/shadows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace drape {
namespace {

/// Returns the first texel whose middle is at or after x; texel k has its middle at k + ½.
int first_texel(double x) {
  // std::ceil() is a call where the processor may lack SSE4.1.
  const auto below = static_cast<int>(x - 0.5);
  return below < x - 0.5 ? below + 1 : below;
}

/// An edge from p up to q. Both of its triangles compute bitwise equal crossings.
class RisingEdge {
 public:
  RisingEdge(const double* p, const double* q) : x_(p[0]), y_(p[1]), slope_((q[0] - p[0]) / (q[1] - p[1])) {}

  /// Returns the position where the edge crosses the middle of a row.
  [[nodiscard]] double at(double middle) const { return x_ + (middle - y_) * slope_; }

 private:
  double x_, y_, slope_;
};

bool is_below(const double* p, const double* q) { return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]); }

}  // namespace

void DepthMap::look(const Eigen::Vector3d& towards, const Eigen::Vector3d& up) {
  const Eigen::Vector3d right = up.cross(towards);
  const Eigen::Vector3d across = right.norm() > 1e-6 ? Eigen::Vector3d(right.normalized()) : towards.unitOrthogonal();
  axes_ << across.transpose(), towards.cross(across).transpose(), towards.transpose();
}

void DepthMap::draw(const Vertices& positions, const std::vector<Triangle>& triangles, double texel, int largest) {
  projected_.noalias() = positions * axes_.transpose();
  columns_ = rows_ = 0;
  nearest_.clear();
  farthest_.clear();
  if (!place(texel, largest)) return;
  for (const Triangle& triangle : triangles) fill(triangle);
}

// Numbers too large or too small for the map leave it empty: nothing would be visible in such a picture.
bool DepthMap::place(double texel, int largest) {
  if (projected_.rows() == 0 || !projected_.allFinite() || !std::isnormal(texel) || texel < 0) return false;
  const Eigen::RowVector3d low = projected_.colwise().minCoeff(), high = projected_.colwise().maxCoeff();
  texel_ = texel;
  while ((high - low).head<2>().maxCoeff() > (largest - 3.0 * block) * texel_) texel_ *= 2;

  const double width = block * texel_;
  const auto blocks_before = [width](double x) { return std::floor(x / width) - 1; };
  const double left = blocks_before(low[0]), bottom = blocks_before(low[1]);
  const double columns = block * (blocks_before(high[0]) + 3 - left),
               rows = block * (blocks_before(high[1]) + 3 - bottom);
  projected_.col(0) = (projected_.col(0).array() / texel_ - block * left).matrix();
  projected_.col(1) = (projected_.col(1).array() / texel_ - block * bottom).matrix();
  const auto fits = [&](Eigen::Index axis, double texels) {
    return texels <= largest + block && projected_.col(axis).minCoeff() >= 1 &&
           projected_.col(axis).maxCoeff() <= texels - 1;
  };
  if (!projected_.allFinite() || !fits(0, columns) || !fits(1, rows)) return false;
  columns_ = static_cast<int>(columns);
  rows_ = static_cast<int>(rows);
  projected_.col(2).array() -= low[2];
  u_ << axes_.row(0).transpose() / texel_, -block * left;
  v_ << axes_.row(1).transpose() / texel_, -block * bottom;
  depth_ << axes_.row(2).transpose(), -low[2];

  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  nearest_.assign(count, static_cast<float>(-width));
  farthest_.assign(count, static_cast<float>(high[2] - low[2] + width));
  return true;
}

void DepthMap::fill(const Triangle& triangle) {
  const double* a = projected_.row(triangle[0]).data();
  const double* b = projected_.row(triangle[1]).data();
  const double* c = projected_.row(triangle[2]).data();
  if (is_below(b, a)) std::swap(a, b);
  if (is_below(c, b)) std::swap(b, c);
  if (is_below(b, a)) std::swap(a, b);
  const int bottom = first_texel(a[1]), top = first_texel(c[1]);
  if (bottom == top) return;
  const std::array<double, 3> ab{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double area = ab[0] * ac[1] - ab[1] * ac[0];
  if (area == 0) return;
  const double slope = (ab[2] * ac[1] - ac[2] * ab[1]) / area, rise = (ac[2] * ab[0] - ab[2] * ac[0]) / area;
  const auto lowest = static_cast<float>(std::min({a[2], b[2], c[2]}));
  const auto highest = static_cast<float>(std::max({a[2], b[2], c[2]}));
  const RisingEdge whole(a, c), lower(a, b), upper(b, c);
  for (int row = bottom; row < top; ++row) {
    const double middle = row + 0.5;
    const double one = whole.at(middle), other = middle < b[1] ? lower.at(middle) : upper.at(middle);
    const int from = first_texel(std::min(one, other)), count = first_texel(std::max(one, other)) - from;
    const auto start = static_cast<float>(a[2] + (from + 0.5 - a[0]) * slope + (middle - a[1]) * rise);
    const auto step = static_cast<float>(slope);
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    float* nearest = nearest_.data() + first + from;
    float* farthest = farthest_.data() + first + from;
    for (int k = 0; k < count; ++k) {
      const float depth = std::min(std::max(start + static_cast<float>(k) * step, lowest), highest);
      nearest[k] = std::max(nearest[k], depth);
      farthest[k] = std::min(farthest[k], depth);
    }
  }
}

float interpolated(const DepthMap& map, const std::vector<float>& values, double column, double row) {
  // In this order min and max turn NaN into 0.
  const double x = std::min(std::max(0.0, column - 0.5), map.columns() - 1.001);
  const double y = std::min(std::max(0.0, row - 0.5), map.rows() - 1.001);
  const int left = static_cast<int>(x), bottom = static_cast<int>(y);
  const auto across = static_cast<float>(x - left), up = static_cast<float>(y - bottom);
  const float* lower =
      values.data() + static_cast<std::size_t>(bottom) * static_cast<std::size_t>(map.columns()) + left;
  const float* upper = lower + map.columns();
  const float below = lower[0] + across * (lower[1] - lower[0]), above = upper[0] + across * (upper[1] - upper[0]);
  return below + up * (above - below);
}

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
}

void ClothShadow::upload() {
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
  const double slope = -normal[0] / normal[2], rise = -normal[1] / normal[2],
               steep = std::sqrt(slope * slope + rise * rise);
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

namespace {

constexpr int merged_texels = 2;                  // texels of the map along each side of a pixel
constexpr int sharp_radius = 1, soft_radius = 6;  // radii of the box blurs [pixels]
constexpr int soft_border = 3 * soft_radius + 1;  // width of the softest edge on each side [pixels]
constexpr double lowest_light = 0.02;             // least cosine between light and normal

}  // namespace

void GroundShadow::cast(const DepthMap& map, const GroundShape& ground, const Eigen::Vector3d& to_light,
                        double softening) {
  light_ = to_light;
  if (map.columns() == 0 || !reaches(ground, to_light)) return clear();
  project(map, ground, softening);
  blur(sharp_, sharp_radius);
  blur(soft_, soft_radius);
  pixels_.resize(sharp_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i] = static_cast<std::uint16_t>(std::lround(65535 * std::clamp(sharp_[i] + soft_[i], 0.0F, 1.0F)));
  }
}

bool GroundShadow::reaches(const GroundShape& ground, const Eigen::Vector3d& to_light) {
  return ground.normal.dot(to_light) >= lowest_light;
}

std::vector<Eigen::Vector3d> GroundShadow::corners(const GroundShape& ground) const {
  std::vector<Eigen::Vector3d> points;
  if (u_.isZero(0)) return points;
  const Eigen::Vector3d across = u_.head<3>() / u_.head<3>().squaredNorm(),
                        along = v_.head<3>() / v_.head<3>().squaredNorm();
  for (const double u : {0.0, 1.0}) {
    for (const double v : {0.0, 1.0}) {
      const Eigen::Vector3d p = (u - u_[3]) * across + (v - v_[3]) * along;
      points.emplace_back(p + (ground.height - ground.normal.dot(p)) / ground.normal.dot(light_) * light_);
    }
  }
  return points;
}

void GroundShadow::clear() {
  columns_ = rows_ = 1;
  pixels_.assign(1, 0);
  u_.setZero();
  v_.setZero();
}

// The ground's depth in the map is a·column + b·row + c. The ray through a point p of the map, p + t·light, meets the
// ground where n·p + t n·light equals the ground's height.
void GroundShadow::project(const DepthMap& map, const GroundShape& ground, double softening) {
  const double texel = map.texel();
  const Eigen::Vector3d right = texel * map.u().head<3>(), up = texel * map.v().head<3>(),
                        light = map.depth().head<3>();
  const double rise = ground.normal.dot(light);
  const double a = -ground.normal.dot(right) * texel / rise, b = -ground.normal.dot(up) * texel / rise;
  const double c = ground.height / rise + map.depth()[3] - a * map.u()[3] - b * map.v()[3];

  const int inner_columns = map.columns() / merged_texels, inner_rows = map.rows() / merged_texels;
  columns_ = inner_columns + 2 * soft_border;
  rows_ = inner_rows + 2 * soft_border;
  sharp_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F);
  soft_ = sharp_;
  for (int row = 0; row < inner_rows * merged_texels; ++row) {
    const auto stride = static_cast<std::size_t>(map.columns());
    const float* nearest = map.nearest().data() + static_cast<std::size_t>(row) * stride;
    const float* farthest = map.farthest().data() + static_cast<std::size_t>(row) * stride;
    const std::size_t place =
        static_cast<std::size_t>(row / merged_texels + soft_border) * static_cast<std::size_t>(columns_);
    for (int column = 0; column < inner_columns * merged_texels; ++column) {
      if (nearest[column] < farthest[column]) continue;  // empty texel
      const double level = a * (column + 0.5) + b * (row + 0.5) + c;
      const double top = (double{nearest[column]} - level) * rise + hidden_below * ground.thickness;
      const auto casting = static_cast<float>(std::clamp(1 + top / texel, 0.0, 1.0));
      const double height = double{farthest[column]} - level;
      const auto relative = static_cast<float>(std::max(height * rise, 0.0) / softening);
      const float sharpness = 1 / (1 + relative + relative * relative);
      const std::size_t pixel = place + static_cast<std::size_t>(column / merged_texels + soft_border);
      constexpr float part = 1.0F / (merged_texels * merged_texels);
      sharp_[pixel] += part * casting * sharpness;
      soft_[pixel] += part * casting * (1 - sharpness);
    }
  }
  u_ = map.u() / merged_texels;
  v_ = map.v() / merged_texels;
  u_[3] += soft_border;
  v_[3] += soft_border;
  u_ /= columns_;
  v_ /= rows_;
}

// Three box filters along each axis approximate a Gaussian. All run along columns, because processors add rows of sums
// fast; the image is transposed in between.
void GroundShadow::blur(std::vector<float>& image, int radius) {
  auto width = static_cast<std::size_t>(columns_), height = static_cast<std::size_t>(rows_);
  for (int axis = 0; axis < 2; ++axis) {
    for (int pass = 0; pass < 3; ++pass) blur_columns(image, width, height, static_cast<std::size_t>(radius));
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        scratch_[column * height + row] = image[row * width + column];
      }
    }
    std::swap(image, scratch_);
    std::swap(width, height);
  }
}

void GroundShadow::blur_columns(std::vector<float>& image, std::size_t width, std::size_t height, std::size_t radius) {
  scratch_.resize(image.size());
  sums_.assign(width, 0.0F);
  const auto add = [&](std::size_t row) {
    for (std::size_t k = 0; k < width; ++k) sums_[k] += image[row * width + k];
  };
  const float scale = 1.0F / static_cast<float>(2 * radius + 1);
  for (std::size_t row = 0; row < radius; ++row) add(row);
  for (std::size_t row = 0; row < height; ++row) {
    if (row + radius < height) add(row + radius);
    if (row > radius) {
      for (std::size_t k = 0; k < width; ++k) sums_[k] -= image[(row - radius - 1) * width + k];
    }
    for (std::size_t k = 0; k < width; ++k) scratch_[row * width + k] = sums_[k] * scale;
  }
  std::swap(image, scratch_);
}

void Occluders::take(const Vertices& cloth, const Frame& frame) {
  cloth_positions_ = &cloth;
  copied_ = std::ranges::any_of(frame.colliders,
                                [](const Collider& collider) { return std::holds_alternative<MeshShape>(collider); });
  if (!copied_) return;
  Eigen::Index count = cloth.rows();
  for (const Collider& collider : frame.colliders) {
    if (const auto* mesh = std::get_if<MeshShape>(&collider)) count += mesh->positions.rows();
  }
  positions_.resize(count, 3);
  positions_.topRows(cloth.rows()) = cloth;
  triangles_ = cloth_;
  Eigen::Index first = cloth.rows();
  for (const Collider& collider : frame.colliders) {
    const auto* mesh = std::get_if<MeshShape>(&collider);
    if (mesh == nullptr) continue;
    positions_.middleRows(first, mesh->positions.rows()) = mesh->positions;
    const int shift = static_cast<int>(first);
    for (const auto& [a, b, c] : *mesh->triangles) triangles_.push_back({shift + a, shift + b, shift + c});
    first += mesh->positions.rows();
  }
}

namespace {

/// Largest side of a map [texels].
constexpr int largest_view = 256;
/// Lengths in texels: offset of the sampled point above its vertex, which keeps the ends of folds; depth differences
/// that count as the point's own neighbourhood; and the further difference at which all light is blocked.
constexpr double lifted = 1;
constexpr float nearby = 0.05F, fading = 0.4F;
/// Least cosine of incidence: a map cannot judge flatter light.
constexpr float flattest = 0.12F;

/// V. I. Lebedev, "Quadratures on a sphere", Zh. vychisl. Mat. mat. Fiz. 16 (1976): weights of the points (1,0,0) and
/// (1,1,1)/√3 and of all their mirror images, of degree 5. They sum to 1.
constexpr float axis_weight = 1.0F / 15, corner_weight = 3.0F / 40;

}  // namespace

AmbientOcclusion::AmbientOcclusion() {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z <= 1; ++z) {
        if (z == 0 && (y < 0 || (y == 0 && x <= 0))) continue;  // opposite end of an existing axis
        const int sides = std::abs(x) + std::abs(y) + z;
        const Eigen::Vector3d direction = Eigen::Vector3d(x, y, z).normalized();
        if (sides == 2) continue;
        Axis& axis = axes_.emplace_back(Axis{direction, sides == 1 ? axis_weight : corner_weight, {}});
        axis.map.look(direction, x == 0 && y == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
      }
    }
  }
}

const std::vector<AmbientOcclusion::Sides>& AmbientOcclusion::compute(const Vertices& positions,
                                                                      const Vertices& normals,
                                                                      const std::vector<Triangle>& triangles,
                                                                      double texel) {
  const auto count = static_cast<std::size_t>(positions.rows());
  reached_.assign(count, Sides{});
  whole_.assign(count, Sides{});
  for (Axis& axis : axes_) {
    axis.map.draw(positions, triangles, texel, largest_view);
    gather(axis, normals);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      reached_[i][side] = whole_[i][side] > 0 ? reached_[i][side] / whole_[i][side] : 1;
    }
  }
  smooth(triangles);
  return reached_;
}

// Gives each vertex the mean over its triangles of their corners' mean. This evens out details smaller than a texel.
void AmbientOcclusion::smooth(const std::vector<Triangle>& triangles) {
  struct Sum {
    Sides light{};
    float count = 0;
  };
  std::vector<Sum> sums(reached_.size());
  for (const Triangle& triangle : triangles) {
    Sides mean{};
    for (const int vertex : triangle) {
      for (std::size_t side = 0; side < 2; ++side) mean[side] += reached_[static_cast<std::size_t>(vertex)][side];
    }
    for (const int vertex : triangle) {
      Sum& sum = sums[static_cast<std::size_t>(vertex)];
      for (std::size_t side = 0; side < 2; ++side) sum.light[side] += mean[side] / 3;
      sum.count += 1;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count == 0) continue;
    for (std::size_t side = 0; side < 2; ++side) reached_[i][side] = sums[i].light[side] / sums[i].count;
  }
}

void AmbientOcclusion::gather(const Axis& axis, const Vertices& normals) {
  const DepthMap& map = axis.map;
  if (map.columns() == 0) return;
  const double lift = lifted * map.texel();
  const auto open = [scale = 1 / (fading * static_cast<float>(map.texel()))](float hidden) {
    return 1 - std::clamp(hidden * scale - nearby / fading, 0.0F, 1.0F);
  };
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const Eigen::Vector3d normal = normals.row(i).transpose();
    const double facing = normal.dot(axis.direction);
    const auto cosine = static_cast<float>(std::abs(facing));
    if (cosine < flattest) continue;
    // The side that faces the direction is lifted to there, the other to the other end.
    const double sign = facing > 0 ? lift : -lift;
    const double right = sign * map.u().head<3>().dot(normal), up = sign * map.v().head<3>().dot(normal);
    const double column = map.places()(i, 0), row = map.places()(i, 1), depth = map.places()(i, 2);
    const double above = sign * facing;
    const float before = interpolated(map, map.nearest(), column + right, row + up) - static_cast<float>(depth + above);
    const float behind =
        static_cast<float>(depth - above) - interpolated(map, map.farthest(), column - right, row - up);
    const std::size_t vertex = static_cast<std::size_t>(i), towards = facing > 0 ? 0 : 1;
    const float light = axis.weight * cosine;
    whole_[vertex][towards] += light;
    reached_[vertex][towards] += light * open(before);
    whole_[vertex][1 - towards] += light;
    reached_[vertex][1 - towards] += light * open(behind);
  }
}

}  // namespace drape
