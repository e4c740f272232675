#include "render/camera_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "drape/core/rotation.hpp"
#include "render/shot.hpp"
#include "render/smooth_surface.hpp"

namespace drape {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Returns the rotation by `orbit` until a frame.
Eigen::Matrix3d turn(const Camera& camera, const Eigen::Vector3d& about, int frame, int count) {
  const double part = static_cast<double>(frame) / count;
  return Eigen::AngleAxisd(camera.orbit * part * std::numbers::pi / 180, unit_vector(about)).toRotationMatrix();
}

/// Returns a path whose camera circles its target, or stays if `orbit` is 0.
CameraPath turning(const View& view, const Camera& camera, int count) {
  if (camera.orbit == 0) return view;
  std::vector<View> views(static_cast<std::size_t>(count), view);
  for (int k = 0; k < count; ++k) {
    View& turned = views[static_cast<std::size_t>(k)];
    const Eigen::Matrix3d rotation = turn(camera, camera.up, k, count);
    turned.position = view.target + rotation * (view.position - view.target);
    turned.up = rotation * view.up;
  }
  return CameraPath(std::move(views));
}

/// Calls visit(point, radius) for everything that must be in view in a frame.
template <class Visit>
void for_each_ball(const Frame& frame, const Visit& visit) {
  for (Eigen::Index i = 0; i < frame.positions.rows(); ++i) visit(Eigen::Vector3d(frame.positions.row(i)), 0.0);
  for (const Collider& collider : frame.colliders) {
    for_each_ball(collider, visit);
  }
}

/// Returns the centre of a frame's bounding box, along the given axes (rows).
Eigen::Vector3d middle(const Frame& frame, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(endless), high = -low;
  for_each_ball(frame, [&](const Eigen::Vector3d& center, double radius) {
    const Eigen::Vector3d p = axes * center;
    low = low.cwiseMin((p.array() - radius).matrix());
    high = high.cwiseMax((p.array() + radius).matrix());
  });
  return axes.transpose() * (low + high) / 2;
}

/// Returns the least distance from the target at which a camera in the axes' direction sees the whole frame.
double distance(const Frame& frame, const Eigen::Vector3d& target, const Eigen::Matrix3d& axes, const Camera& camera,
                double aspect) {
  const double free = (1 - 2 * camera.margin) * std::tan(camera.field_of_view * std::numbers::pi / 360);
  const Eigen::Array2d slopes(free * aspect, free);  // of the left and right planes, and of the top and bottom planes
  const Eigen::Array2d aside = (1 + slopes.square()).sqrt() / slopes;
  double least = 1e-3;  // keeps the camera away from a motion that is a single point
  for_each_ball(frame, [&](const Eigen::Vector3d& center, double radius) {
    const Eigen::Vector3d p = axes * (center - target);
    const Eigen::Array2d across = p.head<2>().array().abs() / slopes + aside * radius;
    least = std::max(least, p.z() + across.maxCoeff());
  });
  return least;
}

/// Returns entry k of a list whose first and last entries continue beyond its ends.
template <class T>
const T& entry(const std::vector<T>& list, int k) {
  return list[static_cast<std::size_t>(std::clamp(k, 0, static_cast<int>(list.size()) - 1))];
}

/// Returns for each frame the largest value within `reach` frames.
std::vector<double> largest_around(const std::vector<double>& values, int reach) {
  std::vector<double> largest = values;
  for (int k = 0; k < static_cast<int>(values.size()); ++k) {
    for (int i = -reach; i <= reach; ++i) {
      double& here = largest[static_cast<std::size_t>(k)];
      here = std::max(here, entry(values, k + i));
    }
  }
  return largest;
}

/// Returns for each frame the average within `reach` frames, with linearly falling weights. Constants keep their bits.
template <class T>
std::vector<T> smooth(const std::vector<T>& values, int reach) {
  std::vector<T> smoothed = values;
  const double all = static_cast<double>(reach + 1) * (reach + 1);
  for (int k = 0; k < static_cast<int>(values.size()); ++k) {
    for (int i = -reach; i <= reach; ++i) {
      smoothed[static_cast<std::size_t>(k)] +=
          (reach + 1 - std::abs(i)) / all * (entry(values, k + i) - entry(values, k));
    }
  }
  return smoothed;
}

/// Returns the path of a camera without a position that orbits or follows.
CameraPath moving(const Camera& camera, const KnownFilm& film) {
  const View begin = distant_view(camera);
  std::vector<View> views(static_cast<std::size_t>(film.count), begin);
  std::vector<Eigen::Matrix3d> axes;
  for (int k = 0; k < film.count; ++k) {
    View& view = views[static_cast<std::size_t>(k)];
    const Eigen::Matrix3d rotation = turn(camera, camera.up, k, film.count);
    view.position = rotation * begin.position;
    view.up = rotation * begin.up;
    axes.push_back(view.axes());
  }

  std::vector<Eigen::Vector3d> targets;
  Framing whole(camera, film.aspect);
  film.pass([&](const Frame& frame) {
    targets.push_back(middle(frame, axes[targets.size()]));
    whole.add(frame.positions);
    for (const Collider& collider : frame.colliders) whole.add(collider);
  });
  const int reach = std::max(1, static_cast<int>(std::lround(film.fps)));
  if (camera.follow) {
    targets = smooth(targets, reach);
  } else {
    std::fill(targets.begin(), targets.end(), camera.target.value_or(whole.middle()));
  }

  std::vector<double> distances;
  film.pass([&](const Frame& frame) {
    const std::size_t k = distances.size();
    distances.push_back(distance(frame, targets[k], axes[k], camera, film.aspect));
  });
  if (camera.follow) {
    distances = smooth(largest_around(distances, reach), reach);
  } else {
    std::fill(distances.begin(), distances.end(), *std::max_element(distances.begin(), distances.end()));
  }
  for (std::size_t k = 0; k < views.size(); ++k) {
    views[k].target = targets[k];
    views[k].position = targets[k] + distances[k] * axes[k].row(2).transpose();
  }
  return CameraPath(std::move(views));
}

/// Returns the film with vertices of no triangle, which are not drawn, at the place of one that is.
KnownFilm without_unused(KnownFilm film) {
  std::vector<char> used;
  for (const Triangle& triangle : film.triangles) {
    for (const int v : triangle) {
      if (static_cast<std::size_t>(v) >= used.size()) used.resize(static_cast<std::size_t>(v) + 1, 0);
      used[static_cast<std::size_t>(v)] = 1;
    }
  }
  if (used.empty()) return film;
  film.pass = [used, pass = film.pass](const std::function<void(const Frame&)>& take) {
    const auto first = static_cast<Eigen::Index>(std::ranges::find(used, 1) - used.begin());
    pass([&](const Frame& frame) {
      const auto count = static_cast<std::size_t>(frame.positions.rows());
      if (count == used.size() && std::ranges::find(used, 0) == used.end()) return take(frame);
      Frame drawn = frame;
      for (std::size_t v = 0; v < count; ++v) {
        if (v >= used.size() || used[v] == 0) {
          drawn.positions.row(static_cast<Eigen::Index>(v)) = frame.positions.row(first);
        }
      }
      take(drawn);
    });
  };
  return film;
}

}  // namespace

