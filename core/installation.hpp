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

/// A hash of the program that runs, made once.
/// @throws UsageError if its file cannot be read
const std::string& program_hash();

}  // namespace drape
