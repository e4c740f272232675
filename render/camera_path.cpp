#include "render/camera_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/unit_vector.hpp"

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

}  // namespace

CameraPath camera_path(const Camera& given, const KnownFilm& film) {
  if (!needs_motion(given)) return turning(fixed_view(given), given, film.count);
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

}  // namespace drape
