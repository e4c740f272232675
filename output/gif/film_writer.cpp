#include "output/gif/film_writer.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "output/gif/palette.hpp"

namespace drape::gif {
namespace {

using namespace std::string_literals;

void put(std::string& bytes, std::initializer_list<int> values) {
  for (const int value : values) bytes.push_back(static_cast<char>(value));
}

/// Writes 16-bit numbers, little-endian.
void put_words(std::string& bytes, std::initializer_list<int> values) {
  for (const int value : values) put(bytes, {value & 0xff, value >> 8});
}

constexpr int extension = 0x21, image = 0x2c, trailer = 0x3b;
constexpr int graphic_control = 0xf9, application = 0xff;

}  // namespace

Container::Container(PartialFile& file, int width, int height, const Palette& palette) : file_(file) {
  std::string bytes = "GIF89a";
  put_words(bytes, {width, height});
  put(bytes, {0xf7, 0, 0});  // a table of 2⁷⁺¹ colours, of 8 bits a channel; no background, square pixels
  for (const std::uint32_t color : palette.colors) put(bytes, {red(color), green(color), blue(color)});
  put(bytes, {extension, application, 11});
  bytes += "NETSCAPE2.0";
  put(bytes, {3, 1});
  put_words(bytes, {0});  // repeats for ever
  put(bytes, {0});
  file_.write(bytes);
}

std::size_t Container::add(const Patch& patch, std::int64_t duration) {
  constexpr std::int64_t longest = 0xffff;
  std::string bytes;
  put(bytes, {extension, graphic_control, 4, 1 << 2 | 1});  // keeps the previous picture; has a transparent colour
  put_words(bytes, {static_cast<int>(std::min(duration, longest))});
  put(bytes, {Palette::transparent, 0, image});
  put_words(bytes, {patch.x, patch.y, patch.width, patch.height});
  put(bytes, {0});  // no local colour table
  bytes += patch.data;
  file_.write(bytes);
  return bytes.size();
}

void Container::finish() { file_.write(std::string(1, static_cast<char>(trailer))); }

FilmWriter::FilmWriter(PartialFile& file, int width, int height, const Palette& palette)
    : dither_(palette, width, height),
      compactor_(palette, width, height),
      container_(file, width, height, palette),
      bytes_per_frame_(0.14 * width * height) {}

int FilmWriter::tolerance() const {
  // Proportional to the debt, so that it settles at the allowed size. A larger tolerance would fray edges.
  constexpr double largest = 32, frames_of_debt = 8;
  return static_cast<int>(std::clamp(largest * debt_ / (frames_of_debt * bytes_per_frame_), 0.0, largest));
}

void FilmWriter::add(const Image& image, std::int64_t duration) {
  const Patch patch = compactor_.compact(dither_.apply(image), tolerance());
  debt_ += static_cast<double>(container_.add(patch, duration)) - bytes_per_frame_;
}

}  // namespace drape::gif
