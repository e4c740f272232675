#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <compare>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Identifier of a contact within a step: its source and the features that meet. It defines the order of contacts.
struct ContactKey {
  int source = 0;  ///< number of the ContactSource
  int kind = 0;    ///< kind of features, numbered by the source
  std::array<int, 4> features = {-1, -1, -1, -1};

  auto operator<=>(const ContactKey&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// Two features that must stay a distance apart; one or both belong to the cloth. With the relative position
///   d(x) = Σ weights[i]·x[vertices[i]] + offset
/// the contact is the constraint n·d(x) ≥ distance, linear in x. Its force acts on the cloth as weights[i]·force.
struct ContactConstraint {
  ContactKey key;
  int count = 1;                       ///< number of cloth vertices, 1 to 4
  std::array<int, 4> vertices = {};    ///< cloth vertices
  std::array<double, 4> weights = {};  ///< weights of these vertices
  Eigen::Vector3d normal;              ///< unit vector from the second feature to the first
  Eigen::Vector3d offset;              ///< the obstacle's share of d at the end of the step [m]
  Eigen::Vector3d carried;             ///< change of the obstacle's share of d in the step [m]
  Eigen::Vector3d start;               ///< d at the start of the step, with the same weights [m]
  double distance = 0;                 ///< minimum n·d at the end of the step [m]
  double friction = 0;                 ///< Coulomb's coefficient µ
  double restitution = 0;              ///< ratio of separation to impact speed
  double beyond = 0;                   ///< additional gap at the end of the step due to a bounce [m]
  bool collides = false;               ///< true if the features pass through each other on straight paths
  double radius = -1;                  ///< limit of the friction force, µ times a normal force [N]; negative: unknown
  double stiffness = 0;                ///< penalty κ of the augmented Lagrangian [N/m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< multiplier: the force on d [N]

  /// Returns Σ weights·x over the cloth's vertices [m].
  [[nodiscard]] Eigen::Vector3d gather(const Vertices& x) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      sum += weights[i] * x.row(vertices[i]).transpose();
    return sum;
  }
  /// Returns the same sum over free vertices only [m].
  [[nodiscard]] Eigen::Vector3d gather_free(const Vertices& x, const std::vector<char>& free) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (free[static_cast<std::size_t>(vertices[i])] != 0) sum += weights[i] * x.row(vertices[i]).transpose();
    }
    return sum;
  }
  /// Returns true if free vertices carry enough of the weights. Otherwise they would have to move far.
  [[nodiscard]] bool can_move(const std::vector<char>& free) const {
    constexpr double least_free = 0.25;
    double moved = 0, all = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      all += std::abs(weights[i]);
      if (free[static_cast<std::size_t>(vertices[i])] != 0) moved += std::abs(weights[i]);
    }
    return moved > 0 && moved >= least_free * all;
  }
  /// Returns true if one of the features belongs to an obstacle.
  [[nodiscard]] bool with_obstacle() const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += weights[i];
    return std::abs(sum) > 0.5;
  }
  /// Returns d(x) [m].
  [[nodiscard]] Eigen::Vector3d place(const Vertices& x) const { return gather(x) + offset; }
  /// Adds weights·value to the rows of the vertices.
  void scatter(const Eigen::Vector3d& value, Vertices& to) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      to.row(vertices[i]) += weights[i] * value.transpose();
    }
  }
};

/// The cloth or an obstacle that it can touch; finds the contacts of a step.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// Begins a step from positions x, n×3 [m], between two times [s].
  virtual void begin(const Vertices& x, double start, double end) = 0;
  /// Appends contacts, sorted by key, for a cloth that moves straight from x to `target`. These are features that end
  /// nearer than their distance or collide on the way, and contacts of `held` that are still near.
  /// @param source number of this source, stored in the keys
  /// @param held   contacts of this source with a nonzero force, sorted by key
  virtual void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
                    std::vector<ContactConstraint>& contacts) = 0;
};

}  // namespace drape
