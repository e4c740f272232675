#include "codecs/codecs.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/shared_library.hpp"

namespace drape {

std::filesystem::path codecs_module() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  // A program that is installed is in bin/; of one that was built the module is in its folder or one or two above it.
  std::filesystem::path folder = program.parent_path();
  for (int above = 0; above < 3; ++above, folder = folder.parent_path()) {
    if (const auto file = folder / DRAPE_CODECS_MODULE; std::filesystem::exists(file, error)) return file;
  }
  throw OutputError(
      fmt::format("cannot encode or decode: a part of drape is missing, {}; it is built and installed with the program",
                  (program.parent_path().parent_path() / DRAPE_CODECS_MODULE).string()));
}

const Codecs& codecs() {
  static const Codecs* const loaded = [] {
    const SharedLibrary module("codecs", {codecs_module().string()}, "libopencv-dev", "encode or decode");
    const Codecs* (*get)() = nullptr;
    module.fetch("drape_codecs", get);
    return get();
  }();
  return *loaded;
}

}  // namespace drape
