#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/effects/surface_contact.hpp"
#include "sim/effects/touched_vertices.hpp"
#include "sim/parallel/part_lists.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/system.hpp"

namespace drape {

/// What was at the start of a step.
struct StepStart {
  std::vector<char> outside;  ///< which vertices were outside of a surface
  Vertices v;                 ///< [m/s]

  explicit StepStart(const Cloth& cloth)
      : outside(static_cast<std::size_t>(cloth.vertex_count()), 0), v(Vertices::Zero(cloth.vertex_count(), 3)) {}
  [[nodiscard]] bool was_outside(int vertex) const { return outside[static_cast<std::size_t>(vertex)] != 0; }
};

/// Whether a vertex arrives in this step at a surface from which it bounces: then it is the impact that stops it, and
/// not the push.
inline bool arrives(const std::shared_ptr<const StepStart>& start, Eigen::Index i) {
  return start && start->was_outside(static_cast<int>(i));
}

/// A change of a vertex's velocity that waits until the vertices have moved.
struct VelocityChange {
  int vertex;
  Eigen::RowVector3d change;  ///< [m/s]
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
  const Threads& threads;

  ReboundFilter(Surface s, double e, double mu, const System& system, std::vector<int> vertices)
      : surface(std::move(s)),
        restitution(e),
        friction(mu),
        gravity(system.gravity),
        free(std::move(vertices)),
        start(std::make_shared<StepStart>(system.cloth)),
        threads(system.threads) {
    arriving_.reserve(std::ssize(free));
    turns_.reserve(free.size());
  }

  void begin(const State& state, double time) override {
    const auto now = surface.at(time);
    for_all(threads, std::ssize(free), [&](Eigen::Index k) {
      const int i = free[static_cast<std::size_t>(k)];
      SurfaceContact contact;
      const bool inside = find_contact(now, i, state.x.row(i).transpose(), contact);
      start->outside[static_cast<std::size_t>(i)] = inside ? 0 : 1;
    });
    copy(threads, state.v, start->v);
  }

  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    turns_.clear();
    const auto before = surface.at(time), after = surface.at(time + h);
    const auto drifts = way_of(surface, time, time + h);
    arriving_.fill(threads, std::ssize(free), [&](Eigen::Index k, std::vector<TouchedVertex>& arriving) {
      const int i = free[static_cast<std::size_t>(k)];
      SurfaceContact contact;
      if (!start->was_outside(i)) return;
      if (find_contact(after, i, (x.row(i) + h * v.row(i)).transpose(), contact)) arriving.push_back({i, contact});
    });
    // These are few, and a surface may be asked for other times by one thread alone.
    arriving_.for_each([&](const TouchedVertex& arriving) {
      const auto& [i, contact] = arriving;
      const Eigen::Vector3d from = x.row(i).transpose(), mean = v.row(i).transpose();
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
      if (speed <= 0) return;
      const double back = restitution * speed > pressed ? restitution * speed : 0;
      const Eigen::Vector3d along = arrival + speed * n;
      const double slip = along.norm(), lost = friction * (speed + back);
      const Eigen::Vector3d departure = drift + back * n + (slip > lost ? 1 - lost / slip : 0) * along;

      const double left = h - hit;
      Eigen::Vector3d end = place + left * (departure + 0.5 * left * gravity);
      if (back > 0) clear(after, 1e-6 * h * back, end);
      const Eigen::Vector3d way = (end - from) / h;
      v.row(i) = way.transpose();
      turns_.push_back({static_cast<int>(i), (departure + (left - 0.5 * h) * gravity - way).transpose()});
    });
  }

  void finish(Vertices& v) override {
    for (const VelocityChange& turn : turns_) v.row(turn.vertex) += turn.change;
  }

 private:
  /// What leaves is outside at the end of the step, whatever rounding and curvature say: inside it would count as what
  /// lies there.
  template <class Shape>
  static void clear(const Shape& shape, double margin, Eigen::Vector3d& point) {
    const double missing = margin - shape.gap(point);
    if (missing > 0) point += missing * shape.normal(point);
  }

  PartLists<TouchedVertex> arriving_;
  std::vector<VelocityChange> turns_;
};

}  // namespace drape
