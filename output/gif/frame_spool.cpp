#include "output/gif/frame_spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "output/gif/frame_difference.hpp"

namespace drape::gif {
namespace {

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
  if (count_ == 0) last_ = Image(image.width, image.height);
  if (image.width != last_.width || image.height != last_.height) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  pack_difference(last_.pixels, image.pixels, packed_);
  last_.pixels = image.pixels;

  const std::uint64_t size = packed_.size();
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
  std::uint64_t size = 0;
  if (std::fread(&size, sizeof size, 1, stream_.get()) != 1) fail(EIO);
  packed_.resize(size);
  if (std::fread(packed_.data(), 1, size, stream_.get()) != size) fail(EIO);
  if (!apply_difference(packed_, last_.pixels)) fail(EIO);
  return last_;
}

void FrameSpool::fail(int error_number) const {
  throw OutputError(
      fmt::format("cannot write {}: its frames have to be kept in its folder until the last one is drawn: {}",
                  file_.string(), std::generic_category().message(error_number)));
}

}  // namespace drape::gif
