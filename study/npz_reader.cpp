#include "study/npz_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

constexpr std::size_t most_npz_bytes = std::size_t{1} << 31;
constexpr std::size_t most_array_bytes = std::size_t{1} << 32;

/// Little-endian numbers at places of a file. See PKWARE's APPNOTE.TXT, 4.3.
class NpzBytes {
 public:
  explicit NpzBytes(const std::filesystem::path& file) : file_(shown(file)), bytes_(read_file(file, most_npz_bytes)) {}

  [[noreturn]] void fail(const std::string& sentence) const {
    throw UsageError(fmt::format("{}: {}", file_, sentence));
  }
  [[nodiscard]] std::string_view part(std::size_t begin, std::size_t count) const {
    if (begin > bytes_.size() || count > bytes_.size() - begin) fail("it ends too early for an NPZ file");
    return std::string_view(bytes_).substr(begin, count);
  }
  [[nodiscard]] std::size_t number(std::size_t begin, std::size_t count) const {
    std::size_t value = 0;
    const std::string_view of = part(begin, count);
    for (std::size_t k = count; k-- > 0;) value = value << 8U | static_cast<unsigned char>(of[k]);
    return value;
  }
  [[nodiscard]] const std::string& all() const { return bytes_; }

 private:
  std::string file_, bytes_;
};

std::string inflated(const NpzBytes& file, std::string_view packed, std::size_t size) {
  if (size > most_array_bytes) file.fail("an array in it is too large");
  std::string result(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) file.fail("cannot unpack it");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int outcome = inflate(&stream, Z_FINISH);
  const bool complete = outcome == Z_STREAM_END && stream.total_out == size;
  inflateEnd(&stream);
  if (!complete) file.fail("an array in it is damaged");
  return result;
}

/// The text after a key of an NPY header, which is a Python dictionary as text.
std::string_view after_key(std::string_view header, std::string_view key) {
  const std::size_t place = header.find(key);
  if (place == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', place);
  return colon == std::string_view::npos ? std::string_view() : header.substr(colon + 1);
}

std::vector<std::size_t> shape_in(const NpzBytes& file, std::string_view header) {
  std::string_view text = after_key(header, "'shape'");
  const std::size_t open = text.find('('), close = text.find(')');
  if (open == std::string_view::npos || close == std::string_view::npos) file.fail("an array in it has no shape");
  text = text.substr(open + 1, close - open - 1);
  std::vector<std::size_t> shape;
  while (!text.empty()) {
    std::size_t length = 0;
    while (!text.empty() && (text.front() == ' ' || text.front() == ',')) text.remove_prefix(1);
    if (text.empty()) break;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc()) file.fail("an array in it has no shape");
    shape.push_back(length);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return shape;
}

/// The numbers of an NPY file; empty if it holds something else. See numpy.lib.format.
std::vector<NpyNumbers> numbers_in(const NpzBytes& file, const std::string& npy) {
  constexpr std::string_view magic = "\x93NUMPY";
  if (npy.size() < 12 || npy.compare(0, magic.size(), magic) != 0) file.fail("it holds something that is no array");
  const auto byte = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<unsigned char>(npy[k])); };
  const bool first_version = byte(6) == 1;
  const std::size_t begin = first_version ? 10 : 12;
  const std::size_t length = byte(8) | byte(9) << 8U | (first_version ? 0 : byte(10) << 16U | byte(11) << 24U);
  if (length > npy.size() - begin) file.fail("an array in it is damaged");
  const std::string_view header = std::string_view(npy).substr(begin, length);
  const std::string_view type = after_key(header, "'descr'"), order = after_key(header, "'fortran_order'");
  const bool wide = type.starts_with(" '<f8'"), narrow = type.starts_with(" '<f4'");
  if (!wide && !narrow) return {};
  if (!order.starts_with(" False")) file.fail("expected arrays in C order, found one in Fortran's");
  NpyNumbers numbers{shape_in(file, header), {}};
  std::size_t count = 1;
  for (const std::size_t side : numbers.shape) {
    if (side > most_array_bytes || count * side > most_array_bytes) file.fail("an array in it is too large");
    count *= side;
  }
  const std::size_t size = wide ? 8 : 4;
  if (npy.size() - begin - length < count * size) file.fail("an array in it is damaged");
  static_assert(std::endian::native == std::endian::little);
  numbers.values.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    float single = 0;
    const char* const from = npy.data() + begin + length + k * size;
    if (wide) {
      std::memcpy(&numbers.values[k], from, size);
    } else {
      std::memcpy(&single, from, size);
      numbers.values[k] = single;
    }
  }
  return {std::move(numbers)};
}

