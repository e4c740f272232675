#include "sim/effects/effect_keys.hpp"

#include <fmt/format.h>
#include <utility>

#include "core/text.hpp"

namespace drape {

void describe_motion(Keys& keys, const std::string& place, std::optional<Eigen::Vector3d>& velocity,
                     std::optional<double>& orbit_period, Eigen::Vector3d& orbit_center, Eigen::Vector3d& orbit_axis,
                     std::vector<Keyframe>& keyframes, Interpolation& interpolation) {
  keys.add("velocity", &velocity, "m/s", "Constant velocity, starting from `" + place + "`.");
  keys.add("orbit_period", &orbit_period, "s",
           "Period of a circular orbit that starts from `" + place + "`; negative reverses it.");
  keys.add("orbit_center", &orbit_center, "m", "A point on the axis of the orbit.");
  keys.add("orbit_axis", &orbit_axis, "",
           "Direction of that axis; the motion is counterclockwise as seen from its tip.");
  keys.add("keyframes", KeyframeList{{place}, &keyframes}, "s, m", "Positions of its centre over time.");
  keys.choice("interpolation", interpolation, {"linear", "smooth"},
              "Interpolation between keyframes: at constant speed, or with continuous velocity.");
}

void check_orbit(const std::optional<double>& period, const Eigen::Vector3d& axis, const ProblemSink& problem) {
  if (period && *period == 0) problem("orbit_period", "expected a time other than 0");
  if (axis.isZero(0)) problem("orbit_axis", "expected a direction, found [0, 0, 0]");
}

void describe_friction(Keys& keys, double& friction) {
  keys.add("friction", &friction, "",
           "Coulomb's coefficient µ: what rests on a slope of tan θ ≤ µ stays there; 0 is frictionless.")
      .at_least(0);
  keys.replace("response", "contact is solved for with the step, by every method: omit it");
}

void describe_overlap(Keys& keys, bool& allow_overlap) {
  keys.add("allow_overlap", &allow_overlap, "",
           "Allows the cloth to begin inside or across it: they are separated step by step. Otherwise that is an "
           "error.");
}

void describe_obstacle(Keys& keys, double& friction, Key::Target restitution) {
  describe_friction(keys, friction);
  keys.add("restitution", std::move(restitution), "",
           "Fraction of its impact speed with which a vertex rebounds: 1 all of it, 0 none.")
      .at_least(0)
      .at_most(1);
  keys.replace("stiffness", "contact is solved for and has none: omit it");
}

void describe_cloth(Keys& keys, std::string& name) {
  keys.add("cloth", ClothName{&name}, "", "The name of the only cloth that it acts on. Default: all.");
}

void check_cloth(const std::string& name, const SimulationSettings& settings, const ProblemSink& problem) {
  if (name.empty() || find_piece(settings.cloth, name) != nullptr) return;
  std::vector<std::string> names;
  for (const ClothPiece& piece : settings.cloth.pieces) names.push_back(piece.name);
  problem("cloth", names.empty()
                       ? fmt::format("no cloth has a name, found '{}'", name)
                       : fmt::format("unknown cloth '{}'{}", name, did_you_mean(name, names, "the cloths are")));
}

void for_cloths(const Cloth& cloth, const std::string& name, const std::function<void(const Cloth&, int)>& use) {
  if (cloth.pieces.size() < 2) return use(cloth, -1);
  for (std::size_t k = 0; k < cloth.pieces.size(); ++k) {
    const ClothPiece& piece = cloth.pieces[k];
    if (name.empty() || piece.name == name) use(only_piece(cloth, piece), static_cast<int>(k));
  }
}

}  // namespace drape
