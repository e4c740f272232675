#include "study/stability.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/simulation.hpp"
#include "run/run_scene.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "study/runs_file.hpp"
#include "study/stability_map.hpp"

namespace drape {
namespace {

constexpr double duration = 8, sample_interval = 0.1;  // [s]

SimulationSettings swinging_cloth(StepMethod method, double step) {
  const Mesh mesh = make_grid(20, 20);
  SimulationSettings settings;
  settings.cloth = make_cloth(mesh, mesh, 1, 180, {0, 20});
  settings.step = step;
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-6;
  settings.integrator.max_iterations = 5000;
  settings.effects.add(Gravity{});
  return settings;
}

/// Observer that stores the energy every `every` steps.
class EnergySamples final : public StepObserver {
 public:
  EnergySamples(std::int64_t every, EnergyCurve& curve) : every_(every), curve_(curve) {}

  void begin(const Simulation& simulation) override {
    first_ = simulation.energies().total();
    keep(simulation);
  }
  void after_step(const Simulation& simulation, const StepReport&, double) override { keep(simulation); }

  /// Divides the curve by the largest drop of gravity's energy.
  void finish() {
    for (double& energy : curve_.energies) energy /= moved_;
  }

 private:
  void keep(const Simulation& simulation) {
    const Energies now = simulation.energies();
    moved_ = std::max(moved_, -now.gravity);  // it is 0 at the start
    if (simulation.state().step % every_ != 0) return;
    curve_.times.push_back(simulation.time());
    curve_.energies.push_back(now.total() - first_);
  }

