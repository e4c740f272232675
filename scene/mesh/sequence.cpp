#include "scene/mesh/sequence.hpp"

#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

constexpr std::string_view frame_opening = "{frame";

[[noreturn]] void fail_sequence(const std::filesystem::path& file, const std::string& message) {
  throw UsageError(shown(file) + ": " + escape_controls(message));
}

/// A file name split around its number.
struct FrameName {
  std::string before, after;
  std::size_t width = 0;  // least digits of the number; 0: any, without leading zeros

  [[nodiscard]] std::string with(std::int64_t number) const {
    return before + fmt::format("{:0{}}", number, width) + after;
  }
};

/// Parses a name that contains {frame} or {frame:04}; returns nothing for other names.
std::optional<FrameName> frame_name(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t begin = name.find(frame_opening), end = name.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  const std::string digits = name.substr(begin + frame_opening.size(), end - begin - frame_opening.size());
  const bool padded = digits.size() == 3 && digits.starts_with(":0") && digits[2] >= '1' && digits[2] <= '9';
  if (!digits.empty() && !padded) return std::nullopt;
  return FrameName{name.substr(0, begin), name.substr(end + 1),
                   padded ? static_cast<std::size_t>(digits[2] - '0') : std::size_t{0}};
}

/// Returns the number in a name; -1 if the name does not belong to the sequence.
std::int64_t number_of(const FrameName& of, const std::string& name) {
  if (name.size() <= of.before.size() + of.after.size()) return -1;
  const std::string digits = name.substr(of.before.size(), name.size() - of.before.size() - of.after.size());
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = error == std::errc{} && end == digits.data() + digits.size() && number >= 0;
  return whole && of.with(number) == name ? number : -1;
}

}  // namespace

bool names_frames(const std::filesystem::path& file) {
  return file.filename().string().find(frame_opening) != std::string::npos;
}

bool is_frame(const std::filesystem::path& file, const std::filesystem::path& named) {
  const std::optional<FrameName> of = frame_name(named);
  return of && file.parent_path() == named.parent_path() && number_of(*of, file.filename().string()) >= 0;
}

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file) {
  const std::optional<FrameName> name = frame_name(file);
  if (!name) fail_sequence(file, "expected {frame} or {frame:04} in the name");
  const FrameName& of = *name;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::map<std::int64_t, std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::int64_t number = number_of(of, entry->path().filename().string());
    if (number >= 0) found.emplace(number, file.parent_path() / entry->path().filename());
  }
  if (error) fail_sequence(folder, "the folder cannot be read: " + error.message());
  if (found.empty()) fail_sequence(file, fmt::format("there is no such file; the first could be {}", of.with(1)));
  std::vector<std::filesystem::path> files;
  for (const auto& [number, path] : found) {
    const std::int64_t expected = found.begin()->first + static_cast<std::int64_t>(files.size());
    if (number != expected)
      fail_sequence(file, fmt::format("{} is missing before {}", of.with(expected), of.with(number)));
    files.push_back(path);
  }
  return files;
}

}  // namespace drape
