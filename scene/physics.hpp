#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// Everything in a scene that a motion depends on, key by key, as it holds in the end: left out and given as its
/// default, a key is the same. Where the camera is, what things look like, the film and how long the motion is are not
/// among it. What is long (a mesh, a track) is there as a hash.
std::vector<SceneValue> physics_values(const Scene& scene);

/// A hash of that: 16 hexadecimal digits.
std::string physics_hash(const std::vector<SceneValue>& values);

/// A line for each key that differs: "cloth.mass: 1, and 2 in look.toml".
/// @param name of what `b` is from
std::string physics_difference(const std::vector<SceneValue>& a, const std::vector<SceneValue>& b,
                               const std::string& name);

struct TableType;
struct ReadEffect;

/// The part of physics_values() that tables say.
/// @param folder where the files are that effects name
std::vector<SceneValue> physics_of_tables(const std::vector<TableType>& tables, const std::vector<ReadEffect>& effects,
                                          const std::filesystem::path& folder);

}  // namespace drape