  std::int64_t every_;
  EnergyCurve& curve_;
  double first_ = 0, moved_ = 0;
};

/// Returns the curves to measure: eight seconds of the homework's cloth, undamped, with springs of 180 N/m, hung from
/// two corners. Methods: velocity Verlet, and backward Euler and SDIRK2 with a long and a short step.
std::vector<EnergyCurve> energy_curves() {
  constexpr StepMethod sdirk2(Method::quasi_newton, TimeScheme::sdirk2);
  return {{.method = Method::verlet, .step = 0.001},
          {.method = sdirk2, .step = 0.0025},
          {.method = sdirk2, .step = 0.02},
          {.method = Method::quasi_newton, .step = 0.0025},
          {.method = Method::quasi_newton, .step = 0.02}};
}

/// Returns the number of steps of a curve.
std::int64_t step_count(const EnergyCurve& curve) { return std::llround(duration / curve.step); }

/// Measures a curve. A stopped curve is invalid.
void measure_energy(EnergyCurve& curve, const std::stop_token& stop) {
  Simulation simulation(swinging_cloth(curve.method, curve.step));
  EnergySamples samples(std::llround(sample_interval / curve.step), curve);
  StepObserver* const observer = &samples;
  run_steps(simulation, step_count(curve), {&observer, 1}, stop);
  samples.finish();
}

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
    for (const StepMethod method : step_methods) {
      if (is_explicit(method.method)) borders.push_back({method, StabilityAxis::springs, stiffness});
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

namespace {

/// The measurements of a shard in one map.
struct MapRuns {
  std::vector<std::int64_t> cells;  // indices in the map
  std::vector<int> outcomes, not_converged;
  std::vector<double> energy_errors;
};

// The fields, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.

template <class Fields, class Runs>
void describe_map(Fields& f, Runs& runs) {
  f("cell", runs.cells);
  f("outcome", runs.outcomes);
  f("energy_error", runs.energy_errors);
  f("steps_not_converged", runs.not_converged);
}

template <class Fields, class Border>
void describe_border(Fields& f, Border& border) {
  f("predicted", border.predicted);
  f("measured", border.measured);
}

template <class Fields, class Curve>
void describe_curve(Fields& f, Curve& curve) {
  f("time", curve.times);
  f("energy", curve.energies);
}

/// The heading of a file.
struct Heading {
  std::string program, shard;
  StabilityDetail detail;
  double seconds = 0;
};

template <class Fields, class Values>
void describe_heading(Fields& f, Values& heading) {
  f("program", heading.program);
  f("shard", heading.shard);
  f("per_decade", heading.detail.per_decade);
  f("steps", heading.detail.steps);
  f("seconds", heading.seconds);
}

std::string studying_program() {
  const BuildInfo& build = build_info();
  return fmt::format("drape {}, revision {}, {}, {}", build.version, build.revision, build.compiler, build.type);
}

RunsKey key_of(const StabilityMap& map) { return {map_name(map), "map", {}, {}, {}}; }
RunsKey key_of(const StabilityLimit& border, std::size_t place) {
  return {{}, "border", step_method_name(border.method), {}, std::to_string(place)};
}
RunsKey key_of(const EnergyCurve& curve, std::size_t place) {
  return {{}, "energy", step_method_name(curve.method), {}, std::to_string(place)};
}

MapRuns runs_of(const StabilityMap& map, const std::set<std::size_t>& parts, std::size_t first) {
  MapRuns runs;
  for (auto part = parts.lower_bound(first); part != parts.end() && *part < first + map.cells.size(); ++part) {
    const StabilityCell& cell = map.cells[*part - first];
    runs.cells.push_back(static_cast<std::int64_t>(*part - first));
    runs.outcomes.push_back(static_cast<int>(cell.outcome));
    runs.not_converged.push_back(cell.not_converged);
    runs.energy_errors.push_back(cell.energy_error);
  }
  return runs;
}

/// Copies a record's cells into a map.
void read_map(RunsRecord& record, StabilityMap& map) {
  MapRuns runs;
  describe_map(record, runs);
  const std::size_t count = runs.cells.size();
  if (runs.outcomes.size() != count || runs.not_converged.size() != count || runs.energy_errors.size() != count) {
    record.fail(record.line(), "of some cells not everything is there");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(runs.cells[i]);
    if (place >= map.cells.size()) record.fail(record.line(), fmt::format("there is no cell {}", runs.cells[i]));
    if (runs.outcomes[i] < 0 || runs.outcomes[i] > static_cast<int>(StabilityOutcome::blown_up)) {
      record.fail(record.line(), fmt::format("there is no outcome {}", runs.outcomes[i]));
    }
    map.cells[place] = {.step = map.steps[place % map.steps.size()],
                        .stiffness = map.stiffnesses[place / map.steps.size()],
                        .outcome = static_cast<StabilityOutcome>(runs.outcomes[i]),
                        .energy_error = runs.energy_errors[i],
                        .not_converged = runs.not_converged[i]};
  }
}

/// Copies a record into its part of a study.
void read_part(RunsRecord& record, StabilityStudy& study) {
  for (StabilityMap& map : study.maps) {
    if (record.key == key_of(map)) return read_map(record, map);
  }
  for (std::size_t i = 0; i < study.borders.size(); ++i) {
    if (record.key == key_of(study.borders[i], i)) return describe_border(record, study.borders[i]);
  }
  for (std::size_t i = 0; i < study.energies.size(); ++i) {
    if (record.key == key_of(study.energies[i], i)) return describe_curve(record, study.energies[i]);
  }
  record.fail(record.line(), fmt::format("a study of stability has no {} {}", record.key.kind, record.key.scene));
}

}  // namespace

std::vector<std::size_t> parts_of_shard(const StabilityStudy& study, const Shard& shard) {
  return runs_of_shard(stability_costs(study), shard);
}

std::string stability_runs(const StabilityStudy& study, const Shard& shard) {
  const std::vector<std::size_t> list = parts_of_shard(study, shard);
  const std::set<std::size_t> parts(list.begin(), list.end());
  RunsWriter file;
  const Heading heading{studying_program(), shard.text(), study.detail, study.seconds};
  file.begin({{}, "study", {}, {}, {}});
  describe_heading(file, heading);
  std::size_t part = 0;
  for (const StabilityMap& map : study.maps) {
    const MapRuns runs = runs_of(map, parts, part);
    file.begin(key_of(map));
    describe_map(file, runs);
    part += map.cells.size();
  }
  for (std::size_t i = 0; i < study.borders.size(); ++i, ++part) {
    if (!parts.contains(part)) continue;
    file.begin(key_of(study.borders[i], i));
    describe_border(file, study.borders[i]);
  }
  for (std::size_t i = 0; i < study.energies.size(); ++i, ++part) {
    if (!parts.contains(part)) continue;
    file.begin(key_of(study.energies[i], i));
    describe_curve(file, study.energies[i]);
  }
  return file.finish();
}

MergedStability merge_stability(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t most_bytes = std::size_t{1} << 31;
  MergedStability merged;
  FoundShards found("study");
  for (const std::filesystem::path& path : files) {
    std::vector<RunsRecord> records = parse_runs(read_text(path, most_bytes), shown(path));
    if (records.empty()) throw UsageError(fmt::format("{}: there is nothing in it", shown(path)));
    Heading heading;
    describe_heading(records.front(), heading);
    const Shard shard = parse_shard(heading.shard);
    if (heading.program != studying_program()) {
      throw UsageError(fmt::format("{} was made by {}, but this is {}: one study is made by one program", shown(path),
                                   heading.program, studying_program()));
    }
    if (found.empty()) merged.study = plan_stability(heading.detail);
    if (heading.detail != merged.study.detail) found.fail_as_other(path);
    if (!found.add(shard, path)) continue;
    merged.study.seconds += heading.seconds;
    for (std::size_t i = 1; i < records.size(); ++i) read_part(records[i], merged.study);
    for (const RunsRecord& record : records) record.done();
  }
  merged.missing = found.missing();
  return merged;
}

}  // namespace drape
