#pragma once

#include <stop_token>

namespace drape {

/// Returns the stop source of the process, for current and later work. Ctrl-C, SIGTERM, a closed terminal, or q between
/// two steps request a stop. A dedicated thread forwards signals at once, because a handler may only wake it. A second
/// signal ends the process. The first call installs the handlers.
std::stop_source& interruption();

}  // namespace drape
