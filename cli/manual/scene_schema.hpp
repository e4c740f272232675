#pragma once

#include <string>

namespace drape {

/// Returns a JSON schema (draft 7) of scene files: every table and key with its form, limits, choices, default, unit
/// and meaning. The reader and the reference page use the same descriptions. Rules between keys are not included.
std::string scene_schema();

}  // namespace drape
