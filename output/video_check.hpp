#pragma once

#include "core/atomic_file.hpp"

namespace drape {

/// Counts the frames that a player can read from a video or GIF.
int readable_frames(const PartialFile& file);

/// Opens a finished video or GIF as a player would, and decodes all of it.
/// @throws OutputError if it does not have this many frames: with the system's reason if known, such as a full disk
void require_frames(PartialFile& file, int count);

}  // namespace drape
