#pragma once

#include <stop_token>

namespace drape {

/// The stop of the process: of whatever it does, and of what it would do next. A person asks for it by Ctrl-C, SIGTERM,
/// a closed terminal, or q between two steps. A second signal ends the process at once. The first call installs the
/// handlers.
std::stop_source& interruption();

/// Passes a signal on, if there was one, to interruption(): a signal's handler may set a flag and no more. To be called
/// again and again by the thread that waits for the work.
/// @returns whether a stop is requested
bool interrupted();

}  // namespace drape
