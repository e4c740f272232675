#include "check/golden_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace drape {
namespace fs = std::filesystem;

void fail_to_read(const fs::path& file, const std::string& problem) {
  throw UsageError(fmt::format("{}: {}; restore it, or record it anew with drape bless", file.string(), problem));
}

std::string read_golden_file(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail_to_read(file, "is missing");
  if (fs::is_directory(status)) fail_to_read(file, "is a folder, not a file");
  if (error) fail_to_read(file, fmt::format("cannot be read: {}", error.message()));
  if (!fs::is_regular_file(status)) fail_to_read(file, "is no regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && size > most) {
    fail_to_read(file, fmt::format("has {} bytes, where at most {} are expected", size, most));
  }
  std::string bytes(error ? 0 : size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (error || !stream) fail_to_read(file, "cannot be read");
  return bytes;
}

}  // namespace drape
