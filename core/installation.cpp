#include "core/installation.hpp"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/hash.hpp"
#include "core/read_file.hpp"

namespace drape {
namespace {

constexpr const char* loader_folder = "loader";  // in libexec/ of the portable archive

/// Appends the folder of a file and those above it.
void add_folders_above(const std::filesystem::path& file, std::vector<std::filesystem::path>& folders) {
  constexpr int most = 6;  // lib/python3/dist-packages/drape has three below the root, and a build tree has two
  std::filesystem::path folder = file.parent_path();
  for (int above = 0; above < most && folder.has_relative_path(); ++above, folder = folder.parent_path()) {
    folders.push_back(folder);
  }
}

/// Returns the file mapped at an address of this process; empty if there is none.
std::filesystem::path mapped_file(std::uintptr_t address) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream range(line);  // 7f00-7f80 r-xp 00000000 08:01 1234  /usr/bin/drape
    if (!(range >> std::hex >> begin >> dash >> end) || address < begin || address >= end) continue;
    const std::size_t name = line.find('/');
    return name == std::string::npos ? std::filesystem::path{} : std::filesystem::path(line.substr(name));
  }
  return {};
}

/// Returns the address of the program's ELF headers: the loader lists the program before its libraries.
std::uintptr_t program_address() {
  std::uintptr_t address = 0;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* result) {
        *static_cast<std::uintptr_t*>(result) = reinterpret_cast<std::uintptr_t>(info->dlpi_phdr);
        return 1;
      },
      &address);
  return address;
}

/// Returns true if the portable archive's loader runs this program: the started file is then the loader.
/// The system's own loader is never the started file, because the kernel maps it beside the program.
bool run_by_loader(const std::filesystem::path& started, const std::filesystem::path& mapped) {
  return !mapped.empty() && started.parent_path().filename() == loader_folder && started != mapped;
}

/// Returns the environment variables that lead libraries to their data in a portable archive.
std::vector<std::pair<std::string, std::string>> portable_variables() {
  const std::filesystem::path root = portable_root();
  if (root.empty()) return {};
  return {{"FONTCONFIG_FILE", (root / "etc/fonts/fonts.conf").string()},
          {"GIO_MODULE_DIR", (root / "lib/gio").string()},
          {"GIO_USE_VFS", "local"}};
}

}  // namespace

std::filesystem::path program_file() {
  std::error_code error;
  std::filesystem::path started = std::filesystem::read_symlink("/proc/self/exe", error);
  std::filesystem::path mapped = mapped_file(program_address());
  return run_by_loader(started, mapped) ? mapped : started;
}

std::filesystem::path program_command() {
  const std::filesystem::path root = portable_root();
  return root.empty() ? program_file() : root / "bin" / "drape";
}

std::filesystem::path portable_root() {
  std::error_code error;
  const std::filesystem::path started = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || started.parent_path().filename() != loader_folder) return {};
  const std::filesystem::path program = mapped_file(program_address());
  return run_by_loader(started, program) ? program.parent_path().parent_path() : std::filesystem::path{};
}

void use_portable_data() {
  for (const auto& [name, value] : portable_variables()) setenv(name.c_str(), value.c_str(), 0);
}

std::vector<std::string> environment_for_others() {
  const auto own = portable_variables();
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const auto is_own = [&](const auto& variable) { return text == variable.first + "=" + variable.second; };
    if (std::none_of(own.begin(), own.end(), is_own)) result.emplace_back(text);
  }
  return result;
}

std::vector<std::filesystem::path> installation_roots() {
  std::vector<std::filesystem::path> roots;
  std::error_code error;
  const std::filesystem::path program = program_file();
  if (!program.empty()) add_folders_above(program, roots);
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
    const std::filesystem::path root = portable_root();
    hash.add(read_file(root.empty() ? "/proc/self/exe" : program_file(), UINTMAX_MAX));
    return hash.text();
  }();
  return text;
}

}  // namespace drape
