#include "import/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <regex>

#include "import/motion_source.hpp"

namespace drape {
namespace {

/// Parses a type such as "<f8"; returns nothing for unsupported types.
std::optional<NumberType> numpy_type(const std::string& text) {
  if (text.size() != 3) return std::nullopt;
  const auto size = static_cast<std::size_t>(text[2] - '0');
  const bool known = size == 1 || size == 2 || size == 4 || size == 8;
  using Kind = NumberType::Kind;
  const std::optional<Kind> kind = text[1] == 'f'                     ? std::optional(Kind::real)
                                   : text[1] == 'i'                   ? std::optional(Kind::integer)
                                   : text[1] == 'u' || text[1] == 'b' ? std::optional(Kind::natural)
                                                                      : std::nullopt;
  if (!known || !kind || (*kind == Kind::real && size < 4)) return std::nullopt;
  return NumberType{*kind, size, text[0] == '>'};
}

constexpr std::size_t most_header_bytes = 1 << 20;

}  // namespace

NpyStream::NpyStream(const ZipReader& zip, const ZipReader::Member& member)
    : stream_(zip, member), name_(fmt::format("{}: {}", zip.file().string(), member.name)) {
  if (name_.ends_with(".npy")) name_.resize(name_.size() - 4);
  read_header();
}

void NpyStream::fail(const std::string& message) const { fail_import(name_, message); }

void NpyStream::read_header() {
  const std::string magic = stream_.read(8);
  if (!magic.starts_with("\x93NUMPY")) fail("it is no array of numpy's");
  const bool wide = magic[6] != 1;
  const std::string length = stream_.read(wide ? 4 : 2);
  const auto size =
      static_cast<std::size_t>(number_at(length.data(), {NumberType::Kind::natural, length.size(), false}));
  if (size > most_header_bytes) fail("its header is too long");
  const std::string header = stream_.read(size);
  std::smatch found;
  static const std::regex shape_text(R"('shape':\s*\(([0-9, L]*)\))"), plain(R"('descr':\s*'([^']*)')"),
      records(R"('descr':\s*\[(.*?)\])"), field(R"(\('([^']*)',\s*'([^']*)'\))");
  if (!std::regex_search(header, found, shape_text)) fail("its header has no shape");
  const std::string axes = found[1];
  double bytes = 1;
  for (std::size_t at = 0; (at = axes.find_first_of("0123456789", at)) != std::string::npos;) {
    std::size_t length_of_axis = 0;
    const auto read = std::from_chars(axes.data() + at, axes.data() + axes.size(), length_of_axis);
    if (read.ec != std::errc()) fail("its shape cannot be read");
    shape_.push_back(length_of_axis);
    bytes *= static_cast<double>(length_of_axis);
    at = static_cast<std::size_t>(read.ptr - axes.data());
  }
  const auto take = [&](const std::string& text) {
    const std::optional<NumberType> type = numpy_type(text);
    if (!type) fail(fmt::format("its numbers are of the type {}; expected floats or whole numbers", text));
    type_ = *type;
  };
  if (std::regex_search(header, found, plain)) {
    take(found[1]);
  } else if (std::regex_search(header, found, records)) {
    const std::string list = found[1];
    std::string common;
    for (std::sregex_iterator one(list.begin(), list.end(), field), end; one != end; ++one) {
      fields_.push_back((*one)[1]);
      if (!common.empty() && common != (*one)[2]) fail("its records have fields of several types");
      common = (*one)[2];
      take(common);
    }
  }
  if (header.find("'fortran_order': True") != std::string::npos && shape_.size() > 1) {
    fail("expected numbers in C order, found Fortran's: save numpy.ascontiguousarray of it");
  }
  bytes *= static_cast<double>(type_.size * std::max<std::size_t>(1, fields_.size()));
  if (bytes > static_cast<double>(stream_.left()))
    fail("it is damaged or cut short: its header says more than there is");
}

std::size_t NpyStream::row_size() const {
  std::size_t size = std::max<std::size_t>(1, fields_.size());
  for (std::size_t i = 1; i < shape_.size(); ++i) size *= shape_[i];
  return size;
}

std::vector<double> NpyStream::row() {
  if (next_++ >= rows()) fail("it has too few rows");
  return numbers_in(stream_.read(row_size() * type_.size), type_);
}

std::vector<double> NpyStream::rest() {
  std::vector<double> all;
  while (next_ < rows()) {
    const std::vector<double> one = row();
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

std::unique_ptr<NpyStream> array_named(const ZipReader& zip, std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    const auto found = std::ranges::find(zip.members(), name + ".npy", &ZipReader::Member::name);
    if (found != zip.members().end()) return std::make_unique<NpyStream>(zip, *found);
  }
  return nullptr;
}

}  // namespace drape
