#include "output/gif/frame_difference.hpp"

#include <algorithm>
#include <cstring>

namespace drape::gif {
namespace {

/// Lengths of the next unchanged and replaced stretches [bytes].
struct Lengths {
  std::uint32_t kept = 0, replaced = 0;
};

using Word = std::uint64_t;  // bytes compared at once

Word word(const std::uint8_t* bytes) {
  Word value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// Returns the first position from `begin` where the equal stretch is longer than its description.
std::size_t next_stay(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin) {
  std::size_t i = begin;
  for (; i + 2 * sizeof(Word) <= a.size(); i += sizeof(Word)) {
    if (word(&a[i]) == word(&b[i]) && word(&a[i + sizeof(Word)]) == word(&b[i + sizeof(Word)])) return i;
  }
  return a.size();
}

}  // namespace

std::size_t next_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, std::size_t begin) {
  std::size_t i = begin;
  while (i + sizeof(Word) <= a.size() && word(&a[i]) == word(&b[i])) i += sizeof(Word);
  while (i < a.size() && a[i] == b[i]) ++i;
  return i;
}

void pack_difference(std::span<const std::uint8_t> before, std::span<const std::uint8_t> now,
                     std::vector<std::uint8_t>& packed) {
  packed.clear();
  for (std::size_t i = 0; i < now.size();) {
    const std::size_t differs = next_difference(before, now, i);
    const std::size_t end = next_stay(before, now, differs);
    const Lengths lengths{static_cast<std::uint32_t>(differs - i), static_cast<std::uint32_t>(end - differs)};
    const auto* header = reinterpret_cast<const std::uint8_t*>(&lengths);
    packed.insert(packed.end(), header, header + sizeof lengths);
    packed.insert(packed.end(), now.begin() + static_cast<std::ptrdiff_t>(differs),
                  now.begin() + static_cast<std::ptrdiff_t>(end));
    i = end;
  }
}

bool apply_difference(std::span<const std::uint8_t> packed, std::span<std::uint8_t> frame) {
  while (!packed.empty()) {
    Lengths lengths;
    if (packed.size() < sizeof lengths) return false;
    std::memcpy(&lengths, packed.data(), sizeof lengths);
    packed = packed.subspan(sizeof lengths);
    if (lengths.kept > frame.size()) return false;
    frame = frame.subspan(lengths.kept);
    if (lengths.replaced > frame.size() || lengths.replaced > packed.size()) return false;
    std::copy_n(packed.begin(), lengths.replaced, frame.begin());
    frame = frame.subspan(lengths.replaced);
    packed = packed.subspan(lengths.replaced);
  }
  return frame.empty();
}

}  // namespace drape::gif
