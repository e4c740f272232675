#include "check/compare_motion.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>

#include "check/golden.hpp"
#include "check/golden_motion.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/view.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"

namespace drape {

void run_chained(Simulation& simulation, std::span<const std::int64_t> starts, const RoundingUnits& quanta,
                 std::span<StepObserver* const> observers, const std::stop_token& stop) {
  for (const std::int64_t end : starts.subspan(1)) {
    run_steps(simulation, end, observers, stop);
    if (stop.stop_requested()) return;
    const RoundingUnits next = end == starts.back() ? quanta.at_end() : quanta;
    simulation.restore(rounded(simulation.state(), simulation.cloth().pins, next));
  }
  for (StepObserver* observer : observers) observer->begin(simulation);
}

namespace {

// Tolerance for energies of bit-equal states, which may differ by the order of summation.
constexpr double energy_rounding = 1e-12;

double seconds(const GoldenWindow& window, double step) {
  return step * static_cast<double>(std::max<std::size_t>(window.steps.size(), 1));
}

bool same_state(const State& a, const State& b) {
  const auto same = [](const Vertices& p, const Vertices& q) {
    return p.rows() == q.rows() &&
           std::memcmp(p.data(), q.data(), sizeof(double) * static_cast<std::size_t>(p.size())) == 0;
  };
  return same(a.x, b.x) && same(a.v, b.v);
}

/// Comparison of one window with the golden, step by step.
class Collector {
 public:
  Collector(const Golden& golden, std::size_t window, double tolerance)
      : golden_(golden), window_(golden.windows[window]), next_(golden.windows[window + 1]), tolerance_(tolerance) {
    result.first_step = window_.start.step;
    result.last_step = window_.last_step();
  }

  /// Compares the initial state of the motion.
  void begin(const State& initial) {
    if (same_state(initial, window_.start)) return add_same(initial.step);
    note_other_bits(initial.step);
    add_positions(initial.step, initial.x, window_.start.x);
    add_velocities(initial, window_.start, seconds(window_, golden_.step));
  }

  void add_step(std::int64_t step, const GoldenStep& actual, const Simulation& simulation) {
    const GoldenStep& golden = window_.steps[static_cast<std::size_t>(step - window_.start.step - 1)];
    if (actual.hash == golden.hash) return;
    note_other_bits(step);
    add_groups(step, actual.groups, golden.groups);
    const std::vector<double>& bodies = actual.bodies;
    if (bodies.size() != golden.bodies.size()) {
      return fail({.fault = WindowFault::other_bodies, .step = step, .of = {}});
    }
    std::size_t worst = 0;
    const auto distance = [&](std::size_t i) { return std::abs(bodies[i] - golden.bodies[i]); };
    for (std::size_t i = 1; i < bodies.size(); ++i) worst = distance(i) > distance(worst) ? i : worst;
    if (bodies.empty() || distance(worst) <= tolerance_ + golden_.quanta.compared) return;
    fail({.fault = WindowFault::moved_body,
          .step = step,
          .of = body_name(simulation, worst),
          .actual = distance(worst)});
  }

  void add_middle(const Vertices& x) {
    if (window_.middle.size() > 0) add_either(window_.middle_step(), x, window_.middle);
  }

  /// @param state end of the window, before rounding
  void end(const State& state, const Energies& energies) {
    if (window_.steps.empty()) return;
    add_either(state.step, state.x, next_.start.x);
    if (result.other_bits) return add_velocities(state, next_.start, golden_.step);
    add_energies(energies);
  }

  /// Stores the first problem only.
  void fail(WindowProblem problem) {
    if (!result.problem) result.problem = std::move(problem);
    result.verdict = MotionVerdict::changed;
  }

  WindowResult result;

 private:
  void note_other_bits(std::int64_t step) {
    if (!result.other_bits) result.other_bits = step;
    result.verdict =
        std::max(result.verdict, tolerance_ > 0 ? MotionVerdict::within_tolerance : MotionVerdict::changed);
  }

  void add_same(std::int64_t step) { result.deviations.push_back({.step = step, .vertex = 0, .distance = 0}); }

  void add_either(std::int64_t step, const Vertices& actual, const Vertices& golden) {
    if (result.other_bits) {
      add_positions(step, actual, golden);
    } else {
      add_same(step);
    }
  }

  /// Fails if a mean moved further than a vertex may. Goldens of format 3 have none.
  void add_groups(std::int64_t step, const std::vector<double>& actual, const std::vector<double>& golden) {
    if (actual.size() != golden.size()) return;
    double largest = 0;
    for (std::size_t k = 0; k < golden.size(); k += 3) {
      largest = std::max(
          largest, std::hypot(actual[k] - golden[k], actual[k + 1] - golden[k + 1], actual[k + 2] - golden[k + 2]));
    }
    // Rounding moves a mean by less than a quantum, the golden one and a recorded one.
    if (largest <= tolerance_ + 2 * golden_.quanta.compared) return;
    fail({.fault = WindowFault::moved_body, .step = step, .of = "the mean of some vertices", .actual = largest});
  }

