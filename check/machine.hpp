#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "check/report.hpp"

namespace drape {

/// The machine that this runs on.
/// @param renderer what draws, see Renderer::description()
Machine this_machine(std::string renderer);

/// As it is written into a golden's manifest and into report.json.
nlohmann::ordered_json to_json(const Machine& machine);

/// The moment, as "2026-01-31T12:00:00Z".
std::string utc_now();

}  // namespace drape
