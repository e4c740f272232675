#include "render/gl/context.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <thread>

#include "core/installation.hpp"
#include "core/machine.hpp"
#include "drape/core/error.hpp"
#include "render/gl/program.hpp"

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

namespace {

std::string text(const GlFunctions& gl, GLenum name) {
  const GLubyte* const bytes = gl.GetString(name);
  return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
}

int number(const GlFunctions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

}  // namespace

GlFacts inspect_backend(GlBackend backend) {
  const auto context = make_gl_context(backend);
  context->make_current();
  const GlFunctions gl(*context);
  return {.renderer = text(gl, GL_RENDERER),
          .vendor = text(gl, GL_VENDOR),
          .version = text(gl, GL_VERSION),
          .shading_language = text(gl, GL_SHADING_LANGUAGE_VERSION),
          .max_samples = number(gl, GL_MAX_SAMPLES),
          .max_texture_size = number(gl, GL_MAX_TEXTURE_SIZE),
          .max_picture_size = number(gl, GL_MAX_RENDERBUFFER_SIZE)};
}

namespace {

/// Guards the environment: renderers may be made concurrently, and each reads and sets variables.
std::mutex& environment() {
  static std::mutex mutex;
  return mutex;
}

/// Sets the width of vectors, unless it is given. Mesa stores compiled shaders without their width, and crashes with
/// those of another, so only the usual width uses stored ones.
void limit_vector_width() {
  constexpr int widest = 256;
  const char* given = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (given == nullptr) {
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0);
    return;
  }
  const std::string_view text = given;
  int width = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
  if (error != std::errc{} || end != text.data() + text.size() || width < 128 || width > widest) {
    throw UsageError(
        fmt::format("the environment variable LP_NATIVE_VECTOR_WIDTH is \"{}\"; expected 128 or 256, since Mesa's "
                    "software renderer "
                    "crashes with more: unset it",
                    text));
  }
  if (width != widest) setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

}  // namespace

void limit_llvmpipe_vector_width() {
  const std::scoped_lock lock(environment());
  limit_vector_width();
}

void prepare_llvmpipe() {
  const std::scoped_lock lock(environment());
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver != nullptr && *driver != '\0' && std::string_view(driver) != "llvmpipe") {
    throw OutputError(fmt::format(
        "cannot draw: the environment variable GALLIUM_DRIVER is \"{}\"; expected llvmpipe, Mesa's software "
        "renderer: unset it",
        driver));
  }
  limit_vector_width();
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
  setenv("EGL_LOG_LEVEL", "fatal", 0);
}

}  // namespace drape
