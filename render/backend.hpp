#pragma once

// Example:
//   std::printf("%s", drape::backend_name(drape::GlBackend::osmesa));

namespace drape {

/// Source of the OpenGL context. Both draw the same bytes on top of Mesa's software renderer.
enum class GlBackend {
  automatic,  ///< the first available of the following
  osmesa,     ///< OSMesa: Mesa up to 25.0
  egl         ///< EGL without a surface
};

/// Returns "auto", "osmesa" or "egl".
const char* backend_name(GlBackend backend);

}  // namespace drape
