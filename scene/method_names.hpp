#pragma once

// Example:
//   const auto scene = drape::load_scene("scene.toml");
//   std::puts(drape::step_method_name(scene.simulation.integrator.step_method()).c_str());  // "quasi-newton"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "sim/settings.hpp"

namespace drape {

/// Names of the methods in scenes, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> method_names{"semi-implicit", "implicit", "liu13",
                                                              "quasi-newton",  "verlet",   "auto"};
static_assert(method_names.size() == method_count + 1);

inline std::string method_name(Method method) { return std::string(method_names[static_cast<std::size_t>(method)]); }

/// Names of the schemes in scenes, in the order of the enumeration.
inline constexpr std::array<std::string_view, 2> scheme_names{"backward-euler", "sdirk2"};

inline std::string scheme_name(TimeScheme scheme) {
  return std::string(scheme_names[static_cast<std::size_t>(scheme)]);
}

/// Returns for example "verlet", "liu13", "liu13-sdirk2".
inline std::string step_method_name(StepMethod how) {
  return method_name(how.method) + (how.scheme == TimeScheme::sdirk2 ? "-sdirk2" : "");
}

/// Names of the stopping rules in scenes, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> stopping_rule_names{"change", "gradient", "error"};

inline std::string stopping_rule_name(StoppingRule rule) {
  return std::string(stopping_rule_names[static_cast<std::size_t>(rule)]);
}

}  // namespace drape
