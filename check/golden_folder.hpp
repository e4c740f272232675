#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "check/golden.hpp"

namespace drape {

/// Returns true if a folder has a golden, even a damaged one; false if the folder is missing or empty.
/// @throws UsageError if writing a golden would destroy foreign data: a file, a folder of another kind, or a link in
/// the place of one of the golden's files
bool has_golden(const std::filesystem::path& folder);

/// Checks that a folder, if it exists and is not empty, holds a golden and nothing else.
/// @throws UsageError as has_golden(), and if the folder is a link or holds other files
void require_only_golden(const std::filesystem::path& folder);

/// Removes such a folder. @throws UsageError likewise
void remove_golden(const std::filesystem::path& folder);

/// Writes a whole golden and replaces an older one atomically. Keeps foreign files and folders in it, and permissions.
/// If the folder is a link, its target is replaced.
/// @param pictures one per frame, in order
/// @returns the size of the written files [bytes]
/// @throws UsageError as has_golden()
/// @throws OutputError
std::uintmax_t write_golden(const std::filesystem::path& folder, const Golden& golden,
                            const std::vector<Png>& pictures);

}  // namespace drape
