#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns a description of this machine.
/// @param renderer see Renderer::description()
Machine this_machine(std::string renderer);

/// Returns the JSON for a golden's manifest and for report.json.
nlohmann::ordered_json to_json(const Machine& machine);

/// Returns the current time as "2026-01-31T12:00:00Z".
std::string utc_now();

}  // namespace drape
