#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collider.hpp"
#include "sim/contact/contact.hpp"
#include "sim/parallel/threads.hpp"
#include "sim/pin_motion.hpp"
#include "sim/state.hpp"
#include "sim/stop.hpp"

namespace drape {

/// A force that is evaluated a fixed number of times in a step, see StepForces.
struct Force {
  virtual ~Force() = default;
  /// Whether it is the same at every time and in every state.
  [[nodiscard]] virtual bool constant() const { return false; }
  /// Whether it depends on the velocities.
  [[nodiscard]] virtual bool of_velocity() const { return false; }
  /// Whether it pushes what touches something away from it, see ColliderMotion.
  [[nodiscard]] virtual bool of_contact() const { return false; }
  /// Adds the force on every vertex [N] at the given time [s].
  virtual void add(const State& state, double time, Vertices& force) const = 0;
  /// By how much the acceleration of a vertex changes at most with its place, as if it hung on a spring of this
  /// stiffness for each kilogram [1/s²].
  [[nodiscard]] virtual double stiffness_bound() const { return 0; }
};

class FieldDrag;

/// An upper bound of Hessians that holds in every shape and at every time,
///   B = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ I₃ + diag(d) ⊗ I₃.
struct StiffnessBound {
  std::span<const Spring> springs = {};  ///< those of the system, which this refers to
  /// The pairs i < j of vertices that energies couple, each once for every energy: springs of the stiffness k, which
  /// may be negative, and of no length.
  std::vector<Spring> pairs = {};
  Eigen::VectorXd vertices = {};  ///< d, of vertices by themselves, n [N/m]

  /// How many there are of both.
  [[nodiscard]] std::size_t pair_count() const { return springs.size() + pairs.size(); }
  /// Visits the springs, and then the pairs.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (const Spring& spring : springs) visit(spring);
    for (const Spring& pair : pairs) visit(pair);
  }
};

/// Adds to both ends of a pair the sum of its row there, |k| + |−k|: where these are added up for all pairs, no
/// eigenvalue exceeds the largest sum (Gershgorin's theorem) [N/m].
inline void add_row_sums(const Spring& pair, Eigen::VectorXd& sums) {
  sums[pair.i] += 2 * std::abs(pair.stiffness);
  sums[pair.j] += 2 * std::abs(pair.stiffness);
}

/// A Hessian as its symmetric blocks K,
///   H = Σ (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ K + Σ eᵢ eᵢᵀ ⊗ K.
struct HessianBlocks {
  std::vector<Eigen::Matrix3d> pairs;  ///< in the order of StiffnessBound::pairs [N/m]
  /// Of vertices by themselves: xx, xy, xz, yy, yz, zz. n×6 [N/m]
  Eigen::Matrix<double, Eigen::Dynamic, 6> vertices;
};

/// The Hessian of an energy at one place and time, or a part of it. An object of its own, as only some methods need
/// what it keeps.
struct EnergyHessian {
  virtual ~EnergyHessian() = default;
  /// Takes the places x, n×3 [m], and the time [s].
  /// @param concavity share of the negative eigenvalues that it has, from 0 to 1; an energy may leave out small ones
  virtual void linearise(const Vertices& x, double time, double concavity) = 0;
  /// product += H·vector, both n×3.
  virtual void add_product(const Vertices& vector, Vertices& product) const = 0;
  /// Appends the blocks of its pairs, and adds those of vertices.
  virtual void add_blocks(HessianBlocks& blocks) const = 0;
};

/// An energy E(x, t) ≥ 0 of the cloth, beside that of its springs.
struct Energy {
  virtual ~Energy() = default;
  /// gradient += ∇E, n×3 [N]; returns E [J]. One pass.
  virtual double add_gradient(const Vertices& x, double time, Vertices& gradient) const = 0;
  /// Appends its pairs, and adds what bounds its Hessian at vertices.
  virtual void add_bound(StiffnessBound& bound) const = 0;
  /// Refers to this energy, which must outlive it.
  [[nodiscard]] virtual std::unique_ptr<EnergyHessian> make_hessian() const = 0;
};

