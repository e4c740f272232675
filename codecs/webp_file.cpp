#include "codecs/webp_file.hpp"

#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace drape {
namespace {

/// Encodes a number in `bytes` bytes, little-endian.
std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i) & 0xFFU);
  return text;
}

std::string chunk(std::string_view tag, const std::string& content) {
  std::string bytes(tag);
  bytes += little_endian(content.size(), 4) + content;
  return content.size() % 2 == 0 ? bytes : bytes + '\0';
}

/// Returns the chunks of a still picture that an animation uses: its alpha and its pixels.
std::string pixels_of(const std::string& still) {
  constexpr std::size_t head = 8, first = 12;  // sizes of a chunk's header and of the file's [bytes]
  std::string chunks;
  for (std::size_t at = first; at + head <= still.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size |= std::uint32_t{static_cast<std::uint8_t>(still[at + 4 + i])} << (8 * i);
    const std::string_view tag = std::string_view(still).substr(at, 4);
    const std::size_t whole = head + size + size % 2;
    if (tag == "ALPH" || tag == "VP8 " || tag == "VP8L") chunks += still.substr(at, whole);
    at += whole;
  }
  return chunks;
}

std::string head_of(cv::Size size, std::uint64_t bytes) {
  constexpr char animated = 0x02, transparent = 0x10;
  const auto side = [](int pixels) { return little_endian(static_cast<std::uint64_t>(pixels - 1), 3); };
  const std::string features = std::string(1, animated | transparent) + std::string(3, '\0');
  const std::string black_for_ever = std::string(4, '\0') + std::string(2, '\0');  // background; 0: repeats for ever
  return "RIFF" + little_endian(bytes, 4) + "WEBP" + chunk("VP8X", features + side(size.width) + side(size.height)) +
         chunk("ANIM", black_for_ever);
}

[[noreturn]] void fail() { throw std::runtime_error(std::generic_category().message(errno == 0 ? EIO : errno)); }

}  // namespace

WebpFile::WebpFile(const std::string& file, cv::Size size) {
  constexpr int most = 16383;  // limit of libwebp
  if (size.width > most || size.height > most) throw std::runtime_error("a WebP has at most 16383 pixels a side");
  stream_.reset(std::fopen(file.c_str(), "wbe"));
  if (!stream_) fail();
  put(head_of(size, 0));
}

void WebpFile::put(const std::string& bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail();
  size_ += bytes.size();
}

void WebpFile::write_frame(std::int64_t end) {
  if (frame_.empty()) return;
  const auto three = [](std::int64_t number) { return little_endian(static_cast<std::uint64_t>(number), 3); };
  put(chunk("ANMF", three(place_.x / 2) + three(place_.y / 2) + three(place_.width - 1) + three(place_.height - 1) +
                        three(end - begin_) + std::string(1, '\0') + frame_));
}

void WebpFile::show(const std::string& still, const cv::Rect& place, std::int64_t begin) {
  write_frame(begin);
  frame_ = pixels_of(still);
  place_ = place;
  begin_ = begin;
}

void WebpFile::finish(std::int64_t end) {
  write_frame(end);
  frame_.clear();
  errno = 0;
  const std::string size = little_endian(size_ - 8, 4);  // all but "RIFF" and the size itself
  if (std::fseek(stream_.get(), 4, SEEK_SET) != 0) fail();
  put(size);
  if (std::fflush(stream_.get()) != 0) fail();
}

}  // namespace drape
