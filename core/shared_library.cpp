#include "core/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace drape {

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
