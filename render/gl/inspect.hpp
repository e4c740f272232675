#pragma once

#include <string>

#include "drape/render/settings.hpp"

namespace drape {

/// Identity and limits of a GL backend on this machine.
struct GlFacts {
  std::string renderer, vendor, version, shading_language;  ///< as reported by OpenGL
  int max_samples = 0;                                      ///< per pixel
  int max_texture_size = 0;                                 ///< [pixels]
  int max_picture_size = 0;                                 ///< width and height of a renderbuffer [pixels]
};

/// Makes a context of the backend and queries it.
/// @throws OutputError as make_gl_context()
GlFacts inspect_backend(GlBackend backend);

/// Limits llvmpipe, Mesa's software renderer, to vectors of 256 bits: with 512 it crashes when multisampling. Sets the
/// environment variable LP_NATIVE_VECTOR_WIDTH, which llvmpipe reads when it is loaded; a valid value set before stays.
/// @throws UsageError if it is set to more than 256, or to no number
void limit_llvmpipe_vector_width();

/// Sets the environment so that llvmpipe draws the same bytes everywhere. Calls limit_llvmpipe_vector_width(), makes
/// Mesa draw in software even with a GPU, and silences EGL on the terminal; variables already set stay. Call it before
/// a GL library is loaded.
/// @throws UsageError as limit_llvmpipe_vector_width()
/// @throws OutputError if GALLIUM_DRIVER names another renderer: Mesa crashes on an unknown one
void prepare_llvmpipe();

}  // namespace drape
