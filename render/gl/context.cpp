#include "render/gl/context.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <thread>

#include "core/installation.hpp"
#include "core/machine.hpp"
#include "drape/core/error.hpp"
#include "render/gl/inspect.hpp"

namespace drape {
namespace {

/// Refuses to load Mesa without enough address space: LLVM ends the process when memory runs out.
void require_address_space() {
  static std::atomic<bool> loaded = false;
  if (loaded) return;
  constexpr double base = 1.1e9, of_thread = 80e6;    // measured [bytes]; mostly mapped and never used
  constexpr unsigned most_threads = 32, counted = 2;  // greatest of llvmpipe, and number during the measurement
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), counted, most_threads);
  const double need = base + of_thread * (threads - counted), left = address_space_left();
  if (left >= need) {
    loaded = true;
    return;
  }
  throw OutputError(fmt::format(
      "cannot draw: Mesa needs {:.1f} GB of address space, and the limit of this process leaves {:.1f} GB; raise "
      "it (ulimit -v)",
      need / 1e9, std::max(0.0, left) / 1e9));
}

}  // namespace

const char* backend_name(GlBackend backend) {
  switch (backend) {
    case GlBackend::automatic:
      return "auto";
    case GlBackend::osmesa:
      return "osmesa";
    case GlBackend::egl:
      return "egl";
  }
  return "";
}

const char* debian_packages(GlBackend backend) {
  return backend == GlBackend::egl ? "libegl1 libgl1-mesa-dri" : "libosmesa6";
}

std::unique_ptr<GlContext> make_gl_context(GlBackend backend) {
  require_address_space();
  if (backend == GlBackend::osmesa) return make_osmesa_context();
  // The system's EGL would load a Mesa built with other libraries than the archive's.
  if (!portable_root().empty() && backend == GlBackend::egl)
    throw OutputError("cannot draw: the portable archive has no EGL; it draws with OSMesa (--backend osmesa)");
  if (backend == GlBackend::egl) return make_egl_context();
  if (!portable_root().empty()) return make_osmesa_context();
  prepare_llvmpipe();  // a wrong environment affects both backends
  std::string without_osmesa;
  try {
    return make_osmesa_context();
  } catch (const OutputError& error) {
    without_osmesa = error.what();
  }
  try {
    return make_egl_context();
  } catch (const OutputError& error) {
    throw OutputError(without_osmesa + "\n" + error.what());
  }
}

}  // namespace drape
