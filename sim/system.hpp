#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/state.hpp"
#include "drape/sim/tracks.hpp"
#include "sim/bending/curvature.hpp"
#include "sim/contact/contact.hpp"
#include "sim/parallel/threads.hpp"
#include "sim/spring_network.hpp"

namespace drape {

/// A force that is evaluated a fixed number of times per step, see StepForces.
struct Force {
  virtual ~Force() = default;
  /// Returns true if it is the same at every time and in every state.
  [[nodiscard]] virtual bool constant() const { return false; }
  /// Returns true if it depends on velocities.
  [[nodiscard]] virtual bool depends_on_velocity() const { return false; }
  /// Returns true if it pushes the cloth away from an obstacle, see ColliderMotion.
  [[nodiscard]] virtual bool of_contact() const { return false; }
  /// Adds the force on every vertex at a time [s] [N].
  virtual void add(const State& state, double time, Vertices& force) const = 0;
  /// Returns a bound on the change of a vertex's acceleration with its position, like a spring's stiffness per mass
  /// [1/s²].
  [[nodiscard]] virtual double stiffness_bound() const { return 0; }
};

struct Dashpots;
class FieldDrag;
class StepDissipation;

/// An upper bound on Hessians for all positions and times,
///   B = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ I₃ + diag(d) ⊗ I₃.
struct StiffnessBound {
  std::span<const Spring> springs = {};  ///< springs of the system, by reference
  /// Pairs i < j of vertices coupled by energies, each once per energy. They act as springs of zero length with
  /// stiffness k, which may be negative.
  std::vector<Spring> pairs = {};
  Eigen::VectorXd vertices = {};  ///< d, per vertex, n [N/m]

  /// Returns the number of springs and pairs.
  [[nodiscard]] std::size_t pair_count() const { return springs.size() + pairs.size(); }
  /// Visits the springs, then the pairs.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (const Spring& spring : springs) visit(spring);
    for (const Spring& pair : pairs) visit(pair);
  }
};

/// Adds a pair's row sums |k| + |−k| to both of its vertices. Summed over all pairs, the largest sum bounds every
/// eigenvalue (Gershgorin's theorem) [N/m].
inline void add_row_sums(const Spring& pair, Eigen::VectorXd& sums) {
  sums[pair.i] += 2 * std::abs(pair.stiffness);
  sums[pair.j] += 2 * std::abs(pair.stiffness);
}

/// A part of a Hessian that couples all vertices of a list: stiffness·a aᵀ.
struct HessianProduct {
  std::span<const int> vertices;
  std::span<const Eigen::RowVector3d> direction;  ///< a, one row per vertex of the list
  double stiffness;                               ///< positive [N/m]
};

/// A Hessian as blocks K,
///   H = Σ pairs + Σ eᵢ eᵢᵀ ⊗ K + Σ products.
/// A pair i < j with a symmetric K adds (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ K. In general it adds −K at (i, j), −Kᵀ at (j, i), and
/// the symmetric part of K at (i, i) and (j, j).
struct HessianBlocks {
  std::vector<Eigen::Matrix3d> pairs;  ///< in the order of StiffnessBound::pairs [N/m]
  /// Blocks of single vertices: xx, xy, xz, yy, yz, zz. n×6 [N/m]
  Eigen::Matrix<double, Eigen::Dynamic, 6> vertices;
  std::vector<HessianProduct> products = {};  ///< valid until the next EnergyHessian::linearise()
};

/// The Hessian of an energy at given positions and time, or a part of it. It is separate because only some methods need
/// its memory.
struct EnergyHessian {
  virtual ~EnergyHessian() = default;
  /// Evaluates the Hessian at positions x, n×3 [m], and a time [s].
  /// @param concavity fraction of the negative eigenvalues to keep, 0 to 1; an energy may omit small ones
  virtual void linearise(const Vertices& x, double time, double concavity) = 0;
  /// Adds H·vector to the product, both n×3.
  virtual void add_product(const Vertices& vector, Vertices& product) const = 0;
  /// Appends the blocks of its pairs and its products, and adds the blocks of vertices.
  virtual void add_blocks(HessianBlocks& blocks) const = 0;
};

/// An energy E(x, t) ≥ 0 of the cloth other than that of its springs.
struct Energy {
  int piece = -1;  ///< number of the only cloth that has it, see Cloth::pieces; −1: any

