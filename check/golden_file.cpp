#include "check/golden_file.hpp"

#include <fmt/format.h>

#include <system_error>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;

namespace {

const std::string remedy = "; restore it, or record it again with drape bless";

}  // namespace

void fail_to_read(const fs::path& file, const std::string& problem) {
  throw UsageError(shown(file) + ": " + problem + remedy);
}

std::string read_golden_file(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail_to_read(file, "is missing");
  if (fs::is_directory(status)) fail_to_read(file, "is a folder, not a file");
  if (error) fail_to_read(file, fmt::format("cannot be read: {}", error.message()));
  if (!fs::is_regular_file(status)) fail_to_read(file, "is not a regular file");
  try {
    return read_file(file, most);
  } catch (const UsageError& problem) {
    throw UsageError(problem.what() + remedy);
  }
}

}  // namespace drape
