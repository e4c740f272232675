#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

/// Identifier of a contact within a step: its source and the features that meet. It defines the order of contacts.
struct ContactKey {
  int source = 0;  ///< number of the ContactSource
  int kind = 0;    ///< kind of features, numbered by the source
  std::array<int, 4> features = {-1, -1, -1, -1};

  auto operator<=>(const ContactKey&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// Condition on the relative position d of two features at the end of a step.
enum class ContactLaw : unsigned char {
  apart,   ///< n·d ≥ distance, with friction and restitution
  length,  ///< |d| ≤ −distance if `distance` is negative, else |d| ≥ distance
};

/// Two features that must stay a distance apart; one or both belong to the cloth. With the relative position
///   d(x) = Σ weights[i]·x[vertices[i]] + offset
/// the contact is the constraint n·d(x) ≥ distance, linear in x, or another ContactLaw. Its force acts on the cloth as
/// weights[i]·force. An open tie of a seam has a negative distance, along which it pulls; a closed one requires d = 0.
struct ContactConstraint {
  ContactKey key;
  ContactLaw law = ContactLaw::apart;
  int count = 1;                                      ///< number of cloth vertices, 1 to 4
  std::array<int, 4> vertices = {};                   ///< cloth vertices
  std::array<double, 4> weights = {};                 ///< weights of these vertices
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< unit vector from the second feature to the first
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< the obstacle's share of d at the end of the step [m]
  Eigen::Vector3d carried = Eigen::Vector3d::Zero();  ///< change of the obstacle's share of d in the step [m]
  Eigen::Vector3d start = Eigen::Vector3d::Zero();    ///< d at the start of the step, with the same weights [m]
  /// Distance of the features at the start of the step, if they may turn around each other in it [m].
  double before = -std::numeric_limits<double>::infinity();
  double distance = 0;     ///< minimum n·d at the end of the step [m]
  double friction = 0;     ///< Coulomb's coefficient µ
  double restitution = 0;  ///< ratio of separation to impact speed
  double beyond = 0;       ///< additional gap at the end of the step due to a bounce [m]
  bool collides = false;   ///< true if the features pass through each other on straight paths
  bool sews = false;       ///< true for a tie of a seam: a rope, or a weld
  bool welds = false;      ///< true: d(x) = 0 instead, at the end of the step and in every direction
  /// Largest gap of a solved length [m].
  double most_open = std::numeric_limits<double>::infinity();
  double radius = -1;    ///< limit of the friction force, µ times a normal force [N]; negative: unknown
  double stiffness = 0;  ///< penalty κ of the augmented Lagrangian [N/m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< multiplier: the force on d [N]

  static constexpr double most_open_weld = 4e-7;  ///< largest gap of a weld that counts as closed [m]

  /// Returns Σ weights·x over the cloth's vertices [m].
  [[nodiscard]] Eigen::Vector3d gather(const Vertices& x) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      sum += weights[i] * x.row(vertices[i]).transpose();
    return sum;
  }
  /// Returns Σ weights: 0 between features of the cloth, ±1 with an obstacle.
  [[nodiscard]] double weight() const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += weights[i];
    return sum;
  }
  /// Returns true if free vertices carry enough of the weights. Otherwise they would have to move far.
  /// @param inverse_masses see inverse_masses()
  [[nodiscard]] bool can_move(const std::vector<double>& inverse_masses) const {
    constexpr double least_free = 0.25;
    double moved = 0, all = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      all += std::abs(weights[i]);
      if (inverse_masses[static_cast<std::size_t>(vertices[i])] != 0) moved += std::abs(weights[i]);
    }
    return moved > 0 && moved >= least_free * all;
  }
  /// Returns true if features of the cloth alone that cannot move violate the contact at the end of a step: they pass
  /// through each other, or a weld is open.
  [[nodiscard]] bool is_lost(const Vertices& target) const {
    return !with_obstacle() && (welds ? place(target).norm() > most_open_weld : collides);
  }
  /// Returns the velocity of d per impulse on d, Σ weights²/m [1/kg].
  [[nodiscard]] double compliance(const std::vector<double>& inverse_masses) const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      sum += weights[i] * weights[i] * inverse_masses[static_cast<std::size_t>(vertices[i])];
    }
    return sum;
  }
  /// Adds weights/m·impulse to the velocities, or to positions for an impulse in kg·m.
  void push(const std::vector<double>& inverse_masses, const Eigen::Vector3d& impulse, Vertices& to) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const double share = weights[i] * inverse_masses[static_cast<std::size_t>(vertices[i])];
      if (share != 0) to.row(vertices[i]) += share * impulse.transpose();
    }
  }
  /// Returns `distance`, reduced to what the start of the step satisfies: where features turn around each other, the
  /// plane across the normal at the end may cut off their start.
  [[nodiscard]] double possible_distance() const {
    return std::min(distance, std::max(0.0, start.dot(normal)) + std::max(0.0, distance - before));
  }
  /// Returns true if one of the features belongs to an obstacle.
  [[nodiscard]] bool with_obstacle() const { return std::abs(weight()) > 0.5; }
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
  /// Returns true if the cloth may begin too near or on the wrong side, from where the contacts' forces bring it back.
  [[nodiscard]] virtual bool separates() const { return false; }
};

