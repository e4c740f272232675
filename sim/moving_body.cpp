#include "sim/moving_body.hpp"

#include <algorithm>
#include <utility>

namespace drape {

MovingBody::MovingBody(std::shared_ptr<const MeshMotion> shape, RigidMotion motion)
    : shape_(std::move(shape)),
      motion_(std::move(motion)),
      topology_(
          std::make_shared<MeshTopology>(shape_->mesh.triangles, static_cast<int>(shape_->mesh.positions.rows()))) {}

std::shared_ptr<const PlacedMesh> MovingBody::mesh_at(double time) const {
  const auto known = std::ranges::find_if(shapes_, [&](const Shape& s) { return !deforms() || s.time == time; });
  if (known != shapes_.end()) {
    std::rotate(known, known + 1, shapes_.end());
    return shapes_.back().mesh;
  }
  shape_->place(time, scratch_);
  // A step looks at its start and its end: those of two times stay, and others that nobody holds are used again.
  const auto last = shapes_.end() - std::min<std::ptrdiff_t>(2, std::ssize(shapes_));
  const auto idle = std::find_if(shapes_.begin(), last, [](const Shape& s) { return s.mesh.use_count() == 1; });
  if (idle == last) {
    shapes_.push_back({time, std::make_shared<PlacedMesh>(topology_, scratch_)});
  } else {
    idle->time = time;
    idle->mesh->place(scratch_);
    std::rotate(idle, idle + 1, shapes_.end());
  }
  return shapes_.back().mesh;
}

Point MovingBody::point_at(int triangle, const Point& weights, double time) const {
  const BodyAt now = at(time);
  const Triangle& t = topology_->triangles[static_cast<std::size_t>(triangle)];
  Point sum = Point::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    sum += weights[static_cast<Eigen::Index>(c)] * now.mesh->points()[static_cast<std::size_t>(t[c])];
  }
  return now.pose.out(sum);
}

Eigen::Vector3d MovingBody::displacement(int triangle, const Point& weights, double from, double to) const {
  return point_at(triangle, weights, to) - point_at(triangle, weights, from);
}

Eigen::Vector3d MovingBody::displacement(double from, double to) const {
  return motion_.at(to).place - motion_.at(from).place;
}

Vertices MovingBody::positions(double time) const {
  Vertices x;
  shape_->place(time, x);
  const Pose pose = motion_.at(time);
  return (x * pose.turn.transpose()).rowwise() + pose.place.transpose();
}

}  // namespace drape
