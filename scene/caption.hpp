#pragma once

#include <string>
#include <vector>

#include "drape/render/overlay/caption.hpp"
#include "drape/scene/document.hpp"
#include "drape/sim/state.hpp"
#include "scene/effects_reader.hpp"

namespace drape {

/// Returns the names of fields that vary in time: "time", "step", "energy.total".
std::vector<std::string> moment_fields();

/// Returns the value of such a field at a frame.
/// @param step simulation step [s]
FieldValue moment_value(const std::string& name, const Frame& frame, double step);

/// Returns true if a text uses energies or iteration counts, which frames carry only on request.
bool needs_motion_facts(const TextTemplate& text);

/// Fills in the constant fields of a caption's text; the time-dependent fields stay open.
/// @param text     caption text as the scene has it
/// @param fields   fields that the text can name beside moment_fields()
/// @param place    place of the text, for `problems`: unknown names and formats
TextTemplate fill_caption(const std::string& text, const std::vector<SceneField>& fields, const Place& place,
                          Problems& problems);

}  // namespace drape
