#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/effects/rebound.hpp"
#include "sim/effects/response.hpp"
#include "sim/effects/surface_contact.hpp"
#include "sim/effects/touched_vertices.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {

/// How a surface answers a vertex inside it: it pushes outwards with an acceleration of stiffness·(−gap).
struct ContactLaw {
  double stiffness;  ///< [1/s²]
  Response response;
  double friction;                    ///< Coulomb's coefficient
  std::optional<double> restitution;  ///< of impacts, see ReboundFilter; without, the push is a spring and nothing else

  /// Says what is wrong with it in these settings.
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
};

/// Adds the keys of an effect that has these members.
/// @param without_restitution ends the sentence about restitution: what happens without
void describe_contact(Keys& keys, double& stiffness, Response& response, double& friction,
                      std::optional<double>& restitution, const std::string& without_restitution);

/// Whether a vertex arrives in this step at a surface from which it bounces: then it is the impact that stops it, and
/// not the push.
inline bool arrives(const std::shared_ptr<const StepStart>& start, Eigen::Index i) {
  return start && start->was_outside(static_cast<int>(i));
}

/// The push as a force, a = stiffness·(−gap) outwards; where no direction leads outwards there is none.
template <class Surface>
struct PenaltyForce final : Force {
  Surface surface;
  double stiffness;
  const Eigen::VectorXd& masses;
  std::shared_ptr<const StepStart> start;    // null without restitution
  std::shared_ptr<TouchedVertices> touched;  // null where nobody asks
  const Threads& threads;

  PenaltyForce(Surface s, double k, const Eigen::VectorXd& m, std::shared_ptr<const StepStart> begin, const Threads& by)
      : surface(std::move(s)), stiffness(k), masses(m), start(std::move(begin)), threads(by) {}

  [[nodiscard]] double stiffness_bound() const override { return stiffness; }

  void add(const State& state, double time, Vertices& force) const override {
    const auto now = surface.at(time);
    if (touched) {
      touched->time = time;
      touched->x = state.x;
      touched->all.clear();
    }
    const auto push = [&](Eigen::Index first, Eigen::Index count) {
      SurfaceContact contact;
      for (Eigen::Index i = first; i < first + count; ++i) {
        if (!find_contact(now, i, state.x.row(i).transpose(), contact)) continue;
        if (touched) touched->all.push_back({i, contact});
        if (arrives(start, i)) continue;
        const double pressure = -masses[i] * stiffness * contact.gap / contact.length;
        force.row(i) += pressure * contact.outward.transpose();
      }
    };
    // What is remembered of some vertices for others is one thread's.
    for_ranges(touched || remembers(now) ? one_thread() : threads, state.x.rows(), push);
  }
};

/// The push as an energy, E = Σ m·stiffness/2·gap². Where impacts have a restitution, what arrives in a step is not
/// pushed in it: it is the impact that stops it.
template <class Surface>
struct PenaltyEnergy final : Energy {
  Surface surface;
  double stiffness;
  const Eigen::VectorXd& masses;
  std::shared_ptr<const StepStart> start;  // null without restitution

  PenaltyEnergy(Surface s, double k, const Eigen::VectorXd& m, std::shared_ptr<const StepStart> begin)
      : surface(std::move(s)), stiffness(k), masses(m), start(std::move(begin)) {}

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override {
    const auto now = surface.at(time);
    double total = 0;
    SurfaceContact contact;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (!find_contact(now, i, x.row(i).transpose(), contact) || arrives(start, i)) continue;
      const double pressure = -masses[i] * stiffness * contact.gap;
      gradient.row(i) -= pressure * contact.normal().transpose();
      total -= 0.5 * pressure * contact.gap;
    }
    return total;
  }

  void add_bound(StiffnessBound& bound) const override { bound.vertices += stiffness * masses; }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;
  [[nodiscard]] bool internal() const override { return false; }
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const override {
    return surface.displacement(from, to);
  }
};

