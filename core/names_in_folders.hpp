#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace drape {

/// The most bytes of such a name: hidden and temporary files, whose names are longer, fit into the 255 of a folder.
inline constexpr std::size_t longest_name = 200;

/// Takes a name from a file, which may be a stranger's, as the name of a file or folder in one folder.
/// It has 1 to `longest_name` bytes, no separator, no control character and no dot at its beginning.
/// @param file that says the name, for the message
/// @param key  under which it says so
/// @returns the name
/// @throws UsageError "file: key: …" for any other name
std::string name_in_folder(std::string_view name, const std::filesystem::path& file, std::string_view key);

/// Makes such a name of a text: other bytes take the place of what it may not have, and what is too long is cut.
/// @param longest of the name [bytes]
std::string as_name_in_folder(std::string_view text, std::size_t longest = longest_name);

/// Looks at one path in a folder.
/// @throws UsageError if links lead from there out of the folder, or nowhere
void require_inside(const std::filesystem::path& place, const std::filesystem::path& folder);

/// Looks at all links in a folder and in those below it. The folder itself may be a link, or not exist.
/// @throws UsageError if one leads out of the folder, or nowhere
void require_links_inside(const std::filesystem::path& folder);

}  // namespace drape
