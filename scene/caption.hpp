#pragma once

#include <string>
#include <vector>

#include "overlay/settings.hpp"
#include "scene/document.hpp"
#include "scene/fields.hpp"
#include "scene/problems.hpp"
#include "sim/frame.hpp"

namespace drape {

/// The names of what changes with time: "time", "step", "energy.total".
std::vector<std::string> moment_fields();

/// What such a name stands for at a frame.
/// @param step of the simulation [s]
FieldValue moment_value(const std::string& name, const Frame& frame, double step);

/// Whether a text says something of the energies or iterations, which frames only have when they are asked for.
bool needs_motion_facts(const TextTemplate& text);

/// Makes a caption's text into one in which what stays the same is filled in.
/// @param text     of the caption, as the scene has it
/// @param fields   that it can name beside moment_fields()
/// @param place    where it is written, for what is added to `problems`: unknown names and formats
TextTemplate fill_caption(const std::string& text, const std::vector<SceneField>& fields, const Place& place,
                          Problems& problems);

}  // namespace drape
