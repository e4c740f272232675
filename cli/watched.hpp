#pragma once

#include <functional>
#include <stop_token>

#include "cli/command_line.hpp"
#include "run/progress.hpp"

namespace drape {

/// Does work on a thread of its own while this one shows its progress and listens for an interruption, which becomes a
/// request to stop.
/// @returns whether it was interrupted
/// @throws what the work throws
bool run_watched(const CommonOptions& common, const std::function<void(const std::stop_token&, Progress&)>& work);

}  // namespace drape