CameraPath camera_path(const Camera& given, const KnownFilm& known) {
  if (!needs_motion(given)) return turning(fixed_view(given, known.start), given, known.count);
  const KnownFilm film = without_unused(known);
  const Camera camera = well_placed(given, film);
  if (!camera.position && (camera.follow || camera.orbit != 0)) return moving(camera, film);
  Framing framing(camera, film.aspect);
  film.pass([&](const Frame& frame) {
    framing.add(frame.positions);
    for (const Collider& collider : frame.colliders) framing.add(collider);
    framing.end_frame();
  });
  return turning(framing.view(), camera, film.count);
}

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr int rows = 56;                       // height of the small pictures [pixels]
constexpr int most_samples = 12;               // most frames examined
constexpr std::size_t most_triangles = 60000;  // of all examined frames together: a large mesh gets fewer frames
// From the default azimuth. None looks along an axis, because cloths and their supports are mostly aligned with axes.
constexpr std::array<int, 8> turns{0, 30, 90, 120, 180, 210, 270, 300};  // [degrees]
constexpr std::array<double, 2> elevations{20, 30};                      // [degrees]
constexpr double least_above_ground = 0.1;                               // sine of the angle

// Weights of the score.
constexpr double back_side = 0.85;  // back of the cloth, relative to its front
constexpr double unlit = 0.45;      // unlit cloth, relative to cloth in perpendicular key light
constexpr double bodies = 0.6;      // fully visible spheres, relative to a cloth that fills the picture
constexpr double movement = 0.1;    // per half picture height between two frames
constexpr double unusual = 0.05;    // deducted if the camera stands opposite its usual side