/// Of the energy's Hessian m·stiffness·(nnᵀ + gap·∇n) the first term, which is positive; the second is negative where
/// the surface is convex.
template <class Surface>
class PenaltyHessian final : public EnergyHessian {
 public:
  explicit PenaltyHessian(const PenaltyEnergy<Surface>& energy) : energy_(energy) {
    contacts_.reserve(static_cast<std::size_t>(energy.masses.size()));
  }

  void linearise(const Vertices& x, double time, double /*concavity*/) override {
    contacts_.clear();
    const auto now = energy_.surface.at(time);
    SurfaceContact contact;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (!find_contact(now, i, x.row(i).transpose(), contact) || arrives(energy_.start, i)) continue;
      const Eigen::Vector3d n = contact.normal();
      const double k = energy_.masses[i] * energy_.stiffness;
      contacts_.push_back({i,
                           {k * (n[0] * n[0]), k * (n[0] * n[1]), k * (n[0] * n[2]), k * (n[1] * n[1]),
                            k * (n[1] * n[2]), k * (n[2] * n[2])}});
    }
  }

  void add_product(const Vertices& vector, Vertices& product) const override {
    for (const auto& [i, b] : contacts_) {
      const double x = vector(i, 0), y = vector(i, 1), z = vector(i, 2);
      product(i, 0) += b[0] * x + b[1] * y + b[2] * z;
      product(i, 1) += b[1] * x + b[3] * y + b[4] * z;
      product(i, 2) += b[2] * x + b[4] * y + b[5] * z;
    }
  }

  void add_blocks(HessianBlocks& blocks) const override {
    for (const auto& [i, b] : contacts_) {
      for (Eigen::Index k = 0; k < 6; ++k) blocks.vertices(i, k) += b[static_cast<std::size_t>(k)];
    }
  }

 private:
  struct PushedVertex {
    Eigen::Index vertex;
    std::array<double, 6> block;  // as in HessianBlocks
  };

  const PenaltyEnergy<Surface>& energy_;
  std::vector<PushedVertex> contacts_;
};

template <class Surface>
std::unique_ptr<EnergyHessian> PenaltyEnergy<Surface>::make_hessian() const {
  return std::make_unique<PenaltyHessian<Surface>>(*this);
}

/// Friction of what lies on a surface, and what the push may give back to it, as a change of a step's velocities
/// relative to the surface (Bridson, Fedkiw and Anderson 2002, section 5, with the penalty's own impulse as the normal
/// one). In a step the push adds h·stiffness·(−gap) to a vertex's outward speed; friction takes at most `friction`
/// times that from the speed along the surface, and stops it if that is enough. So what rests on a slope of tan θ ≤ µ
/// stays, to the bit.
///
/// Where impacts have a restitution, the push throws nothing off: it leaves the outward speed that carries a vertex out
/// of the surface as a critically damped spring would, √stiffness·(−gap) and no further than the surface.
/// Beside a law for impacts it damps what lies there critically as well, so that it comes to rest, and never pulls.
/// Where a step is so long that this carries it to the surface at once (step·√stiffness > 1), it comes to rest there.
template <class Surface>
struct ContactFilter final : MotionFilter {
  Surface surface;
  ContactLaw law;
  std::vector<int> free;                           // the vertices that are not pinned
  std::shared_ptr<const StepStart> start;          // null where nothing bounces
  std::shared_ptr<const TouchedVertices> touched;  // null where the push is solved for

