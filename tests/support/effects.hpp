#pragma once

#include <Eigen/Core>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/settings.hpp"

namespace drape::test {

/// Keyframes as a scene writes them, {"position", {{0, {0, 0, 0}}, …}}.
struct KeyframesValue {
  std::string name;
  std::vector<Keyframe> keyframes;
};

/// The value of a key of an effect's table.
using KeyValue = std::variant<bool, int, double, Eigen::Vector3d, std::string, KeyframesValue, std::vector<int>,
                              std::shared_ptr<const SphereTrack>>;
using KeyValues = std::vector<std::pair<std::string_view, KeyValue>>;

/// An effect as a scene's table [effects.NAME] with these keys makes it.
/// @throws std::invalid_argument for an unknown effect or key, a value of another type, or a missing required key
ActiveEffect effect(std::string_view name, const KeyValues& values = {});

/// What Effect::check says about an effect in these settings: one "key: sentence" for each problem.
std::vector<std::string> problems(const ActiveEffect& active, const SimulationSettings& settings);

}  // namespace drape::test
