#include "bench/ratio_table.hpp"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

#include "bench/moving_cloth.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/pressure.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "drape/sim/simulation.hpp"

namespace drape {
namespace {

constexpr int steps = 10;
constexpr double step = 0.01;  // [s]

/// An effect on a cloth of `cells`×`cells` cells, or the seams of that cloth.
struct Case {
  std::string name;
  std::optional<Effect> effect;
  Cloth (*cloth)(int cells);
};

/// Makes the cushion of make_cushion() with a shape that changes in every step.
Body make_breathing_cushion() {
  Body body = make_cushion();
  MeshMotion motion = *body.mesh;
  motion.times = {0, 100};
  motion.samples = {motion.mesh.positions, 1.01 * motion.mesh.positions};
  body.mesh = std::make_shared<MeshMotion>(std::move(motion));
  return body;
}

std::vector<Case> cases() {
  const Sphere sphere{.center = Eigen::Vector3d(0, 0, -0.5), .radius = 0.4};
  Sphere contact = sphere;
  contact.thickness = 0.04;
  return {
      {"bending_rigidity", Bending{.rigidity = 1e-3}, make_moving_cloth},
      {"bending_cross", Bending{.cross_stiffness = 10}, make_moving_cloth},
      {"internal_damping", InternalDamping{.relaxation_time = 0.01}, make_moving_cloth},
      {"sphere", sphere, make_moving_cloth},
      {"sphere_contact", contact, make_moving_cloth},
      {"wind", Wind{.acceleration = {1, 0, 0}}, make_moving_cloth},
      {"air", Air{}, make_moving_cloth},
      {"ground", Ground{.height = -1}, make_moving_cloth},
      {"body", make_cushion(), make_lying_cloth},
      {"body_deforming", make_breathing_cushion(), make_lying_cloth},
      {"body_far_away", Body{.box = Eigen::Vector3d(1, 1, 1), .center = Eigen::Vector3d(0, 0, -9)}, make_moving_cloth},
      {"strain_limit", StrainLimit{.max_stretch = 1.1}, make_moving_cloth},
      {"pressure", Pressure{.pressure = 10}, make_pillow},
      {"seam", std::nullopt, make_sewn_cloth},
      {"self_collision_at_rest", SelfCollision{.thickness = 0.012}, make_resting_cloth},
      {"self_collision", SelfCollision{.thickness = 0.012}, make_moving_cloth},
      {"self_collision_folded", SelfCollision{.thickness = 0.012}, make_folded_cloth},
  };
}

Subject make(const Case& c, int cells, bool with) {
  SimulationSettings settings;
  settings.cloth = c.cloth(cells);
  settings.step = step;
  settings.integrator.method = Method::liu13;
  settings.integrator.tolerance = 1e-3;
  settings.effects = {Gravity{}};
  if (with && c.effect) settings.effects.add(*c.effect);
  if (!with) settings.cloth.seams.clear();
  const auto simulation = std::make_shared<Simulation>(std::move(settings));
  return {.restore = [simulation, start = simulation->state()] { simulation->restore(start); },
          .run =
              [simulation] {
                for (int i = 0; i < steps; ++i) simulation->step();
                return steps;
              }};
}

}  // namespace

std::vector<std::string> register_effect_costs() {
  std::vector<std::string> names;
  for (const Case& c : cases()) {
    for (const int cells : c.name.starts_with("body") ? std::vector{20, 60, 100} : std::vector{20, 60}) {
      names.push_back(fmt::format("effect_{}/{}", c.name, cells));
      for (const bool with : {true, false}) {
        register_subject(names.back(), with ? "with" : "without", steps,
                         [c, cells, with] { return make(c, cells, with); });
      }
    }
  }
  return names;
}

}  // namespace drape
