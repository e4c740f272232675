#pragma once

#include <string>

#include "render/backend.hpp"

namespace drape {

struct GlFunctions;

/// What a GL backend of this machine is and can do.
struct GlFacts {
  std::string renderer, vendor, version, shading_language;  ///< as OpenGL says
  int max_samples = 0;                                      ///< per pixel
  int max_texture_size = 0;                                 ///< [pixels]
  int max_picture_size = 0;                                 ///< width and height of a renderbuffer [pixels]
  int max_anisotropy = 0;                                   ///< 1: textures have no anisotropic filter
};

/// The largest anisotropy of a texture's filter; 1 where this GL, which must be current, has none.
int max_anisotropy(const GlFunctions& gl);

/// Makes a context of the backend and asks it.
/// @throws OutputError as make_gl_context()
GlFacts inspect_backend(GlBackend backend);

}  // namespace drape
