#pragma once

#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_problem.hpp"
#include "sim/solvers/anderson.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Minimiser of g(x) under the contacts of a step: n·d(x) ≥ distance with Coulomb friction on the slip d(x) − d(start).
///
/// Uses the method of multipliers (Hestenes 1969; Powell 1969) in the form for friction of Alart and Curnier 1991. A
/// contact has the multiplier r, and t = r − κ·(gap along n, slip across it). Its force is
///   f = n·max(0, n·t) + P(t across n),   P the projection on the disc of radius µ·(n·f).
/// Each iteration takes a Newton step with line search on the augmented function
///   g(x) + Σ (max(0, n·t)² − (n·r)²)/2κ + friction's part.
/// When steps become small beside the remaining gaps and slips, multipliers are set to r = f and radii to µ·(n·f);
/// normals follow the cloth. Friction makes these updates circle around the solution; while the same contacts bear
/// forces, Anderson acceleration ends that. At the solution r = f: contacts that bear a force are closed and sticking
/// ones have not slipped, within the tolerance. Contacts are added once an iteration brings features near or makes them
/// collide on the straight path of the step.
///
/// A hard contact takes energy from the cloth and stores none. EnergyBalance checks steps that stop early.
class ContactSolver {
 public:
  explicit ContactSolver(const System& system);

  /// Begins a step from a state, between two times [s].
  /// @param instantaneous true if the state holds instantaneous velocities, false if it holds mean velocities of the
  ///                      last step
  void begin(const State& from, double start, double end, bool instantaneous);

  /// Makes the strain limits part of this step's contacts, whether or not the cloth touches anything. A step in which
  /// it does has them anyway.
  void include_limits() { with_limits_ = true; }

  /// Sets the multipliers of contacts that persist to the forces of the last step.
  /// @param forces sorted by key, see forces()
  void expect(const std::vector<ContactForce>& forces);

  /// Finds the contacts of a cloth that moves straight to `target`. Returns true if there are any.
  [[nodiscard]] bool touches(const Vertices& target);

  /// Returns true if a cloth that moves straight to `target` passes through anything.
  [[nodiscard]] bool collides(const Vertices& target);

  /// Moves the point, given with g's value and gradient, to the minimum under the contacts. Slips of active contacts
  /// are within the tolerance, and gaps within a fifth of it. The default tolerance is a hundredth of the largest
  /// vertex displacement due to forces in the step, if that is larger. If features still collide at the end, the step
  /// is shortened along its straight path until none do. It then counts as not converged.
  StepReport solve(ContactProblem& problem, const Accuracy& accuracy, int most_iterations, Iterate& point);

  /// Moves the starting point to the positions reached at constant velocities, or to the start of the step, if the
  /// augmented function is lower there. At the given point, stopped vertices may have compressed the springs to all
  /// others.
  /// @param steady positions reached at constant velocities, n×3 [m]
  void choose_start(ContactProblem& problem, const Vertices& steady, Iterate& point);

  /// Returns the work of the contacts on a cloth that moves from the start of the step to x, by their forces at x [J].
  /// An unconverged step gets energy only from moving obstacles and pins, and where a source separates what begins too
  /// near.
  [[nodiscard]] double work(const Vertices& x, bool converged) const;

  /// Returns the mean way of what touches a cloth that ends at x, obstacles and pins [m].
  [[nodiscard]] Eigen::RowVector3d mean_drive(const Vertices& x) const;
  /// Returns the sum of the contacts' forces at x on free vertices [N].
  [[nodiscard]] Eigen::RowVector3d force_on_cloth(const Vertices& x) const;

  /// Returns true if contacts stop a cloth from moving straight to `target`, or if it starts in contact.
  [[nodiscard]] bool is_blocked(const Vertices& target);

  /// Returns true if the cloth touches an obstacle.
  [[nodiscard]] bool touches_obstacles() const;
  /// Returns true if features of the cloth that pins hold pass through each other, or leave a closed seam open.
  [[nodiscard]] bool is_lost() const { return lost_; }
  /// Returns true if a moving obstacle touches the cloth, or moving pins act on a contact of a cloth that ends at x.
  [[nodiscard]] bool driven(const Vertices& x) const;

  /// Sets the velocities v of features that bounced in the step, n×3 [m/s]; see Bounce.
  /// @param instantaneous true if v are instantaneous velocities at the end of the step, false if they are its mean
  ///                      velocities
  void rebound(bool instantaneous, Vertices& v) const;

