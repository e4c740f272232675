#include "tests/support/audited_run.hpp"

#include <algorithm>
#include <ctime>
#include <variant>

#include "audit/crossings.hpp"
#include "audit/passages.hpp"
#include "drape/sim/simulation.hpp"

namespace drape::test {
namespace {

using namespace audit;

/// Audits steps in order, and keeps the topologies of the cloth and the bodies.
class Auditor {
 public:
  Auditor(const Cloth& cloth, const std::vector<Collider>& colliders)
      : cloth_(make_topology(cloth.triangles, sewn_vertices(cloth.seams))) {
    for (const Collider& collider : colliders) {
      const auto* body = std::get_if<MeshShape>(&collider);
      bodies_.push_back(body != nullptr ? make_topology(*body->triangles) : Topology{});
    }
  }

  void audit(const Vertices& from, const Vertices& to, const std::vector<Collider>& before,
             const std::vector<Collider>& after) {
    ++run.steps;
    std::vector<Passage> passages = find_passages({cloth_, from, to});
    std::vector<Crossing> crossings = find_crossings({cloth_, to});
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (const auto* body = std::get_if<MeshShape>(&after[i])) {
        const Surface surface{bodies_[i], body->positions};
        append(passages, find_passages({cloth_, from, to},
                                       {bodies_[i], std::get<MeshShape>(before[i]).positions, body->positions}));
        append(crossings, find_crossings({cloth_, to}, surface));
        if (is_closed(bodies_[i].triangles)) deepen(find_inside(to, surface));
      } else if (const auto* sphere = std::get_if<SphereShape>(&after[i])) {
        deepen(find_inside_sphere(to, sphere->center, sphere->radius));
      } else if (const auto* ground = std::get_if<GroundShape>(&after[i])) {
        deepen(find_behind_plane(to, ground->height * ground->normal, ground->normal));
      }
    }
    run.with_passages += static_cast<int>(!passages.empty());
    run.with_crossings += static_cast<int>(!crossings.empty());
    tell(passages);
    tell(crossings);
  }

  AuditedRun run;

 private:
  template <class Found>
  static void append(std::vector<Found>& all, const std::vector<Found>& more) {
    all.insert(all.end(), more.begin(), more.end());
  }
  void deepen(const std::vector<Inside>& inside) {
    if (!inside.empty()) run.deepest = std::max(run.deepest, inside.front().depth);
  }
  template <class Found>
  void tell(const std::vector<Found>& found) {
    for (const Found& one : found) {
      if (run.first.size() < 10) run.first.push_back("step " + std::to_string(run.steps) + ": " + describe(one));
    }
  }

  Topology cloth_;
  std::vector<Topology> bodies_;  // in the order of the colliders; empty for colliders other than meshes
};

}  // namespace

AuditedRun audit_run(const SimulationSettings& settings, std::int64_t steps, double most_seconds) {
  Simulation simulation(settings);
  std::vector<Collider> before = simulation.colliders(0);
  Auditor auditor(settings.cloth, before);
  std::vector<double> energies{simulation.energies().total()};
  for (std::int64_t step = 1; step <= steps; ++step) {
    const Vertices from = simulation.state().x;
    simulation.step();
    std::vector<Collider> after = simulation.colliders(static_cast<double>(step) * settings.step);
    auditor.audit(from, simulation.state().x, before, after);
    before = std::move(after);
    energies.push_back(simulation.energies().total());
    if (static_cast<double>(std::clock()) / CLOCKS_PER_SEC > most_seconds) break;
  }
  auditor.run.last = simulation.state();
  auditor.run.rise = largest_rise(energies);
  return auditor.run;
}

}  // namespace drape::test
