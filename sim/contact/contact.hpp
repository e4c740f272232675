#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <compare>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Identifies a contact within a step: what made it, and the features that meet. Contacts are sorted by it.
struct ContactKey {
  int source = 0;  ///< number of the ContactSource
  int kind = 0;    ///< of features, as the source numbers them
  std::array<int, 4> features = {-1, -1, -1, -1};

  auto operator<=>(const ContactKey&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// Two features that may not come nearer than a distance, one of them or both of the cloth. With the relative place
///   d(x) = Σ weights[i]·x[vertices[i]] + offset
/// the contact is the constraint n·d(x) ≥ distance, linear in x, and its force acts on the cloth as weights[i]·force.
struct ContactConstraint {
  ContactKey key;
  int count = 1;                       ///< vertices of the cloth that take part, 1 to 4
  std::array<int, 4> vertices = {};    ///< of the cloth
  std::array<double, 4> weights = {};  ///< theirs
  Eigen::Vector3d normal;              ///< unit vector from the second feature to the first
  Eigen::Vector3d offset;              ///< the obstacle's part of d at the end of the step [m]
  Eigen::Vector3d carried;             ///< how far the obstacle moves that part in the step [m]
  Eigen::Vector3d start;               ///< d at the start of the step, with the same weights [m]
  double distance = 0;                 ///< the least n·d at the end of the step [m]
  double friction = 0;                 ///< Coulomb's coefficient µ
  double restitution = 0;              ///< fraction of the speed of an impact with which the features part
  double beyond = 0;                   ///< how much further apart the features end that bounce [m]
  bool collides = false;               ///< whether the features pass through each other on the straight way
  double radius = -1;                  ///< largest friction force, µ times a normal one; negative: not known yet [N]
  double stiffness = 0;                ///< κ of the augmented Lagrangian [N/m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< multiplier: the force on d [N]

  /// Σ weights·x of the cloth's vertices [m].
  [[nodiscard]] Eigen::Vector3d gather(const Vertices& x) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      sum += weights[i] * x.row(vertices[i]).transpose();
    return sum;
  }
  /// The same of those that can move.
  [[nodiscard]] Eigen::Vector3d gather_free(const Vertices& x, const std::vector<char>& free) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (free[static_cast<std::size_t>(vertices[i])] != 0) sum += weights[i] * x.row(vertices[i]).transpose();
    }
    return sum;
  }
  /// Returns true if enough of its weights is on vertices that can move: others would have to be pushed far.
  [[nodiscard]] bool can_move(const std::vector<char>& free) const {
    constexpr double least_free = 0.25;
    double moved = 0, all = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      all += std::abs(weights[i]);
      if (free[static_cast<std::size_t>(vertices[i])] != 0) moved += std::abs(weights[i]);
    }
    return moved > 0 && moved >= least_free * all;
  }
  /// Returns true if one of the features is an obstacle's.
  [[nodiscard]] bool with_obstacle() const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += weights[i];
    return std::abs(sum) > 0.5;
  }
  /// d(x) [m].
  [[nodiscard]] Eigen::Vector3d place(const Vertices& x) const { return gather(x) + offset; }
  /// to[vertices] += weights·value.
  void scatter(const Eigen::Vector3d& value, Vertices& to) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      to.row(vertices[i]) += weights[i] * value.transpose();
    }
  }
};

/// Something that the cloth can touch, or the cloth itself: makes the contacts of a step.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// Begins a step from x, n×3 [m], between two times [s].
  virtual void begin(const Vertices& x, double start, double end) = 0;
  /// Appends the contacts of a cloth that goes straight from x to `target`, sorted by key: those whose features end
  /// nearer than their distance or collide on the way, and those of `held` that are still near.
  /// @param source number to give them
  /// @param held   contacts of this source that bear a force, sorted by key
  virtual void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                    std::vector<ContactConstraint>& contacts) = 0;
};

}  // namespace drape
