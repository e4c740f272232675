#include <cstdlib>
#include <system_error>

#include "core/error.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

}  // namespace

std::filesystem::path data_folder() {
  if (const char* given = std::getenv("DRAPE_DATA"); given != nullptr && *given != '\0') {
    if (is_folder(given)) return given;
    throw UsageError("DRAPE_DATA: no such folder: " + std::string(given));
  }
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = executable.parent_path().parent_path() / "share" / "drape";
  if (!error && is_folder(installed)) return installed;

  const std::filesystem::path source = DRAPE_SOURCE_TREE;
  if (is_folder(source)) return source;
  throw UsageError("no data folder: neither " + installed.string() + " nor " + source.string() +
                   " is one; DRAPE_DATA can name another");
}

}  // namespace drape
