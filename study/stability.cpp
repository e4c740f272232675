#include "study/stability.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "core/parallel.hpp"
#include "sim/effects/gravity.hpp"
#include "sim/effects/sphere.hpp"
#include "sim/simulation.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr double spring_stiffness = 180;                   // where the push is varied [N/m]
constexpr double sphere_reach = 0.44;                      // 1.1 · 0.4 m
const Eigen::Vector3d sphere_center(0, 0, -sphere_reach);  // the cloth touches it at the start

/// A sphere as the homework has it, which pushes with this stiffness [1/s²].
ActiveEffect sphere(double stiffness, bool implicit) {
  std::shared_ptr<Effect> effect = make_sphere();
  Keys keys;
  effect->describe(keys);
  for (const Key& key : keys.all()) {
    if (key.name == "center") *std::get<std::optional<Eigen::Vector3d>*>(key.target) = sphere_center;
    if (key.name == "radius") *std::get<std::optional<double>*>(key.target) = 0.4;
    if (key.name == "stiffness") *std::get<double*>(key.target) = stiffness;
    if (key.name == "response") std::get<Choice>(key.target).set(implicit ? 1 : 0);
  }
  return {"sphere", effect};
}

/// What the sphere's push holds, Σ m·stiffness/2·depth² [J].
double push_energy(const Cloth& cloth, const Vertices& x, double stiffness) {
  double sum = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const double depth = sphere_reach - (x.row(i).transpose() - sphere_center).norm();
    if (depth > 0) sum += 0.5 * cloth.masses[i] * stiffness * depth * depth;
  }
  return sum;
}

SimulationSettings settings_of(Method method, StabilityAxis axis, double step, double stiffness) {
  SimulationSettings settings =
      stability_cloth(method, step, axis == StabilityAxis::springs ? stiffness : spring_stiffness);
  if (axis != StabilityAxis::springs) {
    settings.effects.push_back(sphere(stiffness, axis == StabilityAxis::implicit_push));
  }
  return settings;
}

std::vector<double> decades(double from, double to, int per_decade) {
  std::vector<double> values;
  const int count = static_cast<int>(std::lround(std::log10(to / from) * per_decade));
  for (int i = 0; i <= count; ++i) values.push_back(from * std::pow(10.0, static_cast<double>(i) / per_decade));
  return values;
}

/// The largest step that is predicted to be possible.
double predicted_limit(Method method, StabilityAxis axis, double stiffness) {
  const SimulationSettings settings = settings_of(method, axis, 1, stiffness);
  const System system = make_system(settings);
  if (method == Method::semi_implicit) return safe_step(system);
  if (axis == StabilityAxis::explicit_push) return 2 / std::sqrt(stiffness);
  return std::sqrt(largest_condition / (condition_bound(system) - 1));
}

StabilityMap empty_map(Method method, StabilityAxis axis, const StabilityDetail& detail) {
  StabilityMap map;
  map.method = method;
  map.axis = axis;
  map.steps = decades(1e-5, 1, detail.per_decade);
  map.stiffnesses =
      axis == StabilityAxis::springs ? decades(1e-2, 1e9, detail.per_decade) : decades(1, 1e9, detail.per_decade);
  for (const double stiffness : map.stiffnesses) map.limits.push_back(predicted_limit(method, axis, stiffness));
  map.limit_name = method == Method::semi_implicit        ? "safe step"
                   : axis == StabilityAxis::explicit_push ? "step·√stiffness = 2"
                                                          : "condition 1e14";
  map.cells.resize(map.steps.size() * map.stiffnesses.size());
  return map;
}

}  // namespace

const char* outcome_name(StabilityOutcome outcome) {
  constexpr const char* names[] = {"stable", "converged", "not converged", "blown up"};
  return names[static_cast<std::size_t>(outcome)];
}

SimulationSettings stability_cloth(Method method, double step, double stiffness) {
  const Mesh mesh = make_grid(6, 6);
  SimulationSettings settings;
  settings.cloth = make_cloth(mesh, mesh, 1, stiffness, {0, 6});
  settings.step = step;
  settings.integrator.method = method;
  settings.integrator.allow_unstable = true;
  settings.integrator.tolerance = 1e-6;
  settings.effects.push_back({"gravity", std::shared_ptr<Effect>(make_gravity())});
  return settings;
}

