#include "study/stability.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "core/parallel.hpp"
#include "run/run_steps.hpp"
#include "sim/blow_up.hpp"
#include "sim/effects/gravity.hpp"
#include "sim/effects/ground.hpp"
#include "sim/make_system.hpp"
#include "sim/simulation.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr int cells = 6;                  // along a side
constexpr double spring_stiffness = 180;  // spring stiffness on the push axis [N/m]
constexpr double depth = 0.01;            // depth of the cloth in the ground [m]
constexpr double disturbance = 1e-4;      // amplitude of the oscillation [m]

/// Returns a level ground at height 0, as a huge sphere whose push acts like a spring of this stiffness [1/s²].
Sphere ground(double stiffness) {
  constexpr double radius = 1e6;
  return {.center = Eigen::Vector3d(0, 0, -radius), .radius = radius, .scale = 1, .stiffness = stiffness};
}

/// Returns the potential energy of the ground's push, Σ m·stiffness/2·depth² [J].
double push_energy(const Cloth& cloth, const Vertices& x, double stiffness) {
  return 0.5 * stiffness * cloth.masses.dot(x.col(2).cwiseMin(0).cwiseAbs2());
}

/// Places a moving cloth into the ground. It moves down evenly, which strains no spring, and alternately within its
/// plane, which strains the springs most.
void lay(Cloth& cloth, double stiffness) {
  const double speed = disturbance * std::sqrt(stiffness);
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    const int column = i % (cells + 1), row = i / (cells + 1);
    cloth.positions(i, 2) = -depth;
    cloth.velocities.row(i) = speed * Eigen::RowVector3d((column + row) % 2 == 0 ? 1 : -1, row % 2 == 0 ? 1 : -1, -1);
  }
}

std::vector<double> decades(double from, double to, int per_decade) {
  std::vector<double> values;
  const int count = static_cast<int>(std::lround(std::log10(to / from) * per_decade));
  for (int i = 0; i <= count; ++i) values.push_back(from * std::pow(10.0, static_cast<double>(i) / per_decade));
  return values;
}

StabilityMap empty_map(StepMethod method, StabilityAxis axis, const StabilityDetail& detail) {
  StabilityMap map;
  map.method = method;
  map.axis = axis;
  map.steps = decades(1e-5, 1, detail.per_decade);
  map.stiffnesses =
      axis == StabilityAxis::springs ? decades(1e-2, 1e9, detail.per_decade) : decades(1, 1e9, detail.per_decade);
  for (const double stiffness : map.stiffnesses) map.limits.push_back(stability_limit(method, axis, stiffness));
  map.limit_name = is_explicit(method.method)    ? "safe step"
                   : axis == StabilityAxis::push ? "step·√stiffness = 2"
                                                 : "condition 1e14";
  map.cells.resize(map.steps.size() * map.stiffnesses.size());
  return map;
}

/// Returns the unmeasured limits of every map that has one.
std::vector<StabilityLimit> empty_borders() {
  std::vector<StabilityLimit> borders;
  for (const double stiffness : {1e-2, 1.0, 1e2, 1e4, 1e6, 1e8}) {
    for (const Method method : {Method::semi_implicit, Method::verlet}) {
      borders.push_back({method, StabilityAxis::springs, stiffness});
    }
  }
  for (const StepMethod method : step_methods) {
    for (const double stiffness : {1e2, 1e4, 1e6, 1e8}) {
      borders.push_back({method, StabilityAxis::push, stiffness});
    }
  }
  return borders;
}

/// Returns the cost of a step, relative to an explicit step of the maps' cloth.
double cost_of_step(StepMethod method) { return is_explicit(method.method) ? 1 : 30; }

void measure_part(StabilityStudy& study, std::size_t part, const std::stop_token& stop) {
  for (StabilityMap& map : study.maps) {
    if (part < map.cells.size()) {
      const std::size_t columns = map.steps.size();
      map.cells[part] = stability_cell(map.method, map.axis, map.steps[part % columns], map.stiffnesses[part / columns],
                                       study.detail.steps);
      return;
    }
    part -= map.cells.size();
  }
  if (part < study.borders.size()) {
    StabilityLimit& border = study.borders[part];
    border = stability_border(border.method, border.axis, border.stiffness);
  } else {
    measure_energy(study.energies.at(part - study.borders.size()), stop);
  }
}

}  // namespace

const char* outcome_name(StabilityOutcome outcome) {
  constexpr const char* names[] = {"stable", "converged", "not converged", "blown up"};
  return names[static_cast<std::size_t>(outcome)];
}

SimulationSettings stability_cloth(StepMethod method, StabilityAxis axis, double step, double stiffness) {
  const bool pushed = axis != StabilityAxis::springs;
  const Mesh mesh = make_grid(cells, cells);
  SimulationSettings settings;
  settings.cloth = make_cloth(mesh, mesh, 1, pushed ? spring_stiffness : stiffness,
                              pushed ? std::vector<int>{} : std::vector<int>{0, cells});
  settings.step = step;
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.integrator.allow_unstable = true;
  settings.integrator.tolerance = 1e-6;
  settings.effects = {Gravity{.acceleration = {0, 0, pushed ? -stiffness * depth : -9.8}}};
  if (pushed) {
    settings.effects.add(ground(stiffness));
    lay(settings.cloth, stiffness);
  }
  return settings;
}

