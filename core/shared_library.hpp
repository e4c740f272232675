#pragma once

#include <string>
#include <vector>

namespace drape {

/// A shared library that is loaded at run time: linking it would cost every start of the program. It stays loaded until
/// the process ends: LLVM inside Mesa does not survive unloading.
class SharedLibrary {
 public:
  /// Loads the first of these that is there.
  /// @param title    what to call it in messages, as in "OSMesa"
  /// @param packages the Debian packages that bring it
  /// @param task     what it is loaded for, in messages
  /// @throws OutputError if none is
  SharedLibrary(std::string title, const std::vector<std::string>& names, const char* packages,
                const char* task = "draw");

  /// Finds a function by its name.
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
