#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "check/golden.hpp"

namespace drape {

/// Whether there is a golden in a folder, however damaged; not if there is no such folder, or nothing in it.
/// @throws UsageError if there is something else, which drape would destroy by writing a golden: a file, a folder of
///         somebody's own, a link in the place of one of the golden's files
bool has_golden(const std::filesystem::path& folder);

/// Makes sure that a folder, if it is there and not empty, holds a golden and nothing else.
/// @throws UsageError as has_golden(), and if it is a link or holds something else beside the golden
void require_only_golden(const std::filesystem::path& folder);

/// Removes such a folder. @throws UsageError likewise
void remove_golden(const std::filesystem::path& folder);

/// Writes a whole golden. What was there before is replaced in one go, so that at any moment there is one or the other.
/// Files and folders in it that are not drape's are kept, and so are permissions; of a link to a folder, that folder is
/// replaced.
/// @param pictures one for each frame, in their order
/// @returns the size of what was written [bytes]
/// @throws UsageError as has_golden()
/// @throws OutputError
std::uintmax_t write_golden(const std::filesystem::path& folder, const Golden& golden,
                            const std::vector<Png>& pictures);

}  // namespace drape
