#include "import/ply.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "import/drape_comment.hpp"
#include "import/motion_source.hpp"
#include "import/number_bytes.hpp"

namespace drape {
namespace {

struct PlyProperty {
  std::string name;
  NumberType type;
  std::optional<NumberType> count = {};  // length type of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties = {};
};

std::optional<NumberType> ply_type(std::string_view name) {
  using Kind = NumberType::Kind;
  struct Named {
    std::string_view name, other;
    NumberType type;
  };
  static constexpr std::array<Named, 8> types{{{"char", "int8", {Kind::integer, 1, false}},
                                               {"uchar", "uint8", {Kind::natural, 1, false}},
                                               {"short", "int16", {Kind::integer, 2, false}},
                                               {"ushort", "uint16", {Kind::natural, 2, false}},
                                               {"int", "int32", {Kind::integer, 4, false}},
                                               {"uint", "uint32", {Kind::natural, 4, false}},
                                               {"float", "float32", {Kind::real, 4, false}},
                                               {"double", "float64", {Kind::real, 8, false}}}};
  for (const Named& of : types) {
    if (of.name == name || of.other == name) return of.type;
  }
  return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class PlyReader {
 public:
  PlyReader(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

  MeshFrame read() {
    frame_.time = time_in_comment(rest_);
    read_header();
    for (const PlyElement& element : elements_) read(element);
    if (positions_.empty()) fail("there is no vertex with x, y and z in the file");
    frame_.mesh.positions = vertices_of(name_, positions_);
    add_faces(name_, sizes_, corners_, frame_.mesh);
    return std::move(frame_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { fail_import(name_, message); }

  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("its header is cut short: expected end_header");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }

  void read_header() {
    if (words_of(line()) != std::vector<std::string_view>{"ply"}) fail("it is no PLY: its first line is not ply");
    while (true) {
      const std::string_view text = line();
      const std::vector<std::string_view> words = words_of(text);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") return;
      if (words[0] == "format" && words.size() > 1) {
        ascii_ = words[1] == "ascii";
        big_endian_ = words[1] == "binary_big_endian";
        if (!ascii_ && !big_endian_ && words[1] != "binary_little_endian") {
          fail(fmt::format("unknown format {}", words[1]));
        }
      } else if (words[0] == "element" && words.size() == 3) {
        PlyElement element{.name = std::string(words[1])};
        const auto read = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        if (read.ec != std::errc() || element.count > rest_.size()) {
          fail(fmt::format("expected {} {}s, but the file is too short for them", words[2], words[1]));
        }
        elements_.push_back(std::move(element));
      } else if (words[0] == "property" && !elements_.empty()) {
        elements_.back().properties.push_back(property(words));
      } else {
        fail(fmt::format("unknown line in its header: {}", text.substr(0, 60)));
      }
    }
  }

  PlyProperty property(const std::vector<std::string_view>& words) const {
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) fail("a property needs a type and a name");
    const auto type = [&](std::string_view text) {
      std::optional<NumberType> found = ply_type(text);
      if (!found) fail(fmt::format("unknown type {}", text));
      found->big_endian = big_endian_;
      return *found;
    };
    PlyProperty of{.name = std::string(words.back()), .type = type(words[list ? 3 : 1])};
    if (list) of.count = type(words[2]);
    return of;
  }

  double number(const NumberType& type) {
    if (ascii_) return word();
    if (rest_.size() < type.size) fail("it is cut short");
    const double value = number_at(rest_.data(), type);
    rest_.remove_prefix(type.size);
    return value;
  }

  double word() {
    const std::size_t begin = std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n", begin), rest_.size());
    if (begin == end) fail("it is cut short");
    double value = 0;
    const auto read = std::from_chars(rest_.data() + begin, rest_.data() + end, value);
    if (read.ec != std::errc() || read.ptr != rest_.data() + end) {
      fail(fmt::format("expected a number, found {}", rest_.substr(begin, std::min<std::size_t>(end - begin, 40))));
    }
    rest_.remove_prefix(end);
    return value;
  }

  void read(const PlyElement& element) {
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::array<std::optional<double>, 3> place;
      for (const PlyProperty& of : element.properties) {
        if (of.count) {
          read_list(of, faces && (of.name == "vertex_indices" || of.name == "vertex_index"));
          continue;
        }
        const double value = number(of.type);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (of.name == axes[axis]) place[axis] = value;
        }
      }
      if (!vertices) continue;
      for (const auto& value : place) {
        if (!value) fail("its vertices need the properties x, y and z");
        positions_.push_back(*value);
      }
    }
  }

  void read_list(const PlyProperty& of, bool kept) {
    const double count = number(*of.count);
    if (!(count >= 0 && count <= static_cast<double>(rest_.size()))) fail("it is cut short");
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const double value = number(of.type);
      if (kept) corners_.push_back(value);
    }
    if (kept) sizes_.push_back(static_cast<std::size_t>(count));
  }

  const std::string& name_;
  std::string_view rest_;
  bool ascii_ = false, big_endian_ = false;
  std::vector<PlyElement> elements_;
  std::vector<double> positions_, corners_;
  std::vector<std::size_t> sizes_;
  MeshFrame frame_;
};

}  // namespace

MeshFrame read_ply(const std::string& name, std::string_view text) { return PlyReader(name, text).read(); }

}  // namespace drape
