#pragma once

#include "core/keys.hpp"

namespace drape {

/// Adds the keys of what the cloth touches: `friction`, and the advice for those that there were.
void describe_friction(Keys& keys, double& friction);

/// Adds the keys of an obstacle: `friction` and `restitution`.
/// @param restitution number that it sets, or optional one
void describe_obstacle(Keys& keys, double& friction, Key::Target restitution);

}  // namespace drape
