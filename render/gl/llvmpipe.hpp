#pragma once

namespace drape {

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
