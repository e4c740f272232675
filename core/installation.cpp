#include "core/installation.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape_revision.hpp"

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

const BuildInfo& build_info() {
#ifdef __clang__
  static const BuildInfo info{DRAPE_VERSION, DRAPE_REVISION, DRAPE_DATE, "Clang " __clang_version__, DRAPE_BUILD_TYPE};
#else
  static const BuildInfo info{DRAPE_VERSION, DRAPE_REVISION, DRAPE_DATE, "GCC " __VERSION__, DRAPE_BUILD_TYPE};
#endif
  return info;
}

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

SharedLibrary::SharedLibrary(std::string title, const std::vector<std::string>& names, const char* packages,
                             const char* task)
    : title_(std::move(title)), task_(task) {
  std::string reason;
  for (const std::string& name : names) {
    // RTLD_LOCAL: OSMesa and EGL define functions of the same names and may be loaded together.
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) return;
    if (reason.empty()) reason = dlerror();
  }
  throw OutputError(
      fmt::format("cannot {}: no {} library can be loaded (looked for {}; {}); on Debian: apt-get install {}", task_,
                  title_, fmt::join(names, ", "), reason, packages));
}

void* SharedLibrary::find(const char* name) const {
  void* const function = dlsym(handle_, name);
  if (function == nullptr) {
    throw OutputError(fmt::format("cannot {}: the {} library has no {}; it is too old", task_, title_, name));
  }
  return function;
}

}  // namespace drape
