#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// The folders, in the order in which they are to be tried, below which share/drape and lib/drape may lie: those above
/// the program, then those above what this code is in, where that is a library or a Python module. Wherever what was
/// installed together was moved to, one of them holds it.
std::vector<std::filesystem::path> installation_roots();

/// The folder that drape was configured to be installed into: where a program of somebody else's finds what it needs.
std::filesystem::path configured_prefix();

/// The program's own file, also where a loader that is not the system's runs it, as in the portable archive.
std::filesystem::path program_file();

/// The file that starts this program once more: the launcher of the portable archive, otherwise the program.
std::filesystem::path program_command();

/// The root of the portable archive that script/portable makes; empty where this program is not part of one.
std::filesystem::path portable_root();

/// Points libraries to their data in a portable archive: fontconfig to its configuration, GIO to its modules. It sets
/// environment variables that are not set yet, so it is called before the first thread starts. Does nothing elsewhere.
void use_portable_data();

/// The environment for a program that is not part of this installation: without what `use_portable_data` has set.
std::vector<std::string> environment_for_others();

/// A hash of the program that runs, made once.
/// @throws UsageError if its file cannot be read
const std::string& program_hash();

}  // namespace drape
