#pragma once

namespace drape {

/// Keeps llvmpipe, Mesa's software renderer, to vectors of 256 bits: with 512 it crashes when multisampling. Sets the
/// environment variable LP_NATIVE_VECTOR_WIDTH, which llvmpipe reads when it is loaded, unless it is already set.
/// @throws UsageError if it is set to more than 256, or to no number
void limit_llvmpipe_vector_width();

/// What llvmpipe needs to draw, and to draw the same bytes everywhere: limit_llvmpipe_vector_width(), and, unless the
/// environment says otherwise, that Mesa draws in software where there is a GPU as well, and that EGL says nothing of
/// its own on the terminal. To be called before a GL library is loaded.
/// @throws UsageError as limit_llvmpipe_vector_width()
/// @throws OutputError if GALLIUM_DRIVER names another renderer: Mesa crashes where it has none of that name
void prepare_llvmpipe();

}  // namespace drape
