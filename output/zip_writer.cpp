#include "output/zip_writer.hpp"

#include "output/bytes.hpp"

namespace drape {
namespace {

constexpr std::uint16_t version = 45;    // first with 64-bit sizes
constexpr std::uint16_t first_day = 33;  // 1 January 1980, the earliest date
constexpr std::uint32_t in_extra = ~0U;  // marks a size or offset stored in the extra field
constexpr std::uint16_t in_record = 0xFFFF;

/// Appends the part common to an entry's local header and its directory header.
void append_entry(std::string& header, std::uint32_t crc32, std::size_t name, std::size_t extra) {
  append_number<std::uint16_t>(header, version);
  append_number<std::uint16_t>(header, 0);  // flags
  append_number<std::uint16_t>(header, 0);  // stored
  append_number<std::uint16_t>(header, 0);  // time
  append_number<std::uint16_t>(header, first_day);
  append_number<std::uint32_t>(header, crc32);
  append_number<std::uint32_t>(header, in_extra);  // compressed
  append_number<std::uint32_t>(header, in_extra);  // uncompressed
  append_number<std::uint16_t>(header, static_cast<std::uint16_t>(name));
  append_number<std::uint16_t>(header, static_cast<std::uint16_t>(extra));
}

/// Returns the extra field with 64-bit sizes.
std::string wide_field(std::initializer_list<std::uint64_t> numbers) {
  std::string field;
  append_number<std::uint16_t>(field, 1);
  append_number<std::uint16_t>(field, static_cast<std::uint16_t>(8 * numbers.size()));
  for (const std::uint64_t number : numbers) append_number<std::uint64_t>(field, number);
  return field;
}

}  // namespace

void ZipWriter::write(std::string_view bytes) {
  file_.write(bytes);
  written_ += bytes.size();
}

void ZipWriter::begin(const std::string& name, std::uint64_t size, std::uint32_t crc32) {
  entries_.push_back({name, size, written_, crc32});
  const std::string extra = wide_field({size, size});
  std::string header = "PK\x03\x04";
  append_entry(header, crc32, name.size(), extra.size());
  write(header + name + extra);
  written_ += size;
}

void ZipWriter::finish() {
  const std::uint64_t start = written_;
  for (const Entry& entry : entries_) {
    const std::string extra = wide_field({entry.size, entry.size, entry.offset});
    std::string header = "PK\x01\x02";
    append_number<std::uint16_t>(header, version);  // of the writer
    append_entry(header, entry.crc32, entry.name.size(), extra.size());
    append_number<std::uint16_t>(header, 0);  // comment
    append_number<std::uint16_t>(header, 0);  // disk
    append_number<std::uint16_t>(header, 0);  // attributes
    append_number<std::uint32_t>(header, 0);
    append_number<std::uint32_t>(header, in_extra);  // offset
    write(header + entry.name + extra);
  }
  const std::uint64_t end = written_;

  std::string tail = "PK\x06\x06";         // end of the directory, 64-bit
  append_number<std::uint64_t>(tail, 44);  // size of the rest
  append_number<std::uint16_t>(tail, version);
  append_number<std::uint16_t>(tail, version);
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint64_t>(tail, entries_.size());
  append_number<std::uint64_t>(tail, entries_.size());
  append_number<std::uint64_t>(tail, end - start);
  append_number<std::uint64_t>(tail, start);
  tail += "PK\x06\x07";  // locator of that record
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint64_t>(tail, end);
  append_number<std::uint32_t>(tail, 1);
  tail += "PK\x05\x06";  // 16-bit end of the directory, whose values refer to the 64-bit one
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint16_t>(tail, in_record);
  append_number<std::uint16_t>(tail, in_record);
  append_number<std::uint32_t>(tail, in_extra);
  append_number<std::uint32_t>(tail, in_extra);
  append_number<std::uint16_t>(tail, 0);
  write(tail);
}

}  // namespace drape