double stability_limit(StepMethod method, StabilityAxis axis, double stiffness) {
  const SimulationSettings settings = stability_cloth(method, axis, 1, stiffness);
  const System system = make_system(settings);
  if (is_explicit(method.method)) return safe_step(system);
  if (axis == StabilityAxis::push) return 2 / std::sqrt(stiffness);
  return std::sqrt(largest_condition / (condition_bound(system) - 1));
}

StabilityCell stability_cell(StepMethod method, StabilityAxis axis, double step, double stiffness, int steps) {
  const SimulationSettings settings = stability_cloth(method, axis, step, stiffness);
  StabilityCell cell{.step = step, .stiffness = stiffness};
  if (!is_explicit(method.method)) cell.outcome = StabilityOutcome::converged;
  // Potential energy of gravity and push.
  const auto potential = [&](const Energies& energies, const Vertices& x) {
    return energies.gravity + (axis == StabilityAxis::springs ? 0 : push_energy(settings.cloth, x, stiffness));
  };
  const auto blown_up = [&] {
    cell.outcome = StabilityOutcome::blown_up;
    cell.energy_error = std::numeric_limits<double>::infinity();
    return cell;
  };
  try {
    Simulation simulation(settings);
    const Energies begin = simulation.energies();
    const double had = begin.kinetic + begin.elastic, level = potential(begin, simulation.state().x);
    double moved = had, differed = 0, given = 0;
    std::stop_source enough;
    run_steps(simulation, steps, enough.get_token(), [&](const StepReport& report) {
      if (!report.converged) ++cell.not_converged;
      const Energies now = simulation.energies();
      const double has = now.kinetic + now.elastic, got = level - potential(now, simulation.state().x);
      given = std::max(given, got);
      if (!(has <= BlowUpWatch::limit_of_unstable_steps * (had + given))) enough.request_stop();
      differed = std::max(differed, std::abs(has - had - got));
      moved = std::max({moved, now.kinetic, std::abs(got), now.elastic});
    });
    if (enough.stop_requested()) return blown_up();
    cell.energy_error = moved > 0 ? differed / moved : 0;
  } catch (const DivergedError&) {
    return blown_up();
  }
  if (cell.not_converged > 0) cell.outcome = StabilityOutcome::not_converged;
  return cell;
}

double stability_border(const std::function<bool(double factor)>& blows_up) {
  double stable = 0.9, unstable = 1.5;
  if (!blows_up(unstable)) return unstable;
  while (unstable - stable > 0.002) {
    const double middle = (stable + unstable) / 2;
    (blows_up(middle) ? unstable : stable) = middle;
  }
  return stable;
}

StabilityLimit stability_border(StepMethod method, StabilityAxis axis, double stiffness) {
  StabilityLimit border{method, axis, stiffness, stability_limit(method, axis, stiffness), 0};
  border.measured = border.predicted * stability_border([&](double factor) {
                      return stability_cell(method, axis, factor * border.predicted, stiffness, 2000).outcome ==
                             StabilityOutcome::blown_up;
                    });
  return border;
}

StabilityStudy plan_stability(const StabilityDetail& detail) {
  StabilityStudy study{.detail = detail, .maps = {}, .borders = empty_borders(), .energies = energy_curves()};
  for (const StabilityAxis axis : {StabilityAxis::springs, StabilityAxis::push}) {
    for (const StepMethod method : step_methods) study.maps.push_back(empty_map(method, axis, detail));
  }
  return study;
}

std::vector<double> stability_costs(const StabilityStudy& study) {
  constexpr double border_steps = 9 * 2000, curve_vertices = 441.0 / 49;  // relative to the cloth of a map
  std::vector<double> costs;
  for (const StabilityMap& map : study.maps) {
    costs.insert(costs.end(), map.cells.size(), study.detail.steps * cost_of_step(map.method));
  }
  for (const StabilityLimit& border : study.borders) costs.push_back(border_steps * cost_of_step(border.method));
  for (const EnergyCurve& curve : study.energies) {
    costs.push_back(curve_vertices * static_cast<double>(step_count(curve)) * cost_of_step(curve.method));
  }
  return costs;
}

bool measure_stability(StabilityStudy& study, const std::vector<std::size_t>& parts, const std::stop_token& stop,
                       Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  progress.begin("measuring", "runs", static_cast<std::int64_t>(parts.size()));
  // The longest parts come last in a study; start with them, so that all threads end at about the same time.
  for_each_in_parallel(std::max(1U, std::thread::hardware_concurrency()), parts.size(), stop,
                       [&](std::size_t, std::size_t i) {
                         measure_part(study, parts[parts.size() - 1 - i], stop);
                         ++progress.done;
                       });
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return !stop.stop_requested();
}

}  // namespace drape