  void add_positions(std::int64_t step, const Vertices& actual, const Vertices& golden) {
    Eigen::Index vertex = 0;
    const double distance = std::sqrt((actual - golden).rowwise().squaredNorm().maxCoeff(&vertex));
    const Deviation deviation{.step = step, .vertex = static_cast<int>(vertex), .distance = distance};
    result.deviations.push_back(deviation);
    if (!result.largest || distance > result.largest->distance) result.largest = deviation;
    const bool within = tolerance_ > 0 && distance <= tolerance_;
    if (!within && !result.first) result.first = deviation;
    if (!within) result.verdict = MotionVerdict::changed;
  }

  void add_velocities(const State& actual, const State& golden, double seconds) {
    Eigen::Index vertex = 0;
    const double speed = std::sqrt((actual.v - golden.v).rowwise().squaredNorm().maxCoeff(&vertex));
    if (speed == 0 || (tolerance_ > 0 && speed * seconds <= tolerance_)) return;
    fail({.fault = WindowFault::velocity,
          .step = actual.step,
          .vertex = static_cast<int>(vertex),
          .of = {},
          .actual = speed});
  }

  void add_energies(const Energies& actual) {
    const Energies& golden = window_.energies;
    const double scale = std::max({std::abs(golden.kinetic), std::abs(golden.gravity), std::abs(golden.elastic)});
    const double difference =
        std::max({std::abs(actual.kinetic - golden.kinetic), std::abs(actual.gravity - golden.gravity),
                  std::abs(actual.elastic - golden.elastic)});
    if (difference <= energy_rounding * scale) return;
    fail({.fault = WindowFault::energies,
          .step = window_.last_step(),
          .of = {},
          .actual = actual.total(),
          .golden = golden.total()});
  }

  const Golden& golden_;
  const GoldenWindow& window_;
  const GoldenWindow& next_;
  double tolerance_;
};

WindowResult compare_window(Simulation& simulation, const State& initial, const Golden& golden, std::size_t index,
                            double tolerance) {
  const GoldenWindow& window = golden.windows[index];
  Collector collector(golden, index, tolerance);
  if (index == 0) collector.begin(initial);
  simulation.restore(index == 0 ? initial : window.start);
  try {
    run_steps(simulation, window.last_step(), {}, [&](const StepReport&) {
      const State& state = simulation.state();
      collector.add_step(state.step, golden_step(simulation, golden.group_count), simulation);
      if (state.step == window.middle_step()) collector.add_middle(state.x);
    });
    collector.end(simulation.state(), simulation.energies());
  } catch (const DivergedError& diverged) {
    collector.fail({.fault = WindowFault::diverged, .of = diverged.what()});
  }
  return std::move(collector.result);
}

}  // namespace

std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const Golden& golden, double tolerance,
                                          std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done) {
  std::vector<WindowResult> results(golden.windows.size() - 1);
  std::vector<std::unique_ptr<Simulation>> simulations(threads);
  std::vector<State> initial(threads);
  for_each_in_parallel(threads, results.size(), stop, [&](std::size_t worker, std::size_t i) {
    if (!simulations[worker]) {
      simulations[worker] = std::make_unique<Simulation>(settings);
      initial[worker] = simulations[worker]->state();
    }
    results[i] = compare_window(*simulations[worker], initial[worker], golden, i, tolerance);
    done();
  });
  return results;
}

std::vector<WindowResult> compare_whole(const SimulationSettings& settings, const Golden& golden, const Golden& actual,
                                        double tolerance) {
  const Simulation simulation(settings);  // gives the names of its bodies
  std::vector<WindowResult> results;
  for (std::size_t i = 0; i + 1 < golden.windows.size(); ++i) {
    Collector collector(golden, i, tolerance);
    const GoldenWindow& window = actual.windows[i];
    if (i == 0) collector.begin(window.start);
    for (std::size_t k = 0; k < window.steps.size(); ++k) {
      const auto step = window.start.step + static_cast<std::int64_t>(k) + 1;
      collector.add_step(step, window.steps[k], simulation);
      if (step == window.middle_step()) collector.add_middle(window.middle);
    }
    collector.end(actual.windows[i + 1].start, window.energies);
    results.push_back(std::move(collector.result));
  }
  return results;
}

