#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// Returns the folders below which share/drape and lib/drape may lie, in search order: the folders above the program,
/// then those above the library or Python module that holds this code. An installation may be moved as a whole.
std::vector<std::filesystem::path> installation_roots();

/// Returns the configured installation prefix, for programs of others that use this library.
std::filesystem::path configured_prefix();

/// Returns the program's own file, even if the portable archive's loader runs it.
std::filesystem::path program_file();

/// Returns the file that starts this program again: the portable archive's launcher, otherwise the program.
std::filesystem::path program_command();

/// Returns the root of the portable archive made by script/portable; empty if the program is not part of one.
std::filesystem::path portable_root();

/// Points libraries to their data in a portable archive: fontconfig to its configuration, GIO to its modules. Sets only
/// unset environment variables, so call it before the first thread starts. Does nothing outside an archive.
void use_portable_data();

/// Returns the environment for programs outside this installation: all but the variables of `use_portable_data`.
std::vector<std::string> environment_for_others();

/// Returns a hash of the running program, computed once.
/// @throws UsageError if its file cannot be read
const std::string& program_hash();

}  // namespace drape
