#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace drape::gif {

/// Encodes a frame of a film relative to the previous one: lengths of unchanged stretches of bytes, alternating with
/// the bytes that replace others.
///
/// Run lengths are fast. Most of a frame is unchanged and is passed at the speed of memory. Moved parts differ in
/// nearly every byte; compressing them would take longer than writing them to disk.
/// @param packed  result; overwritten
void pack_difference(std::span<const std::uint8_t> before, std::span<const std::uint8_t> now,
                     std::vector<std::uint8_t>& packed);

/// Computes the next frame from the previous one.
/// @returns true if the difference belongs to frames of this size; otherwise the frame's content is undefined
bool apply_difference(std::span<const std::uint8_t> packed, std::span<std::uint8_t> frame);

/// Returns the first position from `begin` where bytes differ; their number if there is none.
std::size_t next_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin);

}  // namespace drape::gif