  [[nodiscard]] const std::vector<ContactConstraint>& contacts() const { return contacts_; }
  /// Returns the forces of lasting contacts with friction after a solve of Newton's Hessian, sorted by key. What slides
  /// without friction is about to leave, and a guess would hold it within the tolerance; so would one where features
  /// met in this step.
  [[nodiscard]] std::vector<ContactForce> forces() const;
  /// Returns the residual of the last solve, contact forces included, n×3 [N].
  [[nodiscard]] const Vertices& residual() const { return gradient_; }
  /// Returns the estimated distance of the worst vertex from the minimum in the last solve [m].
  [[nodiscard]] double error() const { return error_; }
  /// Returns the tolerance of the last solve for vertices [m].
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  /// Force and stiffness of a contact at x.
  struct Response {
    Eigen::Vector3d force;      // [N]
    Eigen::Matrix3d stiffness;  // with respect to d [N/m]
    double energy = 0;          // share of the augmented function [J]
    double residual = 0;        // |f − r|/κ along n, or gap_share times that across it if larger [m]
    bool sticks = false;
  };
  /// Values at a point; the gradient of the augmented function is in gradient_.
  struct PointStatus {
    double value;     // of the augmented function [J]
    double residual;  // largest of all contacts [m]
    double open;      // largest gap of a weld or a length, relative to the allowed one
    double error;     // estimated, of the worst vertex [m]
    bool collides;    // on the straight path
  };
  /// Returns a source of contacts by its number in their keys; strain limits come last.
  [[nodiscard]] ContactSource& source(int number) const;
  /// Returns true if any contact found last is a collision.
  [[nodiscard]] bool any_collides() const;
  /// Finds the contacts of a cloth that moves straight to `target`.
  /// @param turn true to update the geometry of known contacts as well
  void find(const Vertices& target, bool turn);
  [[nodiscard]] Response respond(const ContactConstraint& contact, const Vertices& x) const;
  /// Returns the response of a contact of the law ContactLaw::length.
  [[nodiscard]] static Response respond_to_length(const ContactConstraint& contact, const Vertices& x);
  /// Sets κ of new contacts.
  void set_stiffness(const ContactProblem& problem);
  /// Sets the friction limits of new contacts, or of all. Features that meet rub from the first change of multipliers
  /// on.
  void find_radii(const Vertices& x, bool all);
  PointStatus assess(const ContactProblem& problem, const Iterate& point);
  /// Returns the work of a force that separates features which began too near, if their source does [J].
  [[nodiscard]] double separating_work(const ContactConstraint& contact, const Eigen::Vector3d& force) const;
  /// Sets the multipliers to the forces at x. Returns true if it set them to a combination of these and of earlier ones
  /// instead, see AndersonAcceleration; only Newton's Hessian solves well enough between updates for that.
  bool update_multipliers(const Vertices& x);
  /// Returns the largest residual of a contact at x [m].
  [[nodiscard]] double slack(const Vertices& x) const;

  // Computes Newton's direction for gradient_.
  void find_direction(ContactProblem& problem, const Vertices& x);
  /// Does so with a factor of the Hessian and the contacts; returns false if that would be too expensive.
  [[nodiscard]] bool solve_with_factor(NewtonCholesky& factor, const Vertices& x);
  /// Does so by conjugate gradients.
  void iterate_linearly(ContactProblem& problem);
  [[nodiscard]] std::vector<HeldDirection> held_directions() const;
  /// Moves along direction_ until the augmented function falls enough below `value`. Returns the step length, or 0.
  [[nodiscard]] double descend(ContactProblem& problem, Iterate& point, double value);

  /// Returns true if the cloth touches a moving obstacle.
  [[nodiscard]] bool carried() const;
  /// Returns the part of d(x) − d(start) that is the way of pins [m].
  [[nodiscard]] Eigen::Vector3d way_of_pins(const ContactConstraint& contact, const Vertices& x) const;
  /// Moves vertices of a path to x that collide with moving obstacles along with these, and what collides with them.
  void move_with_obstacles(Vertices& x);
  /// Moves vertices that collide with moving obstacles along with these. Then shortens the path to the point until no
  /// collision is left, towards the start of the step that moving obstacles have pushed out of their way.
  void retreat(ContactProblem& problem, Iterate& point);

  const System& system_;
  ContactPreconditioner preconditioner_;
  std::vector<double> inverse_masses_;  // 0 of pins [1/kg]
  double longest_move_ = 0;             // limit of a vertex's move in an iteration: the mean edge length [m]
  double damping_ = 0;                  // added to the Hessian, as a fraction of its bound
  double error_ = 0;                    // estimated, of the last solve [m]
  double tolerance_ = 0;                // of the last solve [m]
  double concavity_ = 0;                // share of the Hessian's negative eigenvalues
  bool with_limits_ = false;            // see include_limits()
  bool lost_ = false;                   // see is_lost()
  bool exact_ = false;                  // true if the last solve was of Newton's Hessian
  std::vector<ContactConstraint> contacts_, before_, held_;
  std::vector<Response> responses_;
  AndersonAcceleration acceleration_;  // of the multipliers
  std::vector<ContactKey> bearing_;    // contacts of its last update
  int updates_ = 0;                    // of the multipliers, in the step
  FreeFlight flight_;
  Vertices start_, steady_;  // positions at the start of the step, and at its end for constant velocities
  Vertices gradient_, direction_, residual_, preconditioned_, search_, product_;
  Iterate trial_;
};

}  // namespace drape
