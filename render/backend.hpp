#pragma once

// Example:
//   std::printf("%s", drape::backend_name(drape::GlBackend::osmesa));

namespace drape {

/// Where the OpenGL context comes from. Both draw the same bytes where Mesa's software renderer is behind them.
enum class GlBackend {
  automatic,  ///< the first of the following that is there
  osmesa,     ///< OSMesa: Mesa up to 25.0
  egl         ///< EGL without a surface
};

/// "auto", "osmesa" or "egl".
const char* backend_name(GlBackend backend);

}  // namespace drape
