#include "render/gl/context.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gl/llvmpipe.hpp"

namespace drape {

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
  if (backend == GlBackend::osmesa) return make_osmesa_context();
  if (backend == GlBackend::egl) return make_egl_context();
  prepare_llvmpipe();  // an environment that is wrong is so for both
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
