#include "output/gif/frame_spool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"
#include "output/gif/frame_difference.hpp"

namespace drape::gif {

FrameSpool::FrameSpool(const PartialFile& output) : spool_(output, "its frames") {}

void FrameSpool::append(const Image& image) {
  if (count_ == 0) last_ = Image(image.width, image.height);
  if (image.width != last_.width || image.height != last_.height) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  pack_difference(last_.pixels, image.pixels, packed_);
  last_.pixels = image.pixels;

  const std::uint64_t size = packed_.size();
  spool_.append({reinterpret_cast<const char*>(&size), sizeof size});
  spool_.append({reinterpret_cast<const char*>(packed_.data()), size});
  ++count_;
}

void FrameSpool::rewind() {
  spool_.rewind();
  std::fill(last_.pixels.begin(), last_.pixels.end(), std::uint8_t{0});
}

const Image& FrameSpool::next() {
  std::uint64_t size = 0;
  spool_.read(&size, sizeof size);
  packed_.resize(size);
  spool_.read(packed_.data(), size);
  if (!apply_difference(packed_, last_.pixels)) throw OutputError("a frame kept on disk has changed there");
  return last_;
}

}  // namespace drape::gif
