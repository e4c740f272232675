#include "sim/moving_body.hpp"

#include <algorithm>
#include <cmath>
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
  if (last_.rows() == scratch_.rows()) travel_ += std::sqrt((scratch_ - last_).rowwise().squaredNorm().maxCoeff());
  last_.swap(scratch_);
  // Keep the shapes of two times, as a step uses its start and end; reuse others that are not referenced.
  const auto last = shapes_.end() - std::min<std::ptrdiff_t>(2, std::ssize(shapes_));
  const auto idle = std::find_if(shapes_.begin(), last, [](const Shape& s) { return s.mesh.use_count() == 1; });
  if (idle == last) {
    shapes_.push_back({time, std::make_shared<PlacedMesh>(topology_, last_, travel_)});
  } else {
    idle->time = time;
    idle->mesh->place(last_, travel_);
    std::rotate(idle, idle + 1, shapes_.end());
  }
  return shapes_.back().mesh;
}

MovingBody::Way::Way(const MovingBody& body, double from, double to)
    : topology_(body.topology()),
      from_(body.at(from)),
      to_(body.at(to)),
      still_(from_.mesh == to_.mesh && from_.pose.turn == to_.pose.turn && from_.pose.place == to_.pose.place) {}

Eigen::Vector3d MovingBody::Way::of(int triangle, const Point& weights) const {
  if (still_) return Eigen::Vector3d::Zero();
  const Triangle& corners = topology_.triangles[static_cast<std::size_t>(triangle)];
  const auto point_in = [&](const BodyAt& body) {
    Point sum = Point::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      sum += weights[static_cast<Eigen::Index>(c)] * body.mesh->points()[static_cast<std::size_t>(corners[c])];
    }
    return body.pose.out(sum);
  };
  return point_in(to_) - point_in(from_);
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