  ContactFilter(Surface s, const ContactLaw& l, std::vector<int> vertices, std::shared_ptr<const StepStart> begin,
                std::shared_ptr<const TouchedVertices> pushed)
      : surface(std::move(s)),
        law(l),
        free(std::move(vertices)),
        start(std::move(begin)),
        touched(std::move(pushed)),
        halts_(free.size()) {}

  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    // The push was evaluated where the vertices are, or solved for where they go.
    const bool at_end = law.response == Response::implicit_energy;
    const auto drifts = way_of(surface, time, time + h);
    const Step step{h, 1 - 1 / (1 + 2 * h * std::sqrt(law.stiffness)), std::min(std::sqrt(law.stiffness), 1 / h),
                    !at_end && h * std::sqrt(law.stiffness) > 1};
    halts_.clear();
    if (touched && touched->are_those_of(x, time)) {
      auto i = free.begin();
      for (const auto& [vertex, contact] : touched->all) {
        while (i != free.end() && *i < vertex) ++i;
        if (i != free.end() && *i == vertex) change(*i, contact, step, drifts, v);
      }
      return;
    }
    const auto now = surface.at(at_end ? time + h : time);
    SurfaceContact contact;
    for (const int i : free) {
      Eigen::Vector3d point = x.row(i).transpose();
      if (at_end) point += h * v.row(i).transpose();
      if (find_contact(now, i, point, contact)) change(i, contact, step, drifts, v);
    }
  }

  void finish(Vertices& v) override { halts_.apply(v); }

 private:
  /// What is the same for all vertices in a step.
  struct Step {
    double h, damping, softest;
    bool halted;
  };

  template <class Ways>
  void change(int i, const SurfaceContact& contact, const Step& step, const Ways& drifts, Vertices& v) {
    if (start && start->was_outside(i)) return;  // it was not pushed
    const Eigen::Vector3d n = contact.normal();
    const Eigen::Vector3d drift = drifts.of(contact) / step.h;
    const Eigen::Vector3d relative = v.row(i).transpose() - drift;
    double outward = relative.dot(n);
    const Eigen::Vector3d along = relative - outward * n;
    double push = -step.h * law.stiffness * contact.gap;
    const double taken = law.restitution ? std::max(0.0, outward + step.softest * contact.gap) : 0;
    outward -= taken;
    push = std::max(0.0, push - taken);
    if (step.halted && taken > 0) {
      halts_.add(i, -outward * n);
      push = std::max(0.0, push - outward);
    } else if (start) {
      const double damped = std::min(push, step.damping * outward);
      outward -= damped;
      push -= damped;
    }
    const double speed = along.norm(), lost = law.friction * push;
    const double kept = speed > lost ? 1 - lost / speed : 0;
    v.row(i) = (drift + outward * n + kept * along).transpose();
  }

  VelocityChanges halts_;
};

/// The vertices that are not pinned.
std::vector<int> free_vertices(const Cloth& cloth);

/// Adds what the law asks for to the system, whose gravity must be in it already.
template <class Surface>
void install_contact(const Surface& surface, const ContactLaw& law, System& system) {
  const Eigen::VectorXd& masses = system.cloth.masses;
  std::shared_ptr<const StepStart> start;
  if (law.restitution > 0) {
    auto rebound = std::make_unique<ReboundFilter<Surface>>(surface, *law.restitution, law.friction, system,
                                                            free_vertices(system.cloth));
    start = rebound->start;
    system.filters.push_back(std::move(rebound));
  }
  const bool rubs = law.friction > 0 || law.restitution;
  std::shared_ptr<TouchedVertices> touched;
  if (law.response == Response::implicit_energy) {
    system.energies.push_back(std::make_unique<PenaltyEnergy<Surface>>(surface, law.stiffness, masses, start));
  } else {
    auto push = std::make_unique<PenaltyForce<Surface>>(surface, law.stiffness, masses, start, system.threads);
    if (rubs) {
      touched = std::make_shared<TouchedVertices>(masses.size());
      push->touched = touched;
    }
    system.forces.push_back(std::move(push));
  }
  if (rubs) {
    system.filters.push_back(
        std::make_unique<ContactFilter<Surface>>(surface, law, free_vertices(system.cloth), start, touched));
  }
}

}  // namespace drape
