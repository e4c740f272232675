#pragma once

#include <atomic>

namespace drape {

/// Becomes true when the process is asked to end (Ctrl-C, SIGTERM, a closed terminal). A second request ends it at
/// once. Installs the handlers at the first call.
const std::atomic<bool>& interruption();

}  // namespace drape
