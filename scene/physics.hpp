#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// Returns every value of a scene that affects the motion, key by key. A key that is left out equals its default.
/// Camera, look, film and duration are not included. Long values (a mesh, a track) are hashed.
std::vector<SceneValue> physics_values(const Scene& scene);

/// Computes a hash of these values: 16 hexadecimal digits.
std::string physics_hash(const std::vector<SceneValue>& values);

/// Describes the differences, a line for each key: "cloth.mass: 1, and 2 in look.toml".
/// @param name name of the source of `b`
std::string physics_difference(const std::vector<SceneValue>& a, const std::vector<SceneValue>& b,
                               const std::string& name);

struct TableType;
struct ReadEffect;

/// Returns the part of physics_values() that tables contain.
/// @param folder folder of the files that effects name
std::vector<SceneValue> physics_of_tables(const std::vector<TableType>& tables, const std::vector<ReadEffect>& effects,
                                          const std::filesystem::path& folder);

}  // namespace drape
