#pragma once

namespace drape {

/// Keeps llvmpipe, Mesa's software renderer, to vectors of 256 bits: with 512 it crashes when multisampling. Sets the
/// environment variable LP_NATIVE_VECTOR_WIDTH, which llvmpipe reads when it is loaded, unless it is already set.
/// @throws UsageError if it is set to more than 256, or to no number
void limit_llvmpipe_vector_width();

}  // namespace drape
