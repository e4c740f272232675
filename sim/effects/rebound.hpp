#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/effects/surface_contact.hpp"
#include "sim/system.hpp"

namespace drape {

/// What was at the start of a step.
struct StepStart {
  std::vector<bool> outside;  ///< which vertices were outside of a surface
  Vertices v;                 ///< [m/s]

  explicit StepStart(const Cloth& cloth)
      : outside(static_cast<std::size_t>(cloth.vertex_count()), false), v(Vertices::Zero(cloth.vertex_count(), 3)) {}
  [[nodiscard]] bool was_outside(int vertex) const { return outside[static_cast<std::size_t>(vertex)]; }
};

/// Changes of single vertices' velocities that wait until the vertices have moved.
class VelocityChanges {
 public:
  /// Takes memory for as many, so that no step has to.
  explicit VelocityChanges(std::size_t most) { changes_.reserve(most); }
  void clear() { changes_.clear(); }
  void add(int vertex, const Eigen::Vector3d& change) { changes_.push_back({vertex, change.transpose()}); }
  void apply(Vertices& v) const {
    for (const Change& c : changes_) v.row(c.vertex) += c.change;
  }

 private:
  struct Change {
    int vertex;
    Eigen::RowVector3d change;  // [m/s]
  };
  std::vector<Change> changes_;
};

/// Newton's law of impact: a vertex that would come into a surface in this step leaves it with the share e of
/// the speed at which it arrives, and friction takes at most µ(1 + e) times that speed from the one along the surface.
///
/// A velocity of the schemes is the mean over the step that leads there, so under gravity alone, g, the vertices
/// are on a parabola to rounding: t seconds into a step of mean velocity w the velocity is w + (t − h/2)·g. The time of
/// the impact is where that parabola meets the surface, and the step ends on the parabola that begins there. A vertex
/// in free flight thus rises to e² of its height, whatever the step. It moves with the mean velocity that leads to
/// where it ends, and gets the one that goes with the new parabola afterwards. Everything else that accelerates it,
/// and the curvature of the surface, make an error of the order of h.
///
/// A vertex that would come back within two steps does not leave: its speed outwards must be more than what it is
/// accelerated inwards in a step. It is stopped instead, and from there on it lies on the surface, which is the push's
/// part.
template <class Surface>
struct ReboundFilter final : MotionFilter {
  Surface surface;
  double restitution, friction;
  Eigen::Vector3d gravity;
  std::vector<int> free;  // the vertices that are not pinned
  std::shared_ptr<StepStart> start;

  ReboundFilter(Surface s, double e, double mu, const System& system, std::vector<int> vertices)
      : surface(std::move(s)),
        restitution(e),
        friction(mu),
        gravity(system.gravity),
        free(std::move(vertices)),
        start(std::make_shared<StepStart>(system.cloth)),
        turns_(free.size()) {}

  void begin(const State& state, double time) override {
    const auto now = surface.at(time);
    SurfaceContact contact;
    for (const int i : free) {
      start->outside[static_cast<std::size_t>(i)] = !find_contact(now, i, state.x.row(i).transpose(), contact);
    }
    start->v = state.v;
  }

  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    turns_.clear();
    const auto before = surface.at(time), after = surface.at(time + h);
    const auto drifts = way_of(surface, time, time + h);
    SurfaceContact contact;
    for (const int i : free) {
      if (!start->was_outside(i)) continue;
      const Eigen::Vector3d from = x.row(i).transpose(), mean = v.row(i).transpose();
      if (!find_contact(after, i, from + h * mean, contact)) continue;
      const Eigen::Vector3d drift = drifts.of(contact) / h;
      // The gap on the way there is c + b·t + fall/2·t².
      const double fall = gravity.dot(contact.normal()), c = std::max(0.0, before.gap(from));
      const double b = (contact.gap - c) / h - 0.5 * fall * h;
      const double steepness = std::sqrt(std::max(0.0, b * b - 2 * fall * c)) - b;
      const double hit = steepness > 0 ? std::min(h, 2 * c / steepness) : h;
      const Eigen::Vector3d place = from + hit * (mean + 0.5 * (hit - h) * gravity);
      const Eigen::Vector3d n = surface.at(time + hit).normal(place);
      const Eigen::Vector3d arrival = mean - drift + (hit - 0.5 * h) * gravity;

      const double speed = -n.dot(arrival), pressed = std::max(0.0, n.dot(start->v.row(i).transpose() - mean));
      if (speed <= 0) continue;
      const double back = restitution * speed > pressed ? restitution * speed : 0;
      const Eigen::Vector3d along = arrival + speed * n;
      const double slip = along.norm(), lost = friction * (speed + back);
      const Eigen::Vector3d departure = drift + back * n + (slip > lost ? 1 - lost / slip : 0) * along;

      const double left = h - hit;
      Eigen::Vector3d end = place + left * (departure + 0.5 * left * gravity);
      if (back > 0) clear(after, 1e-6 * h * back, end);
      const Eigen::Vector3d way = (end - from) / h;
      v.row(i) = way.transpose();
      turns_.add(i, departure + (left - 0.5 * h) * gravity - way);
    }
  }

  void finish(Vertices& v) override { turns_.apply(v); }

 private:
  /// What leaves is outside at the end of the step, whatever rounding and curvature say: inside it would count as what
  /// lies there.
  template <class Shape>
  static void clear(const Shape& shape, double margin, Eigen::Vector3d& point) {
    const double missing = margin - shape.gap(point);
    if (missing > 0) point += missing * shape.normal(point);
  }

  VelocityChanges turns_;
};

}  // namespace drape
