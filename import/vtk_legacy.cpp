#include "import/vtk_legacy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "import/motion_source.hpp"
#include "import/number_bytes.hpp"

namespace drape {
namespace {

class LegacyReader {
 public:
  LegacyReader(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

  MeshFrame read() {
    if (!line().starts_with("# vtk DataFile")) fail("it is no legacy VTK file: it does not begin with # vtk DataFile");
    line();  // title
    const std::string format = upper(word());
    if (format != "ASCII" && format != "BINARY") fail(fmt::format("expected ASCII or BINARY, found {}", format));
    binary_ = format == "BINARY";
    if (upper(word()) != "DATASET") fail("expected DATASET");
    kind_ = upper(word());
    if (kind_ != "POLYDATA" && kind_ != "UNSTRUCTURED_GRID") {
      fail(fmt::format("expected a DATASET of POLYDATA or UNSTRUCTURED_GRID, found {}", kind_));
    }
    while (skip_blanks()) {
      if (!section(upper(word()))) break;
    }
    if (points_.empty()) fail("it has no POINTS");
    if (sizes_.empty()) fail(kind_ == "POLYDATA" ? "it has no POLYGONS" : "it has no CELLS");
    MeshFrame frame;
    frame.mesh.positions = vertices_of(name_, points_);
    add_faces(name_, sizes_, corners_, frame.mesh);
    return frame;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { fail_import(name_, message); }

  static std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return result;
  }

  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return text;
  }

  bool skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    return !rest_.empty();
  }

  std::string_view word() {
    if (!skip_blanks()) fail("it is cut short");
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return text;
  }

  double number() {
    const std::string_view text = word();
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) {
      fail(fmt::format("expected a number, found {}", text.substr(0, 40)));
    }
    return value;
  }

  std::size_t count() {
    const double value = number();
    if (!(value >= 0 && value <= static_cast<double>(rest_.size()))) fail("it is cut short");
    return static_cast<std::size_t>(value);
  }

  NumberType type(std::string_view text) const {
    using Kind = NumberType::Kind;
    static const std::map<std::string, NumberType> types{
        {"FLOAT", {Kind::real, 4, true}},           {"DOUBLE", {Kind::real, 8, true}},
        {"INT", {Kind::integer, 4, true}},          {"VTKTYPEINT64", {Kind::integer, 8, true}},
        {"VTKTYPEINT32", {Kind::integer, 4, true}}, {"LONG", {Kind::integer, 8, true}}};
    const auto found = types.find(upper(text));
    if (found == types.end()) fail(fmt::format("unknown type {}", text));
    return found->second;
  }

  std::vector<double> numbers(std::size_t amount, const NumberType& of) {
    std::vector<double> found;
    if (!binary_) {
      for (std::size_t i = 0; i < amount; ++i) found.push_back(number());
      return found;
    }
    line();  // rest of the line
    if (amount > rest_.size() / of.size) fail("it is cut short");
    found = numbers_in(rest_.substr(0, amount * of.size), of);
    rest_.remove_prefix(amount * of.size);
    return found;
  }

  /// Reads the section of this name. @returns false after the last useful section
  bool section(const std::string& name) {
    constexpr NumberType ints{NumberType::Kind::integer, 4, true};
    if (name == "POINTS") {
      const std::size_t amount = 3 * count();
      points_ = numbers(amount, type(word()));
    } else if (name == "POLYGONS" || name == "CELLS") {
      read_cells();
    } else if (name == "CELL_TYPES") {
      constexpr double triangle = 5, polygon = 7, quad = 9;
      for (const double kind : numbers(count(), ints)) {
        if (kind != triangle && kind != polygon && kind != quad) {
          fail(fmt::format("a cell is of type {}; expected polygons alone, of type 5, 7 or 9", kind));
        }
      }
    } else if (name == "METADATA") {
      while (!line().empty() && !rest_.empty()) {
      }
    } else if (name == "VERTICES" || name == "LINES" || name == "TRIANGLE_STRIPS") {
      fail(fmt::format("it has {}: expected polygons alone", name));
    } else {
      return false;  // point or cell data
    }
    return true;
  }

  void read_cells() {
    constexpr NumberType ints{NumberType::Kind::integer, 4, true};
    const std::size_t cells = count(), amount = count();
    const std::string_view before = rest_;
    if (skip_blanks() && upper(rest_.substr(0, 7)) == "OFFSETS") {  // version 5: offsets has one entry more than cells
      word();
      const std::vector<double> offsets = numbers(cells, type(word()));
      if (upper(word()) != "CONNECTIVITY") fail("expected CONNECTIVITY");
      corners_ = numbers(amount, type(word()));
      for (std::size_t i = 1; i < offsets.size(); ++i) {
        if (!(offsets[i] >= offsets[i - 1] && offsets[i] <= static_cast<double>(amount)))
          fail("its OFFSETS do not increase");
        sizes_.push_back(static_cast<std::size_t>(offsets[i] - offsets[i - 1]));
      }
      return;
    }
    rest_ = before;
    const std::vector<double> all = numbers(amount, ints);
    for (std::size_t at = 0, cell = 0; cell < cells; ++cell) {
      if (at >= all.size() || !(all[at] >= 0 && all[at] < static_cast<double>(all.size() - at)))
        fail("its list of cells is cut short");
      const auto size = static_cast<std::size_t>(all[at]);
      sizes_.push_back(size);
      corners_.insert(corners_.end(), all.begin() + static_cast<std::ptrdiff_t>(at + 1),
                      all.begin() + static_cast<std::ptrdiff_t>(at + 1 + size));
      at += size + 1;
    }
  }

  const std::string& name_;
  std::string_view rest_;
  std::string kind_;
  bool binary_ = false;
  std::vector<double> points_, corners_;
  std::vector<std::size_t> sizes_;
};

}  // namespace

MeshFrame read_vtk_legacy(const std::string& name, std::string_view text) { return LegacyReader(name, text).read(); }

}  // namespace drape
