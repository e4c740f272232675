#include "scene/mesh/sequence.hpp"

#include <charconv>
#include <cstdint>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

constexpr std::string_view kOpening = "{frame";

[[noreturn]] void fail_sequence(const std::filesystem::path& file, const std::string& message) {
  throw UsageError(escape_controls(file.string() + ": " + message));
}

/// A name around a number.
struct Template {
  std::string before, after;
  std::size_t width = 0;  // of the number at least; 0: of any, as no zeros stand before it

  explicit Template(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    const std::size_t begin = name.find(kOpening), end = name.find('}', begin);
    const std::string digits = name.substr(begin + kOpening.size(), end - begin - kOpening.size());
    const bool padded = digits.size() == 3 && digits.starts_with(":0") && digits[2] >= '1' && digits[2] <= '9';
    if (end == std::string::npos || (!digits.empty() && !padded)) {
      fail_sequence(file, "expected {frame} or {frame:04} in the name");
    }
    before = name.substr(0, begin);
    after = name.substr(end + 1);
    width = padded ? static_cast<std::size_t>(digits[2] - '0') : 0;
  }

  [[nodiscard]] std::string name(std::int64_t number) const {
    return before + fmt::format("{:0{}}", number, width) + after;
  }
};

/// The number that a name has; -1 if it is not of the template.
std::int64_t number_of(const Template& of, const std::string& name) {
  if (name.size() <= of.before.size() + of.after.size()) return -1;
  const std::string digits = name.substr(of.before.size(), name.size() - of.before.size() - of.after.size());
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = error == std::errc{} && end == digits.data() + digits.size() && number >= 0;
  return whole && of.name(number) == name ? number : -1;
}

}  // namespace

bool names_frames(const std::filesystem::path& file) {
  return file.filename().string().find(kOpening) != std::string::npos;
}

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file) {
  const Template of(file);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::map<std::int64_t, std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::int64_t number = number_of(of, entry->path().filename().string());
    if (number >= 0) found.emplace(number, file.parent_path() / entry->path().filename());
  }
  if (error) fail_sequence(folder, "the folder cannot be read: " + error.message());
  if (found.empty()) fail_sequence(file, fmt::format("there is no such file; the first could be {}", of.name(1)));
  std::vector<std::filesystem::path> files;
  for (const auto& [number, path] : found) {
    const std::int64_t expected = found.begin()->first + static_cast<std::int64_t>(files.size());
    if (number != expected)
      fail_sequence(file, fmt::format("{} is missing before {}", of.name(expected), of.name(number)));
    files.push_back(path);
  }
  return files;
}

}  // namespace drape