std::vector<WindowPositions> rerun_window(const SimulationSettings& settings, const Golden& golden, std::size_t index) {
  const GoldenWindow& window = golden.windows[index];
  Simulation simulation(settings);
  if (index > 0) simulation.restore(window.start);
  std::vector<WindowPositions> positions{{window.start.step, window.start.x, simulation.state().x}};
  try {
    run_steps(simulation, window.last_step(), {}, [&](const StepReport&) {
      const State& now = simulation.state();
      if (now.step == window.middle_step()) positions.push_back({now.step, window.middle, now.x});
      if (now.step == window.last_step()) positions.push_back({now.step, golden.windows[index + 1].start.x, now.x});
    });
  } catch (const DivergedError&) {
    // Return the steps before the divergence.
  }
  return positions;
}

std::string describe_problem(const WindowProblem& problem) {
  switch (problem.fault) {
    case WindowFault::diverged:
      return problem.of;
    case WindowFault::other_bodies:
      return fmt::format("at step {} the pins or obstacles differ", problem.step);
    case WindowFault::moved_body:
      return fmt::format("at step {} {} is {} from its golden position", problem.step, problem.of,
                         readable_length(problem.actual));
    case WindowFault::velocity:
      return fmt::format("the velocity at step {} changed by {:.3g} m/s at vertex {}", problem.step, problem.actual,
                         problem.vertex);
    case WindowFault::energies:
      return fmt::format(
          "the energies of step {} changed, the motion did not: {:.9g} J in total, {:.9g} J in the golden",
          problem.step, problem.actual, problem.golden);
  }
  return {};
}

std::string describe_motion(const std::vector<WindowResult>& windows) {
  const WindowResult* first = nullptr;
  const Deviation* largest = nullptr;
  for (const WindowResult& window : windows) {
    if (window.verdict != MotionVerdict::changed) continue;
    if (first == nullptr) first = &window;
    if (window.largest && (largest == nullptr || window.largest->distance > largest->distance)) {
      largest = &*window.largest;
    }
  }
  if (first == nullptr) return {};
  if (!first->first || largest == nullptr) {
    return first->problem ? describe_problem(*first->problem)
                          : fmt::format("the bits of the motion changed at step {}", *first->other_bits);
  }
  std::string text = fmt::format("the motion changed at step {} by {} at vertex {}", first->first->step,
                                 readable_length(first->first->distance), first->first->vertex);
  if (*first->other_bits < first->first->step) text += fmt::format(" (bits differ from step {})", *first->other_bits);
  if (largest->step != first->first->step) {
    text += fmt::format(", and by up to {} at vertex {} at step {}", readable_length(largest->distance),
                        largest->vertex, largest->step);
  }
  if (first->problem) text += "; " + describe_problem(*first->problem);
  return text;
}

void PlayedMotion::require_every_step(const LoadedScene& scene) const {
  const auto states = static_cast<std::int64_t>(reader_.states());
  if (reader_.last_step() != scene.step_count()) {
    throw UsageError(fmt::format("{}: it ends after step {}, its scene after step {}: record it without --steps",
                                 shown(scene.source.file), reader_.last_step(), scene.step_count()));
  }
  if (states == scene.step_count() + 1) return;
  throw UsageError(
      fmt::format("{}: it has {} states of {} steps, and a check needs all: give the frames' rate with fps, or record "
                  "the motion with --every 1",
                  shown(scene.source.file), states, scene.step_count()));
}

State PlayedMotion::state(std::int64_t step) {
  State state = reader_.state(static_cast<std::size_t>(step));
  if (order_.empty()) return state;
  state.x = in_order(state.x, order_);
  state.v = in_order(state.v, order_);
  return state;
}

void play_chained(PlayedMotion& motion, Simulation& simulation, std::span<const std::int64_t> starts,
                  const RoundingUnits& quanta, std::span<StepObserver* const> observers, const std::stop_token& stop) {
  simulation.restore(motion.state(0));
  std::int64_t step = 0;
  for (const std::int64_t end : starts.subspan(1)) {
    for (StepObserver* observer : observers) observer->begin(simulation);
    while (step < end) {
      if (stop.stop_requested()) return;
      simulation.restore(motion.state(++step));
      for (StepObserver* observer : observers) observer->after_step(simulation, {}, 0);
    }
    const RoundingUnits next = end == starts.back() ? quanta.at_end() : quanta;
    simulation.restore(rounded(simulation.state(), simulation.cloth().pins, next));
  }
  for (StepObserver* observer : observers) observer->begin(simulation);
}

std::vector<WindowPositions> played_window(PlayedMotion& motion, const Golden& golden, std::size_t index) {
  const GoldenWindow& window = golden.windows[index];
  std::vector<WindowPositions> positions;
  const auto add = [&](std::int64_t step, const Vertices& x) { positions.push_back({step, x, motion.state(step).x}); };
  add(window.start.step, window.start.x);
  if (window.middle.size() > 0) add(window.middle_step(), window.middle);
  add(window.last_step(), golden.windows[index + 1].start.x);
  return positions;
}

