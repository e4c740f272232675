#include "check/survey_motion.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <map>

#include "check/chained_motion.hpp"
#include "check/golden.hpp"
#include "check/played_motion.hpp"
#include "check/record_motion.hpp"
#include "render/view.hpp"
#include "run/frame_sampler.hpp"
#include "run/run_steps.hpp"

namespace drape {
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
  if (!needs_motion(scene.camera)) return fixed_view(scene.camera).axes().row(2);
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