/// Positions of consecutive vertices, relative to a surface [m].
using SurfaceBlock = Eigen::Matrix<double, 16, 3>;

/// A fixed half-space for SurfaceContacts.
struct PlaneObstacle {
  struct Placed {
    Eigen::Vector3d center = Eigen::Vector3d::Zero(), up = Eigen::Vector3d::UnitZ();

    [[nodiscard]] double gap(const Eigen::Vector3d& place) const { return up.dot(place); }
    [[nodiscard]] double margin() const { return 0; }
    [[nodiscard]] bool crosses(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const { return false; }
    /// Returns true if all gaps at the end are `near` or more.
    [[nodiscard]] bool stay_clear(const SurfaceBlock&, const SurfaceBlock& to, double near, double) const {
      return ((to * up).array() >= near).all();
    }
    [[nodiscard]] Eigen::Vector3d surface_point(const Eigen::Vector3d&) const { return Eigen::Vector3d::Zero(); }
    [[nodiscard]] Eigen::Vector3d normal_on_way(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const {
      return up;
    }
  };

  Eigen::Vector3d up;  ///< outward unit normal
  double height;       ///< of the surface above the origin, along `up` [m]

  [[nodiscard]] Placed at(double) const { return {height * up, up}; }
};

/// A moving sphere for SurfaceContacts.
struct BallObstacle {
  struct Placed {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0;

    [[nodiscard]] double gap(const Eigen::Vector3d& place) const { return place.norm() - radius; }
    [[nodiscard]] double margin() const { return 0.05 * radius; }
    [[nodiscard]] Eigen::Vector3d surface_point(const Eigen::Vector3d& normal) const { return radius * normal; }

    /// Returns true if a straight path between two outside positions cuts deeper than the sphere's rim.
    [[nodiscard]] bool crosses(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double distance) const {
      return nearest_on_way(from, to).norm() < rim * (radius + distance);
    }
    /// Returns true only if all gaps at the end are `near` or more and no path crosses: a path that ends that far away
    /// is too short to come nearer than the rim.
    [[nodiscard]] bool stay_clear(const SurfaceBlock& from, const SurfaceBlock& to, double near,
                                  double distance) const {
      const double least = rounding * (radius + near), longest = least - rim * (radius + distance);
      return longest > 0 && (to.rowwise().squaredNorm().array() >= least * least).all() &&
             ((to - from).rowwise().squaredNorm().array() <= longest * longest).all();
    }
    [[nodiscard]] Eigen::Vector3d normal_on_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                double distance) const {
      const double reach = radius + distance;
      const Eigen::Vector3d nearest = nearest_on_way(from, to);
      if (from.norm() < reach || nearest.norm() >= rim * reach) {
        return to.isZero(0) ? Eigen::Vector3d(from.normalized()) : Eigen::Vector3d(to.normalized());
      }
      // Point of entry: |from + t·way| = reach.
      const Eigen::Vector3d way = to - from;
      const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - reach * reach;
      const double t = (-b - std::sqrt(std::max(0.0, b * b - a * c))) / a;
      return (from + t * way).normalized();
    }