/// A change of the velocity at the end of a step.
struct Correction {
  virtual ~Correction() = default;
  /// Changes state.v after a step of h seconds. Semi-implicit Euler moves with the changed velocity.
  virtual void apply(State& state, double h) const = 0;
};

/// A change of the motion of a step before the vertices move: contact, friction, limits of strain (after Bridson,
/// Fedkiw and Anderson 2002, section 4: whatever the integrator, a step ends at x + h·v with v corrected for what it
/// would do).
struct MotionFilter {
  virtual ~MotionFilter() = default;
  /// Takes note of the state in which a step begins at `time` [s], before anything has acted.
  virtual void begin(const State& /*state*/, double /*time*/) {}
  /// Changes v, the velocities n×3 [m/s] with which the cloth is about to go from x to x + h·v, between `time` and
  /// time + h [s]. Leaves the rows of pinned vertices as they are. What it keeps between calls is memory only: the
  /// result depends on the arguments alone.
  virtual void apply(const Vertices& x, double time, double h, Vertices& v) = 0;
  /// Lets what it is for hold again where other filters have changed v since, as a part of the same change: the filters
  /// of a step take turns until nothing is left to change. Returns whether it has changed v.
  virtual bool adjust(const Vertices& /*x*/, double /*time*/, double /*h*/, Vertices& /*v*/) { return false; }
  /// Makes of the velocities with which the vertices have moved those that they have where they are now: what bounces
  /// on its way ends it with another velocity than it went with on average.
  virtual void finish(Vertices& /*v*/) {}
  /// How the last call held the cloth back, if the next step's will do so, too.
  [[nodiscard]] virtual const Restraint* restraint() const { return nullptr; }
  /// Whether the last call did all that the filter is for, rather than stop at its cap.
  [[nodiscard]] virtual bool done() const { return true; }
  /// Whether it did so, and no other filter has undone it since.
  [[nodiscard]] bool converged() const { return settled_ && done(); }
  /// Takes note of whether the filters of the step have come to an end together.
  void note(bool settled) { settled_ = settled; }

  /// What to look at in the loops of apply().
  void heed(const Stop& stop) { stop_ = stop; }

 protected:
  /// @throws Interrupted if it is to end
  void look_at_stop() const { stop_.look(); }

 private:
  Stop stop_;
  bool settled_ = true;
};

/// Something the cloth can touch, whose place is a function of time.
struct ColliderMotion {
  virtual ~ColliderMotion() = default;
  [[nodiscard]] virtual Collider at(double time) const = 0;
  /// Whether it is the same at every time.
  [[nodiscard]] virtual bool rests() const = 0;
};

