#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What may not be meant in a scene that can be simulated, a sentence each, with its place: "flag.toml:9:1: line_color:
/// it has no effect without mesh_lines". Keys without effect, a camera in the cloth, steps that are long for the
/// stiffness, cloth that starts inside of something.
/// @param document that the scene was read from
std::vector<std::string> advice_on(const Scene& scene, const TomlValue& document);

/// Why a scene's run will take long, and what would be faster; empty if it will not. Simulates its first steps, for a
/// second at most.
std::string advice_on_pace(const Scene& scene);

}  // namespace drape
