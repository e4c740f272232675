#include "core/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace drape {

SharedLibrary::SharedLibrary(std::string title, const std::vector<std::string>& names, const char* packages)
    : title_(std::move(title)) {
  std::string reason;
  for (const std::string& name : names) {
    // RTLD_LOCAL: OSMesa and EGL define functions of the same names and may live in the same process.
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) return;
    if (reason.empty()) reason = dlerror();
  }
  throw OutputError(
      fmt::format("cannot draw: no {} library can be loaded (looked for {}; {}); on Debian: apt-get install {}", title_,
                  fmt::join(names, ", "), reason, packages));
}

void* SharedLibrary::find(const char* name) const {
  void* const function = dlsym(handle_, name);
  if (function == nullptr) {
    throw OutputError(fmt::format("cannot draw: the {} library has no {}; it is too old", title_, name));
  }
  return function;
}

}  // namespace drape