  virtual ~Energy() = default;
  /// Adds ∇E to the gradient, n×3 [N]; returns E [J], in one pass.
  virtual double add_gradient(const Vertices& x, double time, Vertices& gradient) const = 0;
  /// Appends its pairs, and adds its bounds at vertices.
  virtual void add_bound(StiffnessBound& bound) const = 0;
  /// Returns a Hessian that refers to this energy, which must outlive it.
  [[nodiscard]] virtual std::unique_ptr<EnergyHessian> make_hessian() const = 0;
  /// Returns true if the cloth stores it. A dissipation potential of a step is no part of the cloth's energy.
  [[nodiscard]] virtual bool stored() const { return true; }
};

/// A change of the velocity at the end of a step.
struct Correction {
  virtual ~Correction() = default;
  /// Changes state.v after a step of h seconds. Semi-implicit Euler then moves with the changed velocity.
  virtual void apply(State& state, double h) const = 0;
  /// Returns the factor by which apply() multiplies every velocity, if it does nothing else.
  [[nodiscard]] virtual std::optional<double> decay(double /*h*/) const { return std::nullopt; }
};

/// A change of a step's motion before the vertices move: contact, friction, strain limits. After Bridson, Fedkiw and
/// Anderson 2002, section 4: with any integrator a step ends at x + h·v with a corrected v.
struct MotionFilter {
  virtual ~MotionFilter() = default;
  /// Receives the state at the start of a step at `time` [s], before anything has acted.
  virtual void begin(const State& /*state*/, double /*time*/) {}
  /// Changes v, the velocities n×3 [m/s] of the move from x to x + h·v, between `time` and time + h [s]. Keeps the rows
  /// of pinned vertices. Data kept between calls are scratch memory: the result depends only on the arguments.
  virtual void apply(const Vertices& x, double time, double h, Vertices& v) = 0;
  /// Restores the filter's condition after other filters have changed v, as part of the same change. The filters of a
  /// step take turns until none changes v. Returns true if it has changed v.
  virtual bool adjust(const Vertices& /*x*/, double /*time*/, double /*h*/, Vertices& /*v*/) { return false; }
  /// Converts the mean velocities of the step into final ones. A vertex that bounces on its way has a different final
  /// velocity.
  virtual void finish(Vertices& /*v*/) {}
  /// Returns the restraint of the last call, if the next step can expect the same.
  [[nodiscard]] virtual const Restraint* restraint() const { return nullptr; }
  /// Returns the work of the last call's impulses along the violations that it accepts [J].
  [[nodiscard]] virtual double tolerated_gain() const { return 0; }
  /// Returns true if the last call converged before its iteration limit.
  [[nodiscard]] virtual bool done() const { return true; }

  /// Sets the stop request that the loops of apply() check.
  void set_stop(const Stop& stop) { stop_ = stop; }

 protected:
  /// @throws Interrupted if a stop is requested
  void check_stop() const { stop_.check(); }

 private:
  Stop stop_;
};

/// An obstacle whose position is a function of time.
struct ColliderMotion {
  virtual ~ColliderMotion() = default;
  [[nodiscard]] virtual Collider at(double time) const = 0;
  /// Returns true if it is the same at every time.
  [[nodiscard]] virtual bool rests() const = 0;
};

/// All that acts on a cloth, in the form that schemes evaluate. The effects of a scene add to its lists in the order of
/// the registry; without effects every list is empty.
struct System {
  const Cloth& cloth;
  double step;                ///< h [s]
  double whole_step;          ///< duration of an undivided step [s]
  std::int64_t substeps = 1;  ///< number of h in an undivided step
  /// Limit of the default tolerance of solves, as a residual acceleration [m/s²].
  double solve_limit = std::numeric_limits<double>::infinity();
  Stop stop = {};                                     ///< for all computations with this system
  const Threads& threads;                             ///< for passes worth dividing
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< for the gravity column of the log only [m/s²]

  std::vector<Spring> springs;  ///< of the cloth and of effects
  std::vector<std::unique_ptr<Force>> forces;
  /// Forces on single vertices that depend on their velocities and nothing else that moves. Such a force has no
  /// potential. Evaluated at the start of a step, it could add energy. So every scheme solves for the velocity that it
  /// acts on, see FieldSolve and FieldKick.
  std::vector<std::unique_ptr<Force>> fields;
  std::vector<std::unique_ptr<Energy>> energies;
  FieldDrag* drag = nullptr;  ///< energy for the fields in an implicit step, if there are any
  std::vector<std::unique_ptr<Correction>> corrections;
  std::vector<std::unique_ptr<MotionFilter>> filters;
  std::vector<std::unique_ptr<ColliderMotion>> colliders;
  std::vector<std::shared_ptr<ContactSource>> contacts;  ///< everything that the cloth can touch
  std::vector<std::shared_ptr<ContactSource>> limits;    ///< on strain, for implicit steps that cannot use the filters
  std::vector<PinMotion> pin_motions;                    ///< of pins that move
  std::vector<PinRelease> pin_releases;  ///< at each release, a simulation makes a new system without these pins
  std::vector<CurvatureElement> bending_elements;   ///< of all bending energies, for dashpots
  double damping_time = 0;                          ///< relaxation time of the dashpots [s]
  std::vector<std::shared_ptr<Dashpots>> dashpots;  ///< of internal damping
  std::vector<StepDissipation*> dissipations;       ///< energies for the dashpots in an implicit step