/// Object at a pixel of a small picture.
enum class Seen : std::uint8_t { nothing, front, back, body };

/// Draws frames from far away in one direction, in small pictures that hold all of them.
class Onlooker {
 public:
  /// @param light unit vector towards the key light, in these axes
  Onlooker(const std::vector<Frame>& frames, const KnownFilm& film, const Eigen::Matrix3d& axes,
           const Eigen::Vector3d& light)
      : triangles_(film.triangles),
        light_(light),
        translucency_(film.look.translucency),
        columns_(std::max(1, static_cast<int>(std::lround(rows * film.aspect)))) {
    Eigen::Array3d low = Eigen::Array3d::Constant(unlimited), high = -low;
    for (const Frame& frame : frames) {
      Scene& scene = scenes_.emplace_back();
      scene.cloth = (axes * frame.positions.transpose()).array();
      low = low.min(scene.cloth.rowwise().minCoeff());
      high = high.max(scene.cloth.rowwise().maxCoeff());
      for (const Collider& collider : frame.colliders) {
        if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
          const Eigen::Array3Xd& x = scene.bodies.emplace_back((axes * mesh->positions.transpose()).array());
          scene.body_triangles.push_back(mesh->triangles.get());
          low = low.min(x.rowwise().minCoeff());
          high = high.max(x.rowwise().maxCoeff());
        }
        const auto* sphere = std::get_if<SphereShape>(&collider);
        if (sphere == nullptr) continue;
        const Ball& ball = scene.balls.emplace_back(Ball{axes * sphere->center, sphere->radius});
        low = low.min(ball.center - ball.radius);
        high = high.max(ball.center + ball.radius);
      }
    }
    // Converts to pixels: columns and rows from the lower left, and depth towards the viewer in the same unit.
    const Eigen::Array2d extent = (high - low).head<2>().max(1e-9);
    const double scale = std::min(columns_ / extent[0], rows / extent[1]);
    Eigen::Array3d shift = -low * scale;
    shift.head<2>() += (Eigen::Array2d(columns_, rows) - extent * scale) / 2;
    for (Scene& scene : scenes_) {
      scene.cloth = (scene.cloth * scale).colwise() + shift;
      for (Eigen::Array3Xd& body : scene.bodies) body = (body * scale).colwise() + shift;
      for (Ball& ball : scene.balls) ball = {ball.center * scale + shift, ball.radius * scale};
    }
  }

  /// Returns the score of the direction, see well_placed().
  double score() {
    double cloth = 0, seen = 0, moved = 0;
    int ball_count = 0;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      const Scene& scene = scenes_[i];
      draw(scene);
      // The root penalises a cloth that nearly vanishes for a while more than one that is always smaller.
      cloth += std::sqrt(shown_cloth() / static_cast<double>(seen_.size()));
      for (const Ball& ball : scene.balls) {
        seen += std::min(1.0, visible(ball));
        ++ball_count;
      }
      if (i > 0) moved += (scene.cloth - scenes_[i - 1].cloth).topRows<2>().matrix().colwise().norm().mean();
    }
    const auto n = static_cast<double>(scenes_.size());
    return cloth / n + bodies * seen / std::max(1, ball_count) + movement * moved / std::max(1.0, n - 1) / (rows / 2.0);
  }

 private:
  struct Ball {
    Eigen::Array3d center;
    double radius;
  };
  struct Scene {
    Eigen::Array3Xd cloth;  // vertices
    std::vector<Ball> balls;
    std::vector<Eigen::Array3Xd> bodies;  // vertices of each body
    std::vector<const std::vector<Triangle>*> body_triangles;
  };

  [[nodiscard]] std::size_t pixel_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  /// Calls visit(pixel, column, row) for the pixels whose middles lie within a box.
  template <class Visit>
  void for_each_pixel(const Eigen::Array2d& low, const Eigen::Array2d& high, const Visit& visit) const {
    const auto first = [](double from) { return std::max(0, static_cast<int>(std::ceil(from - 0.5))); };
    const auto last = [](double to, int size) { return std::min(size - 1, static_cast<int>(std::floor(to - 0.5))); };
    for (int y = first(low[1]); y <= last(high[1], rows); ++y) {
      for (int x = first(low[0]); x <= last(high[0], columns_); ++x) {
        visit(pixel_at(x, y), x + 0.5, y + 0.5);
      }
    }
  }

  template <class Visit>
  void for_each_pixel(const Ball& ball, const Visit& visit) const {
    for_each_pixel((ball.center - ball.radius).head<2>(), (ball.center + ball.radius).head<2>(),
                   [&](std::size_t pixel, double x, double y) {
                     const double dx = x - ball.center[0], dy = y - ball.center[1];
                     const double left = ball.radius * ball.radius - dx * dx - dy * dy;
                     if (left >= 0) visit(pixel, ball.center[2] + std::sqrt(left));
                   });
  }

  void put(std::size_t pixel, double depth, Seen what, double worth = 0) {
    if (depth <= depth_[pixel]) return;
    depth_[pixel] = depth;
    seen_[pixel] = what;
    worth_[pixel] = worth;
  }

  /// Returns the pixels of the cloth, weighted by light and side.
  [[nodiscard]] double shown_cloth() const {
    double sum = 0;
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      if (seen_[k] == Seen::front) sum += worth_[k];
      if (seen_[k] == Seen::back) sum += back_side * worth_[k];
    }
    return sum;
  }

  /// Returns the weight of a triangle: the key light on its visible side.
  [[nodiscard]] double worth(const Eigen::Array3d& a, const Eigen::Array3d& b, const Eigen::Array3d& c) const {
    const Eigen::Vector3d normal = (b - a).matrix().cross((c - a).matrix()).stableNormalized();
    const double cosine = (normal.z() < 0 ? -normal : normal).dot(light_);
    return unlit + (1 - unlit) * (cosine > 0 ? cosine : -translucency_ * cosine);
  }

  void draw(const Scene& scene) {
    const auto size = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows);
    depth_.assign(size, -unlimited);
    seen_.assign(size, Seen::nothing);
    worth_.assign(size, 0);
    for (const Ball& ball : scene.balls) {
      for_each_pixel(ball, [&](std::size_t pixel, double depth) { put(pixel, depth, Seen::body); });
    }
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
      const Eigen::Array3Xd& x = scene.bodies[k];
      for (const Triangle& t : *scene.body_triangles[k]) {
        draw(x.col(t[0]), x.col(t[1]), x.col(t[2]), Seen::body, Seen::body);
      }
    }
    for (const Triangle& t : triangles_) {
      draw(scene.cloth.col(t[0]), scene.cloth.col(t[1]), scene.cloth.col(t[2]), Seen::front, Seen::back);
    }
  }

  void draw(const Eigen::Array3d& a, const Eigen::Array3d& b, const Eigen::Array3d& c, Seen front, Seen back) {
    const auto cross = [](double ux, double uy, double vx, double vy) { return ux * vy - uy * vx; };
    const double twice_area = cross(b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
    if (twice_area == 0) return;
    const Eigen::Array3d low = a.min(b).min(c), high = a.max(b).max(c);
    const double lit = front == Seen::body ? 0 : worth(a, b, c);
    for_each_pixel(low.head<2>(), high.head<2>(), [&](std::size_t pixel, double x, double y) {
      const double u = cross(b[0] - x, b[1] - y, c[0] - x, c[1] - y) / twice_area;
      const double v = cross(c[0] - x, c[1] - y, a[0] - x, a[1] - y) / twice_area;
      if (u < 0 || v < 0 || u + v > 1) return;
      put(pixel, u * a[2] + v * b[2] + (1 - u - v) * c[2], twice_area > 0 ? front : back, lit);
    });
  }

  /// Returns the visible fraction of a ball.
  [[nodiscard]] double visible(const Ball& ball) const {
    int all = 0, there = 0;
    for_each_pixel(ball, [&](std::size_t pixel, double) {
      ++all;
      there += seen_[pixel] == Seen::body ? 1 : 0;
    });
    return static_cast<double>(there) / std::max(1, all);
  }

  const std::vector<Triangle>& triangles_;
  Eigen::Vector3d light_;
  double translucency_;
  int columns_;
  std::vector<Scene> scenes_;
  std::vector<double> depth_, worth_;
  std::vector<Seen> seen_;
};

