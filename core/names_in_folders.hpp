#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace drape {

/// Greatest length of such a name [bytes]: longer names of hidden and temporary files still fit into a folder's 255.
inline constexpr std::size_t longest_name = 200;

/// Validates a name read from a file, which may be untrusted, as the name of a file or folder in one folder.
/// A valid name has 1 to `longest_name` bytes, no separator, no control character and no leading dot.
/// @param file that holds the name, for the message
/// @param key  of the name in that file
/// @returns the name
/// @throws UsageError "file: key: …" for any other name
std::string name_in_folder(std::string_view name, const std::filesystem::path& file, std::string_view key);

/// Turns a text into such a name: replaces forbidden bytes and cuts the end of a long text.
/// @param longest greatest length of the name [bytes]
std::string as_name_in_folder(std::string_view text, std::size_t longest = longest_name);

/// Checks one path in a folder for links.
/// @throws UsageError if a link on the path leads out of the folder or is broken
void require_inside(const std::filesystem::path& place, const std::filesystem::path& folder);

/// Checks all links in a folder and its subfolders. The folder itself may be a link, or not exist.
/// @throws UsageError if one leads out of the folder or is broken
void require_links_inside(const std::filesystem::path& folder);

}  // namespace drape
