#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Returns warnings about a valid scene, a sentence each with its place: "flag.toml:9:1: line_color: it has no effect
/// without mesh_lines". They cover keys without effect, a camera in the cloth, steps too long for the stiffness, and
/// cloth that starts inside an object.
/// @param document document of the scene
std::vector<std::string> advice_on(const Scene& scene, const TomlValue& document);

/// Explains why a run will be slow and how to speed it up; empty if it is fast. It simulates the first steps for at
/// most a second.
std::string advice_on_pace(const Scene& scene);

}  // namespace drape
