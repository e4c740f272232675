#pragma once

namespace drape {

// Effects of drape's own environment variables, which are read only here.

/// Applies DRAPE_ISA: the highest instruction set for the hot loops.
/// @throws UsageError for an unknown name
void use_environment_isa();

/// Applies DRAPE_DATA: the data folder.
/// @throws UsageError if there is no such folder
void use_environment_data();

/// Applies all variables.
inline void use_environment() {
  use_environment_isa();
  use_environment_data();
}

}  // namespace drape
