#include "import/zip_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "import/motion_source.hpp"
#include "import/number_bytes.hpp"

namespace drape {
namespace {

std::uint64_t whole(const std::string& bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) return 0;
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, size);
  return value;
}

std::string bytes_at(std::ifstream& stream, std::uint64_t begin, std::uint64_t count) {
  std::string bytes(count, '\0');
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(begin));
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return bytes;
}

constexpr std::uint64_t most_directory_bytes = 100'000'000;

}  // namespace

ZipReader::ZipReader(std::filesystem::path file) : file_(std::move(file)) {
  const std::string name = file_.string();
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file_, error);
  std::ifstream stream(file_, std::ios::binary);
  if (error || !stream) fail_import(name, "the file cannot be read: " + (error ? error.message() : "no permission"));
  const auto fail = [&]() {
    fail_import(name, "expected an NPZ file, found no directory of one: it is cut short, or something else");
  };
  const std::uint64_t tail_size = std::min<std::uint64_t>(size, 22 + 65535 + 20);
  const std::string tail = bytes_at(stream, size - tail_size, tail_size);
  const std::size_t end = tail.rfind("PK\x05\x06");
  if (end == std::string::npos) fail();
  std::uint64_t bytes = whole(tail, end + 12, 4), begin = whole(tail, end + 16, 4), count = whole(tail, end + 10, 2);
  if (end >= 20 && tail.compare(end - 20, 4, "PK\x06\x07") == 0) {
    const std::string wide = bytes_at(stream, whole(tail, end - 20 + 8, 8), 56);
    if (wide.size() < 56 || !wide.starts_with("PK\x06\x06")) fail();
    count = whole(wide, 32, 8);
    bytes = whole(wide, 40, 8);
    begin = whole(wide, 48, 8);
  }
  if (bytes > most_directory_bytes || begin > size || bytes > size - begin) fail();
  const std::string directory = bytes_at(stream, begin, bytes);
  for (std::size_t at = 0; members_.size() < count;) {
    if (directory.compare(at, 4, "PK\x01\x02") != 0) fail();
    const std::size_t name_size = whole(directory, at + 28, 2), extra_size = whole(directory, at + 30, 2);
    Member member{.name = directory.substr(at + 46, name_size),
                  .offset = whole(directory, at + 42, 4),
                  .packed = whole(directory, at + 20, 4),
                  .size = whole(directory, at + 24, 4)};
    const std::uint64_t method = whole(directory, at + 10, 2);
    if (method != 0 && method != 8)
      fail_import(name, fmt::format("its member {} is packed in an unknown way", member.name));
    member.deflated = method == 8;
    for (std::size_t extra = at + 46 + name_size, last = extra + extra_size;
         extra + 4 <= last && extra + 4 <= directory.size();) {
      const std::size_t length = whole(directory, extra + 2, 2);
      if (whole(directory, extra, 2) == 1) {  // 64-bit sizes, for fields at their maximum
        std::size_t field = extra + 4;
        for (std::uint64_t* number : {&member.size, &member.packed, &member.offset}) {
          if (*number != 0xFFFFFFFF) continue;
          *number = whole(directory, field, 8);
          field += 8;
        }
      }
      extra += 4 + length;
    }
    if (member.offset > size || member.packed > size) fail();
    members_.push_back(std::move(member));
    at += 46 + name_size + extra_size + whole(directory, at + 32, 2);
    if (at > directory.size()) fail();
  }
}

struct ZipStream::Inflater {
  z_stream state{};
  std::string input = {};
  Inflater() { inflateInit2(&state, -MAX_WBITS); }
  ~Inflater() { inflateEnd(&state); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

ZipStream::ZipStream(const ZipReader& zip, const ZipReader::Member& member)
    : name_(fmt::format("{}: {}", zip.file().string(), member.name)),
      stream_(zip.file(), std::ios::binary),
      packed_left_(member.packed),
      left_(member.size) {
  const std::string header = bytes_at(stream_, member.offset, 30);
  if (header.size() < 30 || !header.starts_with("PK\x03\x04")) fail_cut();
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(member.offset + 30 + whole(header, 26, 2) + whole(header, 28, 2)));
  if (member.deflated) {
    inflater_ = std::make_unique<Inflater>();
  } else if (packed_left_ < left_) {
    fail_cut();
  }
}

ZipStream::~ZipStream() = default;

void ZipStream::fail_cut() const { fail_import(name_, "it is damaged or cut short"); }

std::string ZipStream::read(std::size_t count) {
  if (count > left_) fail_cut();
  std::string bytes;
  left_ -= count;
  if (!inflater_) {
    bytes.resize(count);
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!stream_) fail_cut();
    return bytes;
  }
  bytes.resize(count);
  z_stream& state = inflater_->state;
  constexpr std::size_t piece = 1 << 16;
  for (std::size_t done = 0; done < count;) {
    if (state.avail_in == 0) {
      inflater_->input.resize(static_cast<std::size_t>(std::min<std::uint64_t>(piece, packed_left_)));
      stream_.read(inflater_->input.data(), static_cast<std::streamsize>(inflater_->input.size()));
      if (!stream_ || inflater_->input.empty()) fail_cut();
      packed_left_ -= inflater_->input.size();
      state.next_in = reinterpret_cast<Bytef*>(inflater_->input.data());
      state.avail_in = static_cast<uInt>(inflater_->input.size());
    }
    const std::size_t wanted = std::min<std::size_t>(count - done, std::size_t{1} << 30);
    state.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
    state.avail_out = static_cast<uInt>(wanted);
    const int result = inflate(&state, Z_NO_FLUSH);
    done += wanted - state.avail_out;
    if (result == Z_STREAM_END && done < count) fail_cut();
    if (result != Z_OK && result != Z_STREAM_END && !(result == Z_BUF_ERROR && state.avail_in == 0)) fail_cut();
  }
  return bytes;
}

}  // namespace drape
