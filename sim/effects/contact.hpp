#pragma once

#include "core/keys.hpp"

namespace drape {

/// Adds the key `friction` of anything that the cloth touches, and advice for keys of former versions.
void describe_friction(Keys& keys, double& friction);

/// Adds the key `allow_overlap`.
void describe_overlap(Keys& keys, bool& allow_overlap);

/// Adds the keys of an obstacle: `friction` and `restitution`.
/// @param restitution target of that key, a number or an optional one
void describe_obstacle(Keys& keys, double& friction, Key::Target restitution);

}  // namespace drape
