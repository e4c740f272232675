#include "core/installation.hpp"

#include <dlfcn.h>

#include <cstdint>
#include <system_error>

#include "core/hash.hpp"
#include "core/read_file.hpp"

namespace drape {
namespace {

/// Appends the folder of a file and those above it.
void add_folders_above(const std::filesystem::path& file, std::vector<std::filesystem::path>& folders) {
  constexpr int most = 6;  // lib/python3/dist-packages/drape has three below the root, and a build tree has two
  std::filesystem::path folder = file.parent_path();
  for (int above = 0; above < most && folder.has_relative_path(); ++above, folder = folder.parent_path()) {
    folders.push_back(folder);
  }
}

}  // namespace

std::vector<std::filesystem::path> installation_roots() {
  std::vector<std::filesystem::path> roots;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) add_folders_above(program, roots);
  Dl_info here{};
  if (dladdr(reinterpret_cast<void*>(&configured_prefix), &here) != 0 && here.dli_fname != nullptr) {
    const std::filesystem::path file = std::filesystem::canonical(here.dli_fname, error);
    if (!error && file != program) add_folders_above(file, roots);
  }
  return roots;
}

std::filesystem::path configured_prefix() { return DRAPE_PREFIX; }

const std::string& program_hash() {
  static const std::string text = [] {
    Hash hash;
    hash.add(read_file("/proc/self/exe", UINTMAX_MAX));
    return hash.text();
  }();
  return text;
}

}  // namespace drape
