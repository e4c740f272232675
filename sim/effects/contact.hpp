#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/effects/penalty_energy.hpp"
#include "sim/effects/rebound.hpp"
#include "sim/effects/response.hpp"
#include "sim/effects/surface_contact.hpp"
#include "sim/effects/touched_vertices.hpp"
#include "sim/parallel/part_lists.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {

/// How a surface answers a vertex inside it: it pushes outwards with an acceleration of stiffness·(−gap).
struct ContactLaw {
  static constexpr double usual_stiffness = 8000;  ///< [1/s²]

  double stiffness;  ///< [1/s²]
  Response response;
  double friction;                    ///< Coulomb's coefficient
  std::optional<double> restitution;  ///< of impacts, see ReboundFilter; without, the push is a spring and nothing else

  ContactLaw(const std::optional<double>& k, Response r, double mu, const std::optional<double>& e)
      : stiffness(k.value_or(usual_stiffness)), response(r), friction(mu), restitution(e) {}

  /// Says what is wrong with it in these settings.
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
};

/// Returns true if the method of these settings is explicit, or will be chosen.
bool has_impulses(const SimulationSettings& settings);

/// What keeps contact from being Response::solved in these settings.
std::optional<std::string> solved_problem(const SimulationSettings& settings);

/// Adds the keys of an effect that has these members.
/// @param without_restitution ends the sentence about restitution: what happens without
void describe_contact(Keys& keys, std::optional<double>& stiffness, std::optional<Response>& response, double& friction,
                      std::optional<double>& restitution, const std::string& without_restitution);

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
  [[nodiscard]] bool of_contact() const override { return true; }

  void add(const State& state, double time, Vertices& force) const override {
    const auto now = surface.at(time);
    const auto push = [&](Eigen::Index i, const auto& note) {
      SurfaceContact contact;
      if (!find_contact(now, i, state.x.row(i).transpose(), contact)) return;
      note(contact);
      if (arrives(start, i)) return;
      const double pressure = -masses[i] * stiffness * contact.gap / contact.length;
      force.row(i) += pressure * contact.outward.transpose();
    };
    if (!touched) {
      for_all(threads, state.x.rows(), [&](Eigen::Index i) { push(i, [](const SurfaceContact&) {}); });
      return;
    }
    touched->time = time;
    copy(threads, state.x, touched->x);
    touched->all.fill(threads, state.x.rows(), [&](Eigen::Index i, std::vector<TouchedVertex>& list) {
      push(i, [&](const SurfaceContact& contact) { list.push_back({i, contact}); });
    });
  }
};

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
  const Threads& threads;

  ContactFilter(Surface s, const ContactLaw& l, std::vector<int> vertices, std::shared_ptr<const StepStart> begin,
                std::shared_ptr<const TouchedVertices> pushed, const Threads& by)
      : surface(std::move(s)),
        law(l),
        free(std::move(vertices)),
        start(std::move(begin)),
        touched(std::move(pushed)),
        threads(by) {
    halts_.reserve(std::ssize(free));
  }

  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    // The push was evaluated where the vertices are, or solved for where they go.
    const bool at_end = law.response == Response::implicit_energy;
    const auto drifts = way_of(surface, time, time + h);
    const double rate = std::sqrt(law.stiffness);
    const Step step{h, 1 - 1 / (1 + 2 * h * rate), std::min(rate, 1 / h), !at_end && h * rate > 1, 2 * (1 + h * rate)};
    if (touched && touched->are_those_of(x, time, threads)) {
      halts_.fill_from(threads, touched->all, [&](const auto& list, std::vector<VelocityChange>& halts) {
        if (list.empty()) return;
        auto i = std::lower_bound(free.begin(), free.end(), list.front().vertex);
        for (const auto& [vertex, contact] : list) {
          while (i != free.end() && *i < vertex) ++i;
          if (i != free.end() && *i == vertex) change(*i, contact, step, drifts, v, halts);
        }
      });
      return;
    }
    const auto now = surface.at(at_end ? time + h : time);
    halts_.fill(threads, std::ssize(free), [&](Eigen::Index k, std::vector<VelocityChange>& halts) {
      const int i = free[static_cast<std::size_t>(k)];
      SurfaceContact contact;
      Eigen::Vector3d point = x.row(i).transpose();
      if (at_end) point += h * v.row(i).transpose();
      if (find_contact(now, i, point, contact)) change(i, contact, step, drifts, v, halts);
    });
  }

  void finish(Vertices& v) override {
    halts_.for_each([&](const VelocityChange& halt) { v.row(halt.vertex) += halt.change; });
  }

 private:
  /// What is the same for all vertices in a step.
  struct Step {
    double h, damping, softest;
    bool halted;
    double most_taken;  // of the push
  };

  template <class Ways>
  void change(int i, const SurfaceContact& contact, const Step& step, const Ways& drifts, Vertices& v,
              std::vector<VelocityChange>& halts) const {
    if (start && start->was_outside(i)) return;  // it was not pushed
    const Eigen::Vector3d n = contact.normal();
    const Eigen::Vector3d drift = drifts.of(contact) / step.h;
    const Eigen::Vector3d relative = v.row(i).transpose() - drift;
    double outward = relative.dot(n);
    const Eigen::Vector3d along = relative - outward * n;
    double push = -step.h * law.stiffness * contact.gap;
    // No more than critical damping takes of a vertex that the push alone has brought to that speed: what else pulls it
    // out does so. A push that is solved for is less than that of the depth at the start, and has no such bound.
    const double most = law.response == Response::implicit_energy ? std::max(0.0, outward) : step.most_taken * push;
    const double taken = law.restitution ? std::clamp(outward + step.softest * contact.gap, 0.0, most) : 0;
    outward -= taken;
    push = std::max(0.0, push - taken);
    if (step.halted && taken > 0) {
      halts.push_back({i, -outward * n.transpose()});
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

  PartLists<VelocityChange> halts_;
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
    system.energies.push_back(
        std::make_unique<PenaltyEnergy<Surface>>(surface, law.stiffness, masses, start, system.threads));
  } else {
    auto push = std::make_unique<PenaltyForce<Surface>>(surface, law.stiffness, masses, start, system.threads);
    if (rubs) {
      touched = std::make_shared<TouchedVertices>(masses.size());
      push->touched = touched;
    }
    system.forces.push_back(std::move(push));
  }
  if (rubs) {
    system.filters.push_back(std::make_unique<ContactFilter<Surface>>(surface, law, free_vertices(system.cloth), start,
                                                                      touched, system.threads));
  }
}

}  // namespace drape
