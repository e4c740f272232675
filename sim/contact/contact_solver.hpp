#pragma once

#include <vector>

#include "sim/contact/bounce.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/contact_preconditioner.hpp"
#include "sim/contact/contact_problem.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Minimises g(x) under the contacts of a step: n·d(x) ≥ distance with Coulomb friction on the slip d(x) − d(start).
///
/// Method of multipliers (Hestenes 1969; Powell 1969) in the form for friction of Alart and Curnier 1991: with the
/// multiplier r of a contact and t = r − κ·(gap along n, slip across it), its force is
///   f = n·max(0, n·t) + P(t across n),   P the projection on the disc of radius µ·(n·f).
/// An iteration takes a step of Newton's method on the augmented function
///   g(x) + Σ (max(0, n·t)² − (n·r)²)/2κ + friction's part,
/// with a line search. Where steps are small beside the gaps and slips that are left, the multipliers become r = f, the
/// radii µ·(n·f), and normals those of where the cloth is. At the solution r = f: contacts that bear a force are closed
/// and those that stick have not slipped, to the tolerance. Contacts enter as soon as an iteration brings features near
/// or has them collide on the straight way of the step.
///
/// A hard contact takes energy from the cloth and stores none. A step that stops early is looked at by EnergyBooks.
class ContactSolver {
 public:
  explicit ContactSolver(const System& system);

  /// Begins a step from a state, between two times [s].
  /// @param of_the_moment whether its velocities are those of the moment, not those with which the cloth has gone
  void begin(const State& from, double start, double end, bool of_the_moment);

  /// Finds the contacts of a cloth that goes straight to `target`. Returns whether there are any.
  [[nodiscard]] bool touches(const Vertices& target);

  /// Returns true if a cloth that goes straight to `target` passes through anything.
  [[nodiscard]] bool collides(const Vertices& target);

  /// Moves the point, which has g's value and gradient, to the minimum under the contacts. Gaps and slips of contacts
  /// that hold are as small as the tolerance; by default that is a hundredth of how far the
  /// step's forces move a vertex at most, if that is more than elsewhere. Where features still collide at the end, the
  /// step goes back on its straight way until none do, and counts as not converged.
  StepReport solve(ContactProblem& problem, const Accuracy& accuracy, int most_iterations, Iterate& point);

  /// Sets the point to where cloth would go that keeps its velocities, or stays where it is, if the augmented function
  /// is less there: vertices that are stopped one by one compress springs that stop all of them at once.
  /// @param steady that place, n×3 [m]
  void choose_start(ContactProblem& problem, const Vertices& steady, Iterate& point);

  /// Work of the contacts on a cloth that goes from the start of the step to x, by their forces there [J]: what
  /// obstacles do by moving, and what it takes to separate features that were too near. The forces of a step that has
  /// not converged may do more. That would be energy out of nothing, and is left out.
  [[nodiscard]] double work(const Vertices& x, bool converged) const;

  /// Returns true if a cloth that goes straight to `target` is kept from that, or begins on what it touches.
  [[nodiscard]] bool hinders(const Vertices& target);

  /// Whether the cloth touches anything but itself.
  [[nodiscard]] bool touches_obstacles() const;
  /// Whether an obstacle that the cloth touches moves.
  [[nodiscard]] bool carried() const;

  /// Gives v, the velocities at the end of the step n×3 [m/s], those of what has bounced in it, see Bounce.
  /// @param of_the_moment whether v are those of the end of the step, and not those with which it has gone there
  void rebound(bool of_the_moment, Vertices& v) const;

  [[nodiscard]] const std::vector<ContactConstraint>& contacts() const { return contacts_; }
  /// What the last solve has left out of balance, the contacts' forces included, n×3 [N].
  [[nodiscard]] const Vertices& residual() const { return gradient_; }
  /// How far the worst vertex was from the minimum there, estimated [m].
  [[nodiscard]] double error() const { return error_; }

 private:
  /// What a contact does at x.
  struct Response {
    Eigen::Vector3d force;      // [N]
    Eigen::Matrix3d stiffness;  // of d [N/m]
    double energy = 0;          // in the augmented function [J]
    double residual = 0;        // |f − r|/κ [m]
    bool sticks = false;
  };
  /// Where a point stands, with the gradient of the augmented function in gradient_.
  struct Standing {
    double value;     // of that function [J]
    double residual;  // largest of a contact [m]
    double error;     // estimated, of a vertex [m]
    bool collides;    // on the straight way
  };
  /// Returns true if any contact, as found last, is a collision.
  [[nodiscard]] bool any_collides() const;
  /// Finds the contacts of a cloth that goes straight to `target`.
  /// @param turn known ones to how their features touch now, too
  void find(const Vertices& target, bool turn);
  [[nodiscard]] Response respond(const ContactConstraint& contact, const Vertices& x) const;
  /// Gives new contacts their κ.
  void set_stiffness(const ContactProblem& problem);
  /// Sets the radii of friction of contacts that have none, or of all.
  void find_radii(const Vertices& x, bool all);
  Standing assess(const ContactProblem& problem, const Iterate& point);
  /// Returns true if a step is short enough for the springs at a contact, so that its features arrive and leave in free
  /// flight. Cloth that is stiffer keeps where it is solved to be, and gets the speed of a rebound alone.
  [[nodiscard]] bool flies_freely(const ContactConstraint& contact) const;
  void give_velocity(const ContactConstraint& contact, const Eigen::Vector3d& change, Vertices& v) const;
  /// Largest residual at x [m].
  [[nodiscard]] double slack(const Vertices& x) const;

  // Newton's direction for gradient_.
  void find_direction(ContactProblem& problem, const Vertices& x);
  /// Solves with a factor of the Hessian and of the contacts that couple no more vertices than that; says which.
  std::vector<char> solve_with_factor(NewtonCholesky& factor, const Vertices& x);
  [[nodiscard]] std::vector<HeldDirection> held_directions(const std::vector<char>& solved) const;
  template <class Solve>
  void iterate_linearly(ContactProblem& problem, const Solve& solve);
  /// Goes along direction_ until the augmented function falls enough from `value`; returns what part of it, or 0.
  [[nodiscard]] double descend(ContactProblem& problem, Iterate& point, double value);

  /// Has vertices that collide with obstacles go with them.
  void go_with_obstacles(Vertices& x);
  /// Has what still collides with obstacles that move go with them, and then shortens the way to the point until
  /// nothing collides on it.
  void retreat(ContactProblem& problem, Iterate& point);

  const System& system_;
  ContactPreconditioner preconditioner_;
  std::vector<char> free_;    // whether each vertex can move
  std::vector<double> pull_;  // the stiffness of the springs at each vertex [N/m]
  double longest_move_ = 0;   // of a vertex in an iteration: an edge [m]
  double damping_ = 0;        // of the Hessian's bound, added to it
  double error_ = 0;          // of the last solve [m]
  double concavity_ = 0;      // share of the Hessian's negative eigenvalues
  std::vector<ContactConstraint> contacts_, before_, held_;
  std::vector<Response> responses_;
  FreeFlight flight_;
  Vertices start_, steady_;  // of the step, and where steady velocities lead
  Vertices gradient_, direction_, residual_, preconditioned_, search_, product_;
  Iterate trial_;
};

}  // namespace drape