/// What acts on a cloth, as the schemes evaluate it. Filled by the effects a scene calls for, in the order of the
/// registry; a scene without effects leaves every list empty.
struct System {
  const Cloth& cloth;
  double step;                                        ///< h [s]
  double whole_step;                                  ///< that h is a part of [s]…
  std::int64_t substeps = 1;                          ///< …which has so many of them
  Stop stop = {};                                     ///< of everything that computes with it
  const Threads& threads;                             ///< that share what is worth dividing
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²], for the log's gravity column only

  std::vector<Spring> springs;  ///< the cloth's and those that effects add
  std::vector<std::unique_ptr<Force>> forces;
  /// Those of single vertices that depend on their velocities, and on nothing else that moves. Such a force has no
  /// potential; taken at the start of a step it would give the cloth energy that it has not. Every scheme solves for
  /// the velocity that it acts on, see FieldSolve and FieldKick.
  std::vector<std::unique_ptr<Force>> fields;
  std::vector<std::unique_ptr<Energy>> energies;
  FieldDrag* drag =
      nullptr;  ///< the one of the energies that stands for the fields in an implicit step, if there are any
  std::vector<std::unique_ptr<Correction>> corrections;
  std::vector<std::unique_ptr<MotionFilter>> filters;
  std::vector<std::unique_ptr<ColliderMotion>> colliders;
  std::vector<std::shared_ptr<ContactSource>> contacts;  ///< what the cloth can touch
  std::vector<PinMotion> pin_motions;                    ///< of pins that do not stay where they are
  std::vector<PinRelease> pin_releases;  ///< a simulation makes its system anew, without these pins, when it gets there

  System(const Cloth& c, double h, const Threads& by = one_thread())
      : cloth(c), step(h), whole_step(h), threads(by), springs(c.springs) {}

  /// What no Hessian of the springs and the energies exceeds: the springs, then the energies one after another.
  [[nodiscard]] StiffnessBound stiffness_bound() const;

  /// Where everything is that the cloth can touch, at a time [s].
  [[nodiscard]] std::vector<Collider> colliders_at(double at) const;

  /// Whether nothing gives the cloth energy: it can touch only what rests and itself, no pin is moved, and gravity
  /// alone acts from afar. Then kinetic, elastic and potential energy together can only fall.
  [[nodiscard]] bool only_loses_energy() const;

  /// When a step begins, and so the one before it ends [s]: never a running sum.
  [[nodiscard]] double time(std::int64_t number) const {
    const std::int64_t whole = number / substeps, part = number % substeps;
    return static_cast<double>(whole) * whole_step + static_cast<double>(part) * step;
  }

  /// m/τ² of every vertex [N/m], the inertia that holds it in an implicit step of τ seconds.
  [[nodiscard]] Eigen::VectorXd inertia(double duration) const { return cloth.masses / (duration * duration); }

  /// Shows every filter the state in which a step begins.
  void begin(const State& state) const {
    for (const auto& filter : filters) filter->begin(state, time(state.step));
  }

  /// Writes where the pins that move are at a time [s] into their rows of x.
  void place_pins(double at, Vertices& x) const {
    for (const PinMotion& motion : pin_motions) motion.place(at, x);
  }

  // What ends every step of Euler's, whose velocities are those with which the cloth goes. One that computes them
  // corrects them before it moves by them; one that solves for where the cloth is moves first.

  /// Moves the cloth to the end of the step that begins at state.step: lets every filter change its velocities, and
  /// goes x + h·v. Takes note of what held it back.
  /// @param reached if given, where that is without filters, to the bit
  void move(State& state, const Vertices* reached) const;

  /// Applies every correction to the velocities of that step, and gives the pins that move theirs.
  void correct(State& state) const {
    for (const auto& correction : corrections) correction->apply(state, step);
    for (const PinMotion& motion : pin_motions) motion.drive(time(state.step), time(state.step + 1), state.v);
  }

  // What begins and ends a step of a scheme of second order, whose velocities are those of the moment.

  /// Applies half of what every correction does in a step: once before all else and once after it, which is of second
  /// order (Strang 1968) where corrections commute.
  void correct_half(State& state) const {
    for (const auto& correction : corrections) correction->apply(state, step / 2);
  }

  /// Moves the cloth to where it has been computed to be at the end of the step that begins at state.step. What the
  /// filters change about the velocities with which it goes there, (reached − x)/h, is added to state.v. Takes note of
  /// what held it back.
  /// @param way scratch, n×3
  void move(State& state, const Vertices& reached, Vertices& way) const;

  /// Gives the pins that move the velocity that they have at a time [s].
  void drive_pins(double at, Vertices& v) const {
    for (const PinMotion& motion : pin_motions) motion.drive(at, v);
  }

 private:
  /// Lets every filter change the velocities with which the cloth goes from state.x, and notes in the state what held
  /// it back.
  void filter(State& state, Vertices& way) const;
};

}  // namespace drape
