#include "core/names_in_folders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// Returns true for a text with a control character of ASCII, or of Unicode from U+0080 to U+009F.
bool has_control_character(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7F) return true;
    if (byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0) return true;
  }
  return false;
}

/// Cuts a text to at most `longest` bytes, at the boundary of a UTF-8 character.
std::string_view cut(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

/// Returns the beginning of a name, for a message.
std::string beginning(std::string_view name) {
  constexpr std::size_t most_shown = 80;
  return shown(cut(name, most_shown)) + (name.size() > most_shown ? "…" : "");
}

const char* problem_with(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > longest_name) return "is too long";
  if (has_control_character(name)) return "has a control character";
  if (name.find_first_of("/\\") != std::string_view::npos) return "leads to another folder";
  return name.front() == '.' ? "begins with a dot" : nullptr;
}

[[noreturn]] void refuse_link(const fs::path& place, const fs::path& folder) {
  throw UsageError(fmt::format("{}: a link leads from there out of {}", shown(place), shown(folder)));
}

bool is_below(const fs::path& place, const fs::path& folder) {
  const auto [in_place, in_folder] = std::ranges::mismatch(place, folder);
  return in_folder == folder.end();
}

}  // namespace

std::string name_in_folder(std::string_view name, const fs::path& file, std::string_view key) {
  const char* problem = problem_with(name);
  if (problem == nullptr) return std::string(name);
  throw UsageError(fmt::format("{}: {}: expected a plain name of a file or folder, found '{}', which {}", shown(file),
                               key, beginning(name), problem));
}

std::string as_name_in_folder(std::string_view text, std::size_t longest) {
  std::string name = printable(text);
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '\\' || c == '\n' || c == '\t'; }, '_');
  if (name.empty() || name.front() == '.') name.insert(name.begin(), '_');
  return std::string(cut(name, longest));
}

void require_inside(const fs::path& place, const fs::path& folder) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return;  // a missing folder has no links
  fs::path at = root;
  for (const fs::path& part : place.lexically_relative(folder)) {
    if (part == "..") refuse_link(place, folder);
    at /= part;
    const fs::file_status status = fs::symlink_status(at, error);
    if (!fs::exists(status)) return;
    if (!fs::is_symlink(status)) continue;
    at = fs::canonical(at, error);
    if (error || !is_below(at, root)) refuse_link(place, folder);
  }
}

void require_links_inside(const fs::path& folder) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return;  // opening the folder will report the problem
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(root, skip, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->is_symlink(error)) continue;
    const fs::path target = fs::canonical(entry->path(), error);
    if (error || !is_below(target, root)) refuse_link(folder / entry->path().lexically_relative(root), folder);
  }
}

}  // namespace drape
