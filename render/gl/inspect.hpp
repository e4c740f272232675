#pragma once

#include <string>

#include "render/backend.hpp"

namespace drape {

struct GlFunctions;

/// Identity and limits of a GL backend on this machine.
struct GlFacts {
  std::string renderer, vendor, version, shading_language;  ///< as reported by OpenGL
  int max_samples = 0;                                      ///< per pixel
  int max_texture_size = 0;                                 ///< [pixels]
  int max_picture_size = 0;                                 ///< width and height of a renderbuffer [pixels]
  int max_anisotropy = 0;                                   ///< 1: no anisotropic texture filter
};

/// Returns the largest anisotropy of a texture filter; 1 if the current GL has none.
int max_anisotropy(const GlFunctions& gl);

/// Makes a context of the backend and queries it.
/// @throws OutputError as make_gl_context()
GlFacts inspect_backend(GlBackend backend);

}  // namespace drape
