#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace drape::test {

/// Playback data in the blocks of a GIF (GIF89a specification, 1990), without its pictures.
struct GifFile {
  int width = 0, height = 0;
  std::vector<int> delays;  ///< of each frame [1/100 s]
  int loops = -1;           ///< 0: for ever; -1: absent, played once
};

inline GifFile read_gif(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto word = [&bytes](std::size_t i) { return bytes.at(i) | bytes.at(i + 1) << 8; };
  const auto color_table = [](int flags) { return flags & 0x80 ? 3 << ((flags & 7) + 1) : 0; };
  const auto after_sub_blocks = [&bytes](std::size_t i) {
    while (bytes.at(i) != 0) i += bytes[i] + 1;
    return i + 1;
  };

  if (bytes.size() < 13 || std::string(bytes.begin(), bytes.begin() + 6) != "GIF89a")
    throw std::runtime_error("no GIF");
  GifFile gif{word(6), word(8), {}, -1};
  std::size_t i = 13 + color_table(bytes[10]);
  while (bytes.at(i) != 0x3B) {
    if (bytes[i] == 0x2C) {  // image: descriptor, colours, code size, data
      i = after_sub_blocks(i + 10 + color_table(bytes.at(i + 9)) + 1);
      continue;
    }
    if (bytes[i] != 0x21) throw std::runtime_error("an unknown block");
    if (bytes.at(i + 1) == 0xF9) gif.delays.push_back(word(i + 4));
    if (bytes[i + 1] == 0xFF && bytes.at(i + 14) == 3) gif.loops = word(i + 16);  // NETSCAPE2.0
    i = after_sub_blocks(i + 2);
  }
  if (i + 1 != bytes.size()) throw std::runtime_error("bytes after the end");
  return gif;
}

}  // namespace drape::test
