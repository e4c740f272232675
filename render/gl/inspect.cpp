#include "render/gl/inspect.hpp"

#include <string_view>

#include "render/gl/context.hpp"
#include "render/gl/functions.hpp"

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

int max_anisotropy(const GlFunctions& gl) {
  const int extensions = number(gl, GL_NUM_EXTENSIONS);
  for (int i = 0; i < extensions; ++i) {
    const std::string_view name = reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (name.ends_with("_texture_filter_anisotropic")) return number(gl, GL_MAX_TEXTURE_MAX_ANISOTROPY);
  }
  return 1;
}

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
          .max_picture_size = number(gl, GL_MAX_RENDERBUFFER_SIZE),
          .max_anisotropy = max_anisotropy(gl)};
}

}  // namespace drape
