#include "drape/sim/effects/strain_limit.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "drape/sim/settings.hpp"
#include "sim/contact/edge_limits.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/effects/strain_filter.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

/// Returns the message that an edge starts beyond a limit.
std::string beyond(const char* side, double limit, const Spring& s, double stretch) {
  return fmt::format(
      "the cloth starts beyond the limit, and the first step would jerk it: the edge between the vertices {} "
      "and {} is {:.4g} times as long as at rest, {} {:g}",
      s.i, s.j, stretch, side, limit);
}

}  // namespace

void StrainLimit::describe(Keys& keys) {
  keys.add("max_stretch", &max_stretch, "", "Largest length of an edge, in multiples of its rest length.").at_least(1);
  keys.add("min_stretch", &min_stretch, "", "Smallest length of an edge, likewise. Default: no limit.")
      .at_least(0)
      .at_most(1);
  keys.add("iterations", &iterations, "",
           "Largest number of sweeps over the edges in a step. A step that needs more counts as not converged.")
      .at_least(1);
  keys.add("tolerance", &tolerance, "", "Fraction by which a limit may be exceeded.").above(0);
  describe_cloth(keys, cloth);
}

void StrainLimit::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  check_cloth(cloth, settings, problem);
  check_acts_alone(*this, settings, problem);
  const Cloth& all = settings.cloth;
  const ClothPiece* piece = find_piece(all, cloth);
  std::vector<bool> pinned(static_cast<std::size_t>(all.vertex_count()), false);
  for (const int pin : all.pins) pinned[static_cast<std::size_t>(pin)] = true;
  for (const Spring& s : all.springs) {
    if (piece != nullptr && !piece->has(s.i)) continue;
    if (pinned[static_cast<std::size_t>(s.i)] && pinned[static_cast<std::size_t>(s.j)]) continue;
    const double stretch = (all.positions.row(s.i) - all.positions.row(s.j)).norm() / s.rest_length;
    const double slack = tolerance;
    if (stretch > max_stretch * (1 + slack)) {
      return problem("max_stretch", beyond("above", max_stretch, s, stretch));
    }
    if (stretch < min_stretch.value_or(0) * (1 - slack)) {
      return problem("min_stretch", beyond("below", *min_stretch, s, stretch));
    }
  }
}

void StrainLimit::install(System& system) const {
  system.filters.push_back(std::make_unique<StrainFilter>(*this, system.cloth));
  system.limits.push_back(std::make_shared<EdgeLimits>(*this, system.cloth));
}

}  // namespace drape