constexpr std::size_t wide_number = 0xFFFFFFFFU;  // a number that is elsewhere, in 64 bits

/// The place of the directory, and how many entries it has.
struct NpzDirectory {
  std::size_t begin = 0, count = 0;
};

NpzDirectory directory_of(const NpzBytes& bytes) {
  const std::size_t end = bytes.all().rfind("PK\x05\x06");
  if (end == std::string::npos) bytes.fail("expected an NPZ file");
  const NpzDirectory narrow{bytes.number(end + 16, 4), bytes.number(end + 10, 2)};
  if (narrow.begin != wide_number && narrow.count != 0xFFFF) return narrow;
  constexpr std::size_t locator_size = 20;
  if (end < locator_size || bytes.part(end - locator_size, 4) != "PK\x06\x07") bytes.fail("its directory is damaged");
  const std::size_t record = bytes.number(end - locator_size + 8, 8);
  if (bytes.part(record, 4) != "PK\x06\x06") bytes.fail("its directory is damaged");
  return {bytes.number(record + 48, 8), bytes.number(record + 32, 8)};
}

/// An entry of the directory.
struct NpzEntry {
  std::string name;
  std::size_t method = 0, packed = 0, size = 0, local = 0, next = 0;
};

NpzEntry entry_at(const NpzBytes& bytes, std::size_t place) {
  if (bytes.part(place, 4) != "PK\x01\x02") bytes.fail("its directory is damaged");
  NpzEntry entry;
  const std::size_t name = bytes.number(place + 28, 2), extra = bytes.number(place + 30, 2);
  entry.name = std::string(bytes.part(place + 46, name));
  entry.method = bytes.number(place + 10, 2);
  entry.packed = bytes.number(place + 20, 4);
  entry.size = bytes.number(place + 24, 4);
  entry.local = bytes.number(place + 42, 4);
  entry.next = place + 46 + name + extra + bytes.number(place + 32, 2);
  // Numbers of 64 bits follow in the extra field of kind 1: those that are needed, in this order.
  for (std::size_t field = place + 46 + name; field + 4 <= place + 46 + name + extra;) {
    const std::size_t kind = bytes.number(field, 2), size = bytes.number(field + 2, 2);
    std::size_t number = field + 4;
    for (std::size_t* value : {&entry.size, &entry.packed, &entry.local}) {
      if (kind != 1 || *value != wide_number || number + 8 > field + 4 + size) continue;
      *value = bytes.number(number, 8);
      number += 8;
    }
    field += 4 + size;
  }
  return entry;
}

}  // namespace

std::map<std::string, NpyNumbers> read_npz(const std::filesystem::path& file) {
  const NpzBytes bytes(file);
  const NpzDirectory directory = directory_of(bytes);
  std::map<std::string, NpyNumbers> arrays;
  std::size_t place = directory.begin;
  for (std::size_t k = 0; k < directory.count; ++k) {
    NpzEntry entry = entry_at(bytes, place);
    place = entry.next;
    if (entry.local > bytes.all().size()) bytes.fail("its directory is damaged");
    const std::size_t data = entry.local + 30 + bytes.number(entry.local + 26, 2) + bytes.number(entry.local + 28, 2);
    const std::string_view stored = bytes.part(data, entry.packed);
    if (entry.method != 0 && entry.method != 8) bytes.fail("it is packed in a way that numpy does not use");
    const std::string npy = entry.method == 0 ? std::string(stored) : inflated(bytes, stored, entry.size);
    if (entry.name.ends_with(".npy")) entry.name.resize(entry.name.size() - 4);
    for (NpyNumbers& numbers : numbers_in(bytes, npy)) arrays[entry.name] = std::move(numbers);
  }
  return arrays;
}

}  // namespace drape
