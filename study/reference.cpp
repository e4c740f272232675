#include "study/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "drape/core/error.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "output/html_writer.hpp"
#include "run/run_scene.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

constexpr std::size_t most_frames = 100, most_positions = 50'000;
constexpr double most_frames_per_second = 50;  // with shorter steps, the motion plays slower than real time

/// Returns the largest number of frames for a page, an even number.
std::size_t frames_of_page(const Scene& scene) {
  const auto vertices = static_cast<std::size_t>(std::max(1, scene.simulation.cloth.vertex_count()));
  return std::clamp<std::size_t>(most_positions / vertices, 2, most_frames) & ~std::size_t{1};
}

/// Keeps every second frame.
void thin(std::vector<Frame>& frames) {
  for (std::size_t i = 0; 2 * i < frames.size(); ++i) {
    if (i > 0) frames[i] = std::move(frames[2 * i]);
  }
  frames.resize((frames.size() + 1) / 2);
}

}  // namespace

html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames) {
  std::size_t every = 1;
  while ((frames.size() + every - 1) / every > frames_of_page(scene)) every *= 2;
  FilmInfo film;
  film.scene = scene.name;
  film.cloth = &scene.simulation.cloth;
  film.look = &scene.look;
  film.camera = &scene.camera;
  if (frames.size() > every) film.seconds_per_frame = frames[every].time - frames[0].time;
  film.fps = std::min(1 / film.seconds_per_frame, most_frames_per_second);
  MotionPacker packer(film);
  try {
    for (std::size_t i = 0; i < frames.size(); i += every) packer.add(frames[i]);
  } catch (const OutputError&) {
    return {};
  }
  return packer.finish();
}

StudyMotionRecorder::StudyMotionRecorder(const Scene& scene) : scene_(scene), most_(frames_of_page(scene)) {}

void StudyMotionRecorder::add(const Simulation& simulation) {
  if (simulation.state().step % every_ != 0) return;
  if (frames_.size() == most_) {
    thin(frames_);
    every_ *= 2;
    if (simulation.state().step % every_ != 0) return;
  }
  frames_.push_back({.index = static_cast<int>(frames_.size()),
                     .time = simulation.time(),
                     .positions = simulation.state().x,
                     .colliders = simulation.colliders(simulation.time())});
}

html::PlayedMotion StudyMotionRecorder::finish() const {
  return frames_.empty() ? html::PlayedMotion{} : pack_for_page(scene_, frames_);
}

std::optional<StudyMotion> record_study_motion(const StudyCase& what, const std::string& label,
                                               const std::stop_token& stop) {
  const Scene scene = what.load();
  StudyMotionRecorder recorder(scene);
  Simulation simulation(scene.simulation);
  recorder.add(simulation);
  try {
    run_steps(simulation, what.steps, stop, [&](const StepReport&) { recorder.add(simulation); });
  } catch (const DivergedError&) {
  }
  if (stop.stop_requested()) return std::nullopt;
  return StudyMotion{label, what.film_command("motion.html"), recorder.finish()};
}

namespace {

// Close to buckling Newton's matrix is nearly singular, and even Newton's method needs thousands of iterations.
constexpr int most_iterations = 5000;

constexpr std::array<std::string_view, 4> sudden_effects{Sphere::name, Ground::name, SelfCollision::name,
                                                         StrainLimit::name};

}  // namespace

Distance distance(const Vertices& a, const Vertices& b) {
  const Eigen::VectorXd squares = (a - b).rowwise().squaredNorm();
  return {std::sqrt(squares.maxCoeff()), std::sqrt(squares.mean())};
}

SimulationSettings to_rounding(SimulationSettings settings, Method method) {
  const System system = make_system(settings);
  const Cloth& cloth = settings.cloth;
  const StiffnessBound bound = system.stiffness_bound();
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(cloth.vertex_count());
  bound.for_each_pair([&](const Spring& spring) {
    stiffness[spring.i] += std::abs(spring.stiffness);
    stiffness[spring.j] += std::abs(spring.stiffness);
  });
  stiffness += bound.vertices;
  const double h = settings.step;
  const double amplified = 1 + h * h * (stiffness.array() / cloth.masses.array()).maxCoeff();
  const double unit = std::numeric_limits<double>::epsilon() * cloth.positions.cwiseAbs().maxCoeff();
  settings.integrator.method = method;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = unit * std::sqrt(3.0 * cloth.vertex_count()) * amplified;
  settings.integrator.max_iterations = most_iterations;
  return settings;
}

std::optional<std::int64_t> ReferenceMotion::first_beyond(double limit) const {
  const auto found = std::find_if(apart.begin(), apart.end(), [limit](double d) { return d > limit; });
  if (found == apart.end()) return std::nullopt;
  return found - apart.begin() + 1;
}

std::optional<ReferenceMotion> run_reference(const SimulationSettings& settings, std::int64_t steps,
                                             const std::vector<std::int64_t>& keep, const std::stop_token& stop,
                                             Progress& progress) {
  progress.begin("computing the reference", "steps", steps);
  Simulation newton(to_rounding(settings, Method::implicit));
  Simulation quasi_newton(to_rounding(settings, Method::quasi_newton));
  ReferenceMotion motion;
  auto next = keep.begin();
  const auto look = [&] {
    for (; next != keep.end() && *next == newton.state().step; ++next) motion.states.push_back(newton.state());
  };
  look();
  run_steps(newton, steps, stop, [&](const StepReport&) {
    quasi_newton.step();
    motion.apart.push_back(distance(newton.state().x, quasi_newton.state().x).max);
    look();
    ++progress.done;
  });
  if (stop.stop_requested()) return std::nullopt;
  return motion;
}

std::optional<std::int64_t> first_contact(const SimulationSettings& settings, std::int64_t steps, double limit,
                                          const std::stop_token& stop) {
  SimulationSettings untouched = settings;
  untouched.effects = {};
  for (const Effect& effect : settings.effects) {
    if (std::ranges::find(sudden_effects, effect.name()) == sudden_effects.end()) untouched.effects.add(effect);
  }
  if (untouched.effects.size() == settings.effects.size()) return std::nullopt;
  Simulation with(to_rounding(settings, Method::implicit)), without(to_rounding(untouched, Method::implicit));
  while (with.state().step < steps && !stop.stop_requested()) {
    with.step();
    without.step();
    if (distance(with.state().x, without.state().x).max > limit) return with.state().step;
  }
  return std::nullopt;
}

}  // namespace drape
