#include "core/spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

/// A file without a name. File systems that have none get one whose name is removed at once.
int open_nameless(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0) return descriptor;
  std::string name = (folder / ".drape-spool-XXXXXX").string();
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

Spool::Spool(const PartialFile& output, std::string kept)
    : problem_(fmt::format("cannot write {}: {} have to be kept in its folder until the last one is there",
                           shown(output.file()), kept)) {
  open(output.temporary().parent_path());
}

Spool::Spool(std::string kept) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  problem_ = fmt::format("cannot keep {} in {}", kept, shown(folder));
  open(folder);
}

void Spool::open(const std::filesystem::path& folder) {
  const int descriptor = open_nameless(folder);
  if (descriptor < 0) fail(errno);
  stream_.reset(::fdopen(descriptor, "w+b"));
  if (!stream_) fail(errno);
}

void Spool::append(std::string_view bytes) {
  if (bytes.empty()) return;  // an empty view may have no address
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail(errno);
  size_ += bytes.size();
}

void Spool::rewind() {
  if (std::fflush(stream_.get()) != 0 || std::fseek(stream_.get(), 0, SEEK_SET) != 0) fail(errno);
}

void Spool::read(void* bytes, std::size_t count) {
  if (std::fread(bytes, 1, count, stream_.get()) != count) fail(EIO);
}

void Spool::copy_to(PartialFile& file) {
  rewind();
  std::string piece(1 << 20, '\0');
  for (std::uint64_t left = size_; left > 0; left -= piece.size()) {
    piece.resize(std::min<std::uint64_t>(left, piece.size()));
    read(piece.data(), piece.size());
    file.write(piece);
  }
}

void Spool::fail(int error_number) const {
  throw OutputError(fmt::format("{}: {}", problem_, std::generic_category().message(error_number)));
}

}  // namespace drape
