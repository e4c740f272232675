#pragma once

#include <stop_token>

namespace drape {

/// The stop of the process: of whatever it does, and of what it would do next. A person asks for it by Ctrl-C, SIGTERM,
/// a closed terminal, or q between two steps. A signal is passed on at once, by a thread that does nothing else: its
/// handler may only wake it. A second signal ends the process. The first call installs the handlers.
std::stop_source& interruption();

}  // namespace drape
