#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace drape::gif {

/// What has to be known to make a frame of a film out of the one before: stretches of bytes that stay, by their length,
/// and in turns with them the bytes that take the place of others.
///
/// Run lengths because of speed: most of a film's frame is as it was, and there this goes over memory as fast as it can
/// be read; what has moved is new in nearly every byte, and to compress it takes more time than to write it to the
/// disk.
/// @param packed  overwritten
void pack_difference(std::span<const std::uint8_t> before, std::span<const std::uint8_t> now,
                     std::vector<std::uint8_t>& packed);

/// Makes the next frame out of the one before.
/// @returns whether the difference is one of frames of this size; if not, the frame may hold anything
bool apply_difference(std::span<const std::uint8_t> packed, std::span<std::uint8_t> frame);

/// The first place from `begin` on where bytes differ; their number if there is none.
std::size_t next_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin);

}  // namespace drape::gif
