#include "output/frame_spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace drape {
namespace {

/// Fast, and on frames of a film, of which most does not change, as small as the higher levels.
constexpr int compression_level = 1;

/// A file without a name. File systems that have none get one whose name is removed at once.
int open_nameless(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0) return descriptor;
  std::string name = (folder / ".drape-frames-XXXXXX").string();
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

FrameSpool::FrameSpool(const PartialFile& output) : file_(output.file()) {
  const int descriptor = open_nameless(output.temporary().parent_path());
  if (descriptor < 0) fail(errno);
  stream_.reset(::fdopen(descriptor, "w+b"));
  if (!stream_) fail(errno);
}

void FrameSpool::append(const Image& image) {
  if (count_ == 0) {
    last_ = Image(image.width, image.height);
    delta_.resize(last_.pixels.size());
    packed_.resize(compressBound(delta_.size()));
  }
  if (image.width != last_.width || image.height != last_.height) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  std::transform(image.pixels.begin(), image.pixels.end(), last_.pixels.begin(), delta_.begin(), std::bit_xor<>());
  last_.pixels = image.pixels;

  uLongf size = packed_.size();
  if (compress2(packed_.data(), &size, delta_.data(), delta_.size(), compression_level) != Z_OK) throw std::bad_alloc();
  const bool written = std::fwrite(&size, sizeof size, 1, stream_.get()) == 1 &&
                       std::fwrite(packed_.data(), 1, size, stream_.get()) == size;
  if (!written) fail(errno);
  ++count_;
}

void FrameSpool::rewind() {
  if (std::fflush(stream_.get()) != 0 || std::fseek(stream_.get(), 0, SEEK_SET) != 0) fail(errno);
  std::fill(last_.pixels.begin(), last_.pixels.end(), std::uint8_t{0});
}

const Image& FrameSpool::next() {
  uLongf packed_size = 0, size = delta_.size();
  const bool read = std::fread(&packed_size, sizeof packed_size, 1, stream_.get()) == 1 &&
                    packed_size <= packed_.size() &&
                    std::fread(packed_.data(), 1, packed_size, stream_.get()) == packed_size;
  if (!read) fail(EIO);
  if (uncompress(delta_.data(), &size, packed_.data(), packed_size) != Z_OK || size != delta_.size()) fail(EIO);
  std::transform(delta_.begin(), delta_.end(), last_.pixels.begin(), last_.pixels.begin(), std::bit_xor<>());
  return last_;
}

void FrameSpool::fail(int error_number) const {
  throw OutputError(
      fmt::format("cannot write {}: its frames have to be kept in its folder until the last one is drawn: {}",
                  file_.string(), std::generic_category().message(error_number)));
}

}  // namespace drape
