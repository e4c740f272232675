#pragma once

#include <string>
#include <vector>

namespace drape {

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
