#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Origin of this binary.
struct BuildInfo {
  std::string version;  ///< "0.2.0", or "0.2.0+15.g3f2a": 15 commits after 0.2.0
  std::string revision;  ///< Git revision: "3f2a…", with "-dirty" if files were changed; "unknown" outside a repository
  std::string date;      ///< date of the revision, "2026-11-22"; empty outside a repository
  std::string compiler;  ///< "GCC 12.2.0"
  std::string type;      ///< CMake's build type: "Release"
};

/// Returns the origin of this binary.
const BuildInfo& build_info();

/// Returns the folders below which share/drape and lib/drape may lie, in search order: the folders above the program,
/// then those above the library or Python module that holds this code. An installation may be moved as a whole.
std::vector<std::filesystem::path> installation_roots();

/// Returns the configured installation prefix, for third-party programs that use this library.
std::filesystem::path configured_prefix();

/// Returns the program's own file, even if the portable archive's loader runs it.
std::filesystem::path program_file();

/// Returns the file that starts this program again: the portable archive's launcher, otherwise the program.
std::filesystem::path program_command();

/// Returns the root of the portable archive made by script/portable; empty if the program is not part of one.
std::filesystem::path portable_root();

/// Points libraries to their data in a portable archive: fontconfig to its configuration, GIO to its modules. Sets only
/// unset environment variables, so call it before the first thread starts. Does nothing outside an archive.
void use_portable_data();

/// Returns the environment for external programs, without the variables set by use_portable_data().
std::vector<std::string> environment_for_others();

/// Returns a hash of the running program, computed once.
/// @throws UsageError if its file cannot be read
const std::string& program_hash();

/// Maximum length of a name for name_in_folder() [bytes]. It leaves room within 255 bytes for additions to hidden and
/// temporary names.
inline constexpr std::size_t longest_name = 200;

/// Validates an untrusted name as a single path component. A valid name has 1 to `longest_name` bytes, no separator, no
/// control character and no leading dot.
/// @param file file that contains the name, for messages
/// @param key  key of the name in the file
/// @returns the name
/// @throws UsageError "file: key: …" for any other name
std::string name_in_folder(std::string_view name, const std::filesystem::path& file, std::string_view key);

/// Turns text into a valid path component: replaces forbidden bytes and truncates long text.
/// @param longest greatest length of the name [bytes]
std::string as_name_in_folder(std::string_view text, std::size_t longest = longest_name);

/// Checks one path in a folder for links.
/// @throws UsageError if a link on the path leads out of the folder or is broken
void require_inside(const std::filesystem::path& place, const std::filesystem::path& folder);

/// Checks all links in a folder and its subfolders. The folder itself may be a link, or not exist.
/// @throws UsageError if a link leads out of the folder or is broken
void require_links_inside(const std::filesystem::path& folder);

/// A shared library that is loaded at run time, because linking it would slow every start of the program. It stays
/// loaded until the process ends: LLVM inside Mesa does not survive unloading.
class SharedLibrary {
 public:
  /// Loads the first of `names` that is installed.
  /// @param title    name in messages, as in "OSMesa"
  /// @param packages Debian packages that contain it
  /// @param task     purpose of the library, in messages
  /// @throws OutputError if none can be loaded
  SharedLibrary(std::string title, const std::vector<std::string>& names, const char* packages,
                const char* task = "draw");

  /// Looks up a function by its name.
  /// @throws OutputError if the library has none
  template <class Function>
  void fetch(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(find(name));
  }

 private:
  [[nodiscard]] void* find(const char* name) const;

  std::string title_, task_;
  void* handle_ = nullptr;
};

}  // namespace drape