  System(const Cloth& c, double h, const Threads& by = one_thread())
      : cloth(c), step(h), whole_step(h), threads(by), springs(c.springs) {}

  /// Returns the springs in the layout of their passes, made at the first call. Schemes and energies share it, on one
  /// thread.
  [[nodiscard]] const SpringNetwork& network() const;

  /// Returns an upper bound on all Hessians: of the springs, then of the energies in order.
  [[nodiscard]] StiffnessBound stiffness_bound() const;

  /// Returns everything that the cloth can touch, at a time [s].
  [[nodiscard]] std::vector<Collider> colliders_at(double at) const;

  /// Returns true if nothing adds energy: the cloth touches only itself and fixed obstacles, no pin moves, and gravity
  /// is the only other force. Then the total of kinetic, elastic and potential energy can only fall.
  [[nodiscard]] bool only_loses_energy() const;

  /// Returns the time at the start of a step, which ends the previous one [s]. It is never a running sum.
  [[nodiscard]] double time(std::int64_t number) const {
    const std::int64_t whole = number / substeps, part = number % substeps;
    return static_cast<double>(whole) * whole_step + static_cast<double>(part) * step;
  }

  /// Returns the inertia m/τ² of every vertex in an implicit step of τ seconds [N/m].
  [[nodiscard]] Eigen::VectorXd inertia(double duration) const { return cloth.masses / (duration * duration); }

  /// Passes the state at the start of a step to every filter.
  void begin(const State& state) const {
    for (const auto& filter : filters) filter->begin(state, time(state.step));
  }

  /// Writes the moving pins' positions at a time [s] into their rows of x.
  void place_pins(double at, Vertices& x) const {
    for (const PinMotion& motion : pin_motions) motion.place(at, x);
  }

  /// Lets every filter change the velocities of the move from state.x, n×3 [m/s], and records the restraint in the
  /// state. Returns false if they have not converged together.
  bool filter(State& state, Vertices& way) const;

  /// Returns the energy that the last call of filter() may have added within the tolerances of the filters [J].
  [[nodiscard]] double tolerated_gain() const;

  // End of a step of Euler schemes, whose velocities are mean velocities of the step. Explicit ones correct velocities
  // before the move, implicit ones after it.

  /// Moves the cloth to the end of the step that begins at state.step: lets every filter change the velocities, then
  /// adds h·v to x. Returns false if the filters have not converged.
  bool move(State& state) const;

  /// Applies every correction to the velocities of that step, and sets those of moving pins.
  void correct(State& state) const {
    for (const auto& correction : corrections) correction->apply(state, step);
    for (const PinMotion& motion : pin_motions) motion.drive(time(state.step), time(state.step + 1), state.v);
  }

  /// Returns the factor by which the corrections of h seconds multiply every velocity, if they do nothing else.
  [[nodiscard]] std::optional<double> decay(double h) const {
    if (corrections.empty()) return 1;
    return corrections.size() == 1 ? corrections.front()->decay(h) : std::nullopt;
  }

  // Start and end of a step of second-order schemes, whose velocities are instantaneous.

  /// Applies every correction for half a step. Done before and after all else it has second order (Strang 1968) if
  /// corrections commute.
  void correct_half(State& state) const {
    for (const auto& correction : corrections) correction->apply(state, step / 2);
  }

  /// Moves the cloth to its computed positions at the end of the step that begins at state.step. Changes that filters
  /// make to the mean velocities, (reached − x)/h, are added to state.v. Returns false if the filters have not
  /// converged.
  /// @param way scratch, n×3
  bool move(State& state, const Vertices& reached, Vertices& way) const;

  /// Sets the velocities of moving pins at a time [s].
  void drive_pins(double at, Vertices& v) const {
    for (const PinMotion& motion : pin_motions) motion.drive(at, v);
  }

 private:
  mutable std::unique_ptr<const SpringNetwork> network_;
};

/// Returns the system of all that acts on the cloth with these settings. It refers to the settings and the threads,
/// which must outlive it.
/// @param effect_seconds if given, one number per effect, to which its computing time is added
System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());
/// Returns the same system with another step length [s].
System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());

}  // namespace drape