/// Returns true if a camera in that direction sees every ground from above.
bool above_grounds(const std::vector<Frame>& frames, const Eigen::Vector3d& back_direction) {
  for (const Collider& collider : frames.front().colliders) {
    const auto* ground = std::get_if<GroundShape>(&collider);
    if (ground != nullptr && ground->normal.dot(back_direction) < least_above_ground) return false;
  }
  return true;
}

/// Returns the camera in a direction. If both angles are free they are measured about its `up`; if one is given, about
/// z, as in the scene's keys.
Camera placed(const Camera& camera, double azimuth, double elevation) {
  Camera there = camera;
  there.azimuth = camera.azimuth.value_or(azimuth);
  there.elevation = camera.elevation.value_or(elevation);
  if (camera.azimuth || camera.elevation) return there;
  there.up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d direction = rotation_from_z(camera.up) * distant_view(there).position;
  there.up = camera.up;
  if (camera.up.normalized() == Eigen::Vector3d::UnitZ()) return there;
  there.azimuth = std::atan2(direction.y(), direction.x()) * 180 / std::numbers::pi;
  there.elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0)) * 180 / std::numbers::pi;
  return there;
}

}  // namespace

SampledFrames::SampledFrames(int count, std::size_t triangles) : count_(std::max(1, count)) {
  const auto affordable = static_cast<int>(most_triangles / std::max<std::size_t>(1, triangles));
  most_ = std::min(count_, std::clamp(affordable, 2, most_samples));
}

