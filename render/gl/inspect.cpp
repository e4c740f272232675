#include "render/gl/inspect.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "drape/core/error.hpp"
#include "render/gl/context.hpp"
#include "render/gl/program.hpp"

namespace drape {
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
