#pragma once

namespace drape {

// What drape's own environment variables ask for. Nothing but this reads them.

/// DRAPE_ISA: the instruction set that the hot loops use at most.
/// @throws UsageError if it names none
void use_environment_isa();

/// DRAPE_DATA: the data folder.
/// @throws UsageError if there is no such folder
void use_environment_data();

/// All of it.
inline void use_environment() {
  use_environment_isa();
  use_environment_data();
}

}  // namespace drape
