#include "motion/packing.hpp"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "core/byte_planes.hpp"

namespace drape {
namespace {

// Numbers are stored in the native format of the supported machines.
static_assert(std::endian::native == std::endian::little && std::numeric_limits<double>::is_iec559);

constexpr std::uint64_t most_packed = 1100;  // upper bound of zlib's compression ratio

std::string deflated(std::string_view bytes, int strategy) {
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, 15, 9, strategy) != Z_OK) throw std::bad_alloc();
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  std::size_t made = 0;
  int result = Z_OK;
  while (result == Z_OK) {  // zlib counts in 32 bits
    constexpr std::size_t piece = std::size_t{1} << 30;
    const auto in = static_cast<uInt>(std::min(bytes.size(), piece));
    const auto out = static_cast<uInt>(std::min(packed.size() - made, piece));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = in;
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + made);
    stream.avail_out = out;
    result = deflate(&stream, in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    bytes.remove_prefix(in - stream.avail_in);
    made += out - stream.avail_out;
  }
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::bad_alloc();
  packed.resize(made);
  return packed;
}

std::string packed(std::string_view bytes, int strategy) {
  return ByteWriter().whole(bytes.size()).bytes(deflated(bytes, strategy)).text();
}

}  // namespace

std::string pack(std::string_view bytes) { return packed(bytes, Z_DEFAULT_STRATEGY); }

std::string pack_planes(const std::vector<std::uint64_t>& words) { return packed(byte_planes(words), Z_RLE); }

std::string unpack(std::string_view packed, std::uint64_t most) {
  ByteReader reader(packed);
  const std::uint64_t size = reader.whole();
  if (size > most) throw std::invalid_argument("has a part of another size than it should have");
  packed = reader.rest();
  if (size / most_packed > packed.size())
    throw std::invalid_argument("says of a part that it is larger than it can be");
  std::string bytes(size, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  std::size_t made = 0;
  int result = Z_OK;
  while (result == Z_OK) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    const auto in = static_cast<uInt>(std::min(packed.size(), piece));
    const auto out = static_cast<uInt>(std::min(bytes.size() - made, piece));
    Bytef nothing = 0;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = in;
    stream.next_out = out > 0 ? reinterpret_cast<Bytef*>(bytes.data() + made) : &nothing;
    stream.avail_out = out;
    result = inflate(&stream, Z_NO_FLUSH);
    packed.remove_prefix(in - stream.avail_in);
    made += out - stream.avail_out;
  }
  inflateEnd(&stream);
  if (result != Z_STREAM_END || made != size || !packed.empty()) {
    throw std::invalid_argument("has a part that cannot be unpacked");
  }
  return bytes;
}

std::vector<std::uint64_t> unpack_planes(std::string_view packed, std::size_t count) {
  const std::string bytes = unpack(packed, 8 * std::uint64_t{count});
  if (bytes.size() / 8 != count || bytes.size() % 8 != 0) {
    throw std::invalid_argument("has a part of another size than it should have");
  }
  return from_byte_planes(bytes);
}

ByteWriter& ByteWriter::whole(std::uint64_t number) {
  bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  return *this;
}

ByteWriter& ByteWriter::number(double value) { return whole(std::bit_cast<std::uint64_t>(value)); }

std::uint64_t ByteReader::whole() {
  std::uint64_t number = 0;
  if (bytes_.size() < sizeof number) throw std::invalid_argument("has a part that is cut off");
  std::memcpy(&number, bytes_.data(), sizeof number);
  bytes_.remove_prefix(sizeof number);
  return number;
}

double ByteReader::number() { return std::bit_cast<double>(whole()); }

}  // namespace drape
