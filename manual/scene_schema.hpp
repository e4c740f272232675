#pragma once

#include <string>

namespace drape {

/// A JSON schema (draft 7) of scene files: every table and key with its form, limits, choices, default, unit and
/// meaning, made from the same descriptions as the reader and the reference page. Rules between keys are not in it.
std::string scene_schema();

}  // namespace drape