namespace {

constexpr std::size_t most_bodies = 64;  // bits in FrameProperties::touched

/// Returns "the sphere", or "sphere 2" if there are several.
std::vector<std::string> names_of(const std::vector<Collider>& colliders) {
  std::map<std::string, int> count;
  for (const Collider& collider : colliders) ++count[body_kind(collider)];
  std::vector<std::string> names;
  for (const Collider& collider : colliders) {
    const std::string kind = body_kind(collider);
    names.push_back(count[kind] == 1 ? "the " + kind : fmt::format("{} {}", kind, names.size() + 1));
  }
  names.resize(std::min(names.size(), most_bodies));
  return names;
}

/// Returns true if a vertex is within a body's range of contact, or in the bounding box of a mesh.
bool touches(const Vertices& x, const Collider& collider) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
    const double reach = std::max(sphere->reach, sphere->radius);
    return (x.rowwise() - sphere->center.transpose()).rowwise().squaredNorm().minCoeff() < reach * reach;
  }
  if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
    const Eigen::Array3d low = mesh->positions.colwise().minCoeff().transpose();
    const Eigen::Array3d high = mesh->positions.colwise().maxCoeff().transpose();
    const auto within = [&](const auto& p) { return (p.array() >= low).all() && (p.array() <= high).all(); };
    return std::ranges::any_of(x.rowwise(), [&](const auto& row) { return within(row.transpose().eval()); });
  }
  const auto& ground = std::get<GroundShape>(collider);
  return (x * ground.normal).minCoeff() < ground.height + ground.thickness;
}

/// Returns the direction towards the camera; one that follows the motion is placed for the start.
Eigen::Vector3d towards_camera(const Scene& scene) {
  if (!needs_motion(scene.camera)) return fixed_view(scene.camera, scene.simulation.cloth.positions).axes().row(2);
  Framing framing(scene.camera, static_cast<double>(scene.video.size.x()) / scene.video.size.y());
  framing.add(scene.simulation.cloth.positions);
  return framing.view().axes().row(2);
}

class Surveyor {
 public:
  Surveyor(const Scene& scene, const Simulation& simulation)
      : simulation_(simulation), triangles_(scene.simulation.cloth.triangles), towards_(towards_camera(scene)) {}

  void see(const Frame& frame) {
    FrameProperties facts;
    for (std::size_t k = 0; k < std::min(frame.colliders.size(), most_bodies); ++k) {
      facts.touched |= std::uint64_t{touches(frame.positions, frame.colliders[k])} << k;
    }
    facts.pins = simulation_.cloth().pins.size();
    const Energies energies = simulation_.energies();
    facts.kinetic = energies.kinetic;
    facts.elastic = energies.elastic;
    facts.area = area(frame.positions);
    if (before_.size() > 0) {
      const Vertices way = frame.positions - before_;
      facts.change = (way - (way * towards_) * towards_.transpose()).rowwise().norm().sum();
    }
    before_ = frame.positions;
    film.frames.push_back(facts);
  }

  FilmFacts film;

 private:
  [[nodiscard]] double area(const Vertices& x) const {
    double sum = 0;
    for (const Triangle& t : triangles_) {
      const Eigen::Vector3d ab = x.row(t[1]) - x.row(t[0]), ac = x.row(t[2]) - x.row(t[0]);
      sum += std::abs(towards_.dot(ab.cross(ac))) / 2;
    }
    return sum;
  }

  const Simulation& simulation_;
  const std::vector<Triangle>& triangles_;
  Eigen::Vector3d towards_;
  Vertices before_;
};

}  // namespace

std::optional<FilmFacts> survey_motion(const Scene& scene, std::int64_t window_steps, const RoundingUnits& quanta,
                                       const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  Simulation simulation(scene.simulation);
  Surveyor surveyor(scene, simulation);
  surveyor.film.bodies = names_of(simulation.colliders(0));
  const FilmExtent film(scene.video, scene.simulation.step, scene.step_count(), std::nullopt);
  FrameSampler sampler(film, [&](const Frame& frame) { surveyor.see(frame); });
  StepCounter counter(progress);
  progress.begin("choosing frames", "steps", film.steps);
  const std::array<StepObserver*, 2> observers{&sampler, &counter};
  const std::vector<std::int64_t> starts = window_starts(film.steps, window_steps);
  if (recorded != nullptr) {
    play_chained(*recorded, simulation, starts, quanta, observers, stop);
  } else {
    run_chained(simulation, starts, quanta, observers, stop);
  }
  if (stop.stop_requested()) return std::nullopt;
  return std::move(surveyor.film);
}

}  // namespace drape