StabilityCell stability_cell(Method method, StabilityAxis axis, double step, double stiffness, int steps) {
  const SimulationSettings settings = settings_of(method, axis, step, stiffness);
  StabilityCell cell{.step = step, .stiffness = stiffness};
  if (method != Method::semi_implicit) cell.outcome = StabilityOutcome::converged;
  const auto total = [&](const Simulation& simulation) {
    const double push =
        axis == StabilityAxis::springs ? 0 : push_energy(settings.cloth, simulation.state().x, stiffness);
    return simulation.energies().total() + push;
  };
  try {
    Simulation simulation(settings);
    const double begin = total(simulation), level = simulation.energies().gravity;
    double moved = 0, differed = 0, given = 1e-12;
    for (int step_number = 0; step_number < steps; ++step_number) {
      if (!simulation.step().converged) ++cell.not_converged;
      const Energies now = simulation.energies();
      const double after = total(simulation);
      given = std::max(given, std::abs(now.gravity - level));
      if (!(after - begin <= BlowUpWatch::limit * given)) throw DivergedError("more energy than gravity gave");
      differed = std::max(differed, std::abs(after - begin));
      moved = std::max({moved, now.kinetic, given, now.elastic});
    }
    cell.energy_error = moved > 0 ? differed / moved : 0;
  } catch (const DivergedError&) {
    cell.outcome = StabilityOutcome::blown_up;
    cell.energy_error = std::numeric_limits<double>::infinity();
    return cell;
  }
  if (cell.not_converged > 0) cell.outcome = StabilityOutcome::not_converged;
  return cell;
}

StabilityBorder stability_border(double stiffness) {
  SimulationSettings settings = stability_cloth(Method::semi_implicit, 1, stiffness);
  StabilityBorder border{.stiffness = stiffness, .predicted = safe_step(make_system(settings))};
  const auto blows_up = [&](double factor) {
    settings.step = factor * border.predicted;
    Simulation simulation(settings);
    try {
      for (int step = 0; step < 2000; ++step) simulation.step();
    } catch (const DivergedError&) {
      return true;
    }
    return false;
  };
  double stable = 0.9, unstable = 1.5;
  while (unstable - stable > 0.005) {
    const double middle = (stable + unstable) / 2;
    (blows_up(middle) ? unstable : stable) = middle;
  }
  border.measured = stable * border.predicted;
  return border;
}

std::optional<StabilityStudy> study_stability(const StabilityDetail& detail, const std::stop_token& stop,
                                              Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  StabilityStudy study;
  study.steps = detail.steps;
  for (const StabilityAxis axis :
       {StabilityAxis::springs, StabilityAxis::explicit_push, StabilityAxis::implicit_push}) {
    for (const Method method : {Method::semi_implicit, Method::implicit, Method::liu13, Method::quasi_newton}) {
      if (method == Method::semi_implicit && axis == StabilityAxis::implicit_push) continue;
      study.maps.push_back(empty_map(method, axis, detail));
    }
  }
  std::size_t cells = 0;
  for (const StabilityMap& map : study.maps) cells += map.cells.size();
  progress.begin("measuring", "runs", static_cast<std::int64_t>(cells));
  const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  for (StabilityMap& map : study.maps) {
    const std::size_t columns = map.steps.size();
    for_each_in_parallel(threads, map.cells.size(), stop, [&](std::size_t, std::size_t i) {
      map.cells[i] =
          stability_cell(map.method, map.axis, map.steps[i % columns], map.stiffnesses[i / columns], detail.steps);
      ++progress.done;
    });
    if (stop.stop_requested()) return std::nullopt;
  }
  for (const double stiffness : {1e-2, 1.0, 1e2, 1e4, 1e6, 1e8}) study.borders.push_back(stability_border(stiffness));
  study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return study;
}

}  // namespace drape