   private:
    static constexpr double rim = 0.9;  // a path that stays outside this fraction of the reach only crosses the rim
    static constexpr double rounding = 1 + 1e-9;  // for the roots that the test of a block does without

    [[nodiscard]] static Eigen::Vector3d nearest_on_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      const Eigen::Vector3d way = to - from;
      const double squared = way.squaredNorm();
      const double t = squared > 0 ? std::clamp(-from.dot(way) / squared, 0.0, 1.0) : 0.0;
      return from + t * way;
    }
  };

  std::shared_ptr<const SphereTrack> track;
  double scale = 1;  ///< factor on the track's radius

  [[nodiscard]] Placed at(double time) const {
    const SphereShape shape = track->at(time);
    return {shape.center, scale * shape.radius};
  }
};

/// Motion of a cloth through a step without contact.
struct FreeFlight {
  Vertices start_v;                                   ///< velocities at the start of the step, n×3 [m/s]
  Vertices mean;                                      ///< mean velocities over the step [m/s]
  Vertices target;                                    ///< positions at the end of the step [m]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²]
  Eigen::VectorXd pull;                               ///< of the springs at each vertex, see spring_pull() [1/s²]
  double h = 0;                                       ///< step length [s]
};

/// Returns 1/m of each vertex, 0 of pins [1/kg].
std::vector<double> inverse_masses(const Cloth& cloth);

/// Returns Σ k/m over the springs at each vertex [1/s²].
Eigen::VectorXd spring_pull(const std::vector<Spring>& springs, const Eigen::VectorXd& masses);

/// Rebound by Newton's law of restitution: features arrive at the speed s and leave at e·s, on parabolas under gravity.
/// With the mean velocity w of a step, the velocity at the time t is w + (t − h/2)·g. A vertex in free flight rises to
/// e² of its height for any step length. Springs add an error of the order of h.
///
/// With h² Σk/m > 1/8 at a vertex, springs change its way within the step, and moving it along the parabola strains
/// them: the cloth would gain energy in each impact. Such stiff cloth ends the step at the obstacle and leaves with
/// e·s, limited by Poisson's law to e times the change of velocity that stopped it.
struct Bounce {
  double gap = 0;     ///< gap at the end of the step in excess of the contact distance [m]
  double leaves = 0;  ///< mean velocity after the rebound; of stiff cloth e·s [m/s]
  double turned = 0;  ///< excess of `leaves` over the mean velocity of this step [m/s]
  double struck = 0;  ///< change of speed at impact, s + e·s [m/s]
  bool stiff = false;
};

/// Returns the bounce of a contact. All zero if the rebound is slower than the forces push the features back together
/// within a step.
Bounce bounce_of(const ContactConstraint& contact, const FreeFlight& flight);

/// Returns the change of the velocity of d at the end of a step with a bounce [m/s]. It acts along the normal, plus
/// Coulomb friction of at most µ·struck. Of stiff cloth, friction is that of the rebound alone: the step has rubbed
/// with all of its normal force, which the springs have spread over other vertices as well.
/// @param slip   velocity of d relative to the obstacle at the end of the step [m/s]
/// @param pushed change by the contact's force in the step [m/s]
Eigen::Vector3d change_by(const Bounce& bounce, const ContactConstraint& contact, const Eigen::Vector3d& slip,
                          const Eigen::Vector3d& pushed);

}  // namespace drape