void SampledFrames::add(const Frame& frame) {
  const auto next = static_cast<std::int64_t>(frames_.size()) * (count_ - 1) / std::max(1, most_ - 1);
  if (index_++ == next && static_cast<int>(frames_.size()) < most_) frames_.push_back(frame);
}

Camera well_placed(const Camera& camera, const KnownFilm& film) {
  if (camera.position || (camera.azimuth && camera.elevation)) return camera;
  SampledFrames samples(film.count, film.triangles.size());
  film.pass([&](const Frame& frame) { samples.add(frame); });
  const std::vector<Frame>& frames = samples.frames();
  Camera best = placed(camera, Camera::usual_azimuth, Camera::usual_elevation);
  double most = -unlimited;
  for (const double elevation : elevations) {
    if (camera.elevation && elevation != elevations.front()) break;
    for (const int turn : turns) {
      if (camera.azimuth && turn > 0) break;
      const Camera there = placed(camera, Camera::usual_azimuth + turn, elevation);
      const View view = distant_view(there);
      const Eigen::Matrix3d axes = view.axes();
      if (!above_grounds(frames, axes.row(2))) continue;
      const double off = std::min(turn, 360 - turn) / 180.0;
      const double score = Onlooker(frames, film, axes, axes * key_light(view, film.look)).score() - unusual * off;
      if (score <= most) continue;
      most = score;
      best = there;
    }
  }
  return best;
}

}  // namespace drape
