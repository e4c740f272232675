#pragma once

#include <functional>
#include <stop_token>

#include "run/progress.hpp"

namespace drape {

/// Does work on a thread of its own while this one shows its progress and listens for signals. The token is that of
/// interruption().
/// @param quiet no progress is shown
/// @returns whether it was interrupted
/// @throws what the work throws
bool run_watched(bool quiet, const std::function<void(const std::stop_token&, Progress&)>& work);

}  // namespace drape
