#include "render/shot.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/smooth_surface.hpp"

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
      if (ground->normal.dot(view.position) > ground->height) {
        grounds.push_back(*ground);
        cuts.emplace_back() << ground->normal.cast<float>(), static_cast<float>(ground->height);
      }
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
  program.set("grounds", cuts);
}

std::vector<std::string> light_defines(const Look& look, std::size_t sphere_count, bool shadows) {
  std::vector<std::string> defines{fmt::format("SPHERES {}", sphere_count)};
  if (shadows) defines.emplace_back("SHADOWS");
  if (look.ambient_occlusion) defines.emplace_back("OCCLUSION");
  if (look.translucency > 0) defines.emplace_back("TRANSLUCENCY");
  return defines;
}

bool resolves(const Shot& shot, double length, double pixels, int height) {
  // The projection's rows scale a unit vector: the second to half the picture's height at a depth of 1.
  const Eigen::Matrix4d projection = shot.view_projection.cast<double>();
  const double farthest = projection.block<1, 3>(1, 0).norm() * height / 2 * length / pixels;
  const Eigen::RowVector3d back = projection.block<1, 3>(3, 0);
  for (const auto x : shot.frame.positions.rowwise()) {
    const double depth = back.dot(x) + projection(3, 3);
    if (depth > 0 && depth < farthest) return true;
  }
  return false;
}

namespace {

/// Bounding box of points of a shot, in the picture.
class Outline {
 public:
  explicit Outline(const Shot& shot) : to_clip_(shot.view_projection.cast<double>()) {}

  /// @param points n×3 [m]
  void add(const Vertices& points) {
    const Eigen::MatrixX4d clip = (points * to_clip_.leftCols<3>().transpose()).rowwise() + to_clip_.col(3).transpose();
    // A point beside or behind the camera has no position in the picture. NaN fails this comparison as well.
    if (!(clip.col(3).array() > 0).all()) {
      unbounded_ = true;
      return;
    }
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::ArrayXd place = clip.col(axis).array() / clip.col(3).array();
      unbounded_ = unbounded_ || !place.allFinite();
      low_[axis] = std::min(low_[axis], place.minCoeff());
      high_[axis] = std::max(high_[axis], place.maxCoeff());
    }
  }

  /// Returns the pixels within the outline, enlarged by `border` on each side.
  [[nodiscard]] PixelBox box(Eigen::Vector2i picture, int border) const {
    if (unbounded_) return {.size = picture};
    PixelBox box;
    for (int axis = 0; axis < 2; ++axis) {
      const int last = picture[axis];
      const auto pixel = [last](double place) {
        return static_cast<int>(std::clamp(0.5 * (place + 1) * last, -1e6, 1e6));
      };
      box.corner[axis] = std::clamp(pixel(low_[axis]) - border, 0, last);
      box.size[axis] = std::clamp(pixel(high_[axis]) + 1 + border, 0, last) - box.corner[axis];
    }
    return box;
  }

 private:
  Eigen::Matrix4d to_clip_;
  Eigen::Array2d low_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high_ = -low_;
  bool unbounded_ = false;
};

/// Returns the corners of the cube around a sphere.
Vertices cube(const Eigen::Vector4f& sphere) {
  Vertices corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      corners(corner, axis) = double{sphere[axis]} + ((corner >> axis & 1) != 0 ? 1 : -1) * double{sphere[3]};
    }
  }
  return corners;
}

/// Pixels added on each side: OpenGL rounds vertices to single precision and to 1/256 pixel.
constexpr int border = 1;

}  // namespace

PixelBox covered_box(const Shot& shot, const Vertices& cloth, Eigen::Vector2i picture) {
  if (!shot.grounds.empty()) return {.size = picture};
  Outline outline(shot);
  outline.add(cloth);
  for (const Eigen::Vector4f& sphere : shot.spheres) outline.add(cube(sphere));
  for (const MeshShape* body : shot.bodies) outline.add(body->positions);
  return outline.box(picture, border);
}

PixelBox box_around(const Shot& shot, const Vertices& points, Eigen::Vector2i picture) {
  if (points.rows() == 0) return {};
  Outline outline(shot);
  outline.add(points);
  return outline.box(picture, border);
}

}  // namespace drape
