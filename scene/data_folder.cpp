#include <system_error>

#include "core/error.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

std::filesystem::path chosen_data_folder;

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

}  // namespace

void use_data_folder(const std::filesystem::path& folder) {
  if (!folder.empty() && !is_folder(folder)) throw UsageError("no such folder: " + shown(folder));
  chosen_data_folder = folder;
}

std::filesystem::path data_folder() {
  if (!chosen_data_folder.empty()) return chosen_data_folder;
  const std::filesystem::path installed = std::filesystem::path("share") / "drape";
  std::filesystem::path source = DRAPE_SOURCE_TREE;
  for (const auto& root : installation_roots()) {
    if (is_folder(root / installed)) return root / installed;
  }
  if (is_folder(source)) return source;
  std::filesystem::path configured = configured_prefix() / installed;
  if (is_folder(configured)) return configured;
  throw UsageError("no data folder found: none beside the program, and neither " + shown(configured) + " nor " +
                   shown(source) + " exists");
}

}  // namespace drape
