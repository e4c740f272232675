#include "import/vtk_xml.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>
#include <zlib.h>

#include <charconv>
#include <cstring>
#include <map>
#include <optional>

#include "import/motion_source.hpp"
#include "import/number_bytes.hpp"

namespace drape {
namespace {

using Element = tinyxml2::XMLElement;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 32;  // limit of an array

std::string attribute(const Element& of, const char* key) {
  const char* const text = of.Attribute(key);
  return text == nullptr ? "" : text;
}

std::optional<NumberType> vtk_type(const std::string& name) {
  using Kind = NumberType::Kind;
  static const std::map<std::string, NumberType> types{
      {"Int8", {Kind::integer, 1, false}},  {"UInt8", {Kind::natural, 1, false}},
      {"Int16", {Kind::integer, 2, false}}, {"UInt16", {Kind::natural, 2, false}},
      {"Int32", {Kind::integer, 4, false}}, {"UInt32", {Kind::natural, 4, false}},
      {"Int64", {Kind::integer, 8, false}}, {"UInt64", {Kind::natural, 8, false}},
      {"Float32", {Kind::real, 4, false}},  {"Float64", {Kind::real, 8, false}}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

/// Returns the value of a base64 letter; −1 for any other character.
int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

class VtkXml {
 public:
  VtkXml(const std::string& name, const std::string& text) : name_(name) {
    parse(cut_out_appended(text));
    root_ = document_.FirstChildElement("VTKFile");
    if (root_ == nullptr) fail("it is no VTK XML file: there is no element VTKFile");
    big_endian_ = attribute(*root_, "byte_order") == "BigEndian";
    header_size_ = attribute(*root_, "header_type") == "UInt64" ? 8 : 4;
    const std::string compressor = attribute(*root_, "compressor");
    compressed_ = !compressor.empty();
    if (compressed_ && compressor != "vtkZLibDataCompressor") {
      fail(fmt::format("its data are compressed with {}: write it with zlib or uncompressed", compressor));
    }
  }

  [[noreturn]] void fail(const std::string& message) const { fail_import(name_, message); }
  [[nodiscard]] const Element& root() const { return *root_; }

  /// Returns the numbers of a DataArray.
  [[nodiscard]] std::vector<double> numbers(const Element& array) const {
    std::optional<NumberType> type = vtk_type(attribute(array, "type"));
    if (!type)
      fail(fmt::format("the array {} has the unknown type {}", attribute(array, "Name"), attribute(array, "type")));
    type->big_endian = big_endian_;
    const std::string format = attribute(array, "format");
    const char* const text = array.GetText();
    if (format == "ascii") return ascii(array, text == nullptr ? "" : text);
    if (format == "appended") return numbers_in(appended(array), *type);
    return numbers_in(encoded(array, text == nullptr ? "" : text), *type);
  }

 private:
  /// Cuts out the bytes behind the underscore of AppendedData, raw or encoded, as they may be invalid XML.
  std::string cut_out_appended(const std::string& text) {
    const std::size_t element = text.find("<AppendedData");
    if (element == std::string::npos) return text;
    const std::size_t begin = text.find('_', text.find('>', element)), end = text.rfind("</AppendedData>");
    if (begin == std::string::npos || end == std::string::npos || end < begin) fail("its appended data are cut short");
    appended_ = text.substr(begin + 1, end - begin - 1);
    raw_ = text.substr(element, begin - element).find("\"raw\"") != std::string::npos;
    return text.substr(0, begin + 1) + text.substr(end);
  }

  void parse(const std::string& text) {
    if (document_.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return;
    fail(fmt::format("it is no whole XML file: line {} cannot be read", document_.ErrorLineNum()));
  }

  std::vector<double> ascii(const Element& array, std::string_view text) const {
    std::vector<double> found;
    while (true) {
      const std::size_t begin = text.find_first_not_of(" \t\r\n");
      if (begin == std::string_view::npos) return found;
      text.remove_prefix(begin);
      const std::size_t end = std::min(text.find_first_of(" \t\r\n"), text.size());
      double value = 0;
      const auto read = std::from_chars(text.data(), text.data() + end, value);
      if (read.ec != std::errc() || read.ptr != text.data() + end) {
        fail(fmt::format("the array {} has {} where a number should be", attribute(array, "Name"),
                         text.substr(0, std::min<std::size_t>(end, 40))));
      }
      found.push_back(value);
      text.remove_prefix(end);
    }
  }

  [[nodiscard]] std::string appended(const Element& array) const {
    const int offset = array.IntAttribute("offset", -1);
    if (offset < 0 || static_cast<std::size_t>(offset) >= appended_.size()) {
      fail(fmt::format("the array {} is not in the file's appended data", attribute(array, "Name")));
    }
    const std::string_view from = std::string_view(appended_).substr(static_cast<std::size_t>(offset));
    return raw_ ? block(array, from) : encoded(array, from);
  }

  /// Decodes base64. A header of sizes may be encoded separately.
  [[nodiscard]] std::string encoded(const Element& array, std::string_view text) const {
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
      if (c == '=') {  // end of a part: start again
        bits = 0;
        count = 0;
        continue;
      }
      const int value = base64_value(c);
      if (value < 0) {
        if (std::strchr(" \t\r\n", c) != nullptr) continue;
        fail(fmt::format("the array {} is no base64", attribute(array, "Name")));
      }
      bits = bits << 6 | static_cast<std::uint32_t>(value);
      count += 6;
      if (count < 8) continue;
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xFF);
    }
    return block(array, bytes);
  }

  [[nodiscard]] std::uint64_t size_at(const Element& array, std::string_view bytes, std::size_t place) const {
    const std::size_t at = place * header_size_;
    if (bytes.size() < at + header_size_) fail_cut(array);
    const NumberType type{NumberType::Kind::natural, header_size_, big_endian_};
    return static_cast<std::uint64_t>(number_at(bytes.data() + at, type));
  }

  [[noreturn]] void fail_cut(const Element& array) const {
    fail(fmt::format("the array {} is cut short", attribute(array, "Name")));
  }

  /// Returns the bytes of a block after its size, or uncompresses its pieces after their sizes.
  [[nodiscard]] std::string block(const Element& array, std::string_view bytes) const {
    const std::uint64_t first = size_at(array, bytes, 0);
    if (!compressed_) {
      if (first > bytes.size() - header_size_) fail_cut(array);
      return std::string(bytes.substr(header_size_, first));
    }
    const std::uint64_t size = size_at(array, bytes, 1), last = size_at(array, bytes, 2);
    if (first > bytes.size() || size > most_bytes || last > most_bytes || first * size > most_bytes) fail_cut(array);
    std::size_t at = (3 + first) * header_size_;
    std::string result;
    for (std::uint64_t i = 0; i < first; ++i) {
      const std::uint64_t packed = size_at(array, bytes, 3 + i);
      if (at > bytes.size() || packed > bytes.size() - at) fail_cut(array);
      uLongf wanted = i + 1 == first && last > 0 ? last : size;
      std::string piece(wanted, '\0');
      if (uncompress(reinterpret_cast<Bytef*>(piece.data()), &wanted, reinterpret_cast<const Bytef*>(bytes.data() + at),
                     packed) != Z_OK) {
        fail_cut(array);
      }
      piece.resize(wanted);
      result += piece;
      at += packed;
    }
    return result;
  }

  const std::string& name_;
  tinyxml2::XMLDocument document_;
  const Element* root_ = nullptr;
  std::string appended_;
  bool raw_ = false, big_endian_ = false, compressed_ = false;
  std::size_t header_size_ = 4;
};

const Element* named(const Element* parent, const char* name) {
  for (const Element* array = parent == nullptr ? nullptr : parent->FirstChildElement("DataArray"); array != nullptr;
       array = array->NextSiblingElement("DataArray")) {
    if (attribute(*array, "Name") == name) return array;
  }
  return nullptr;
}

std::vector<Eigen::Vector4d> fours(const std::vector<double>& numbers) {
  std::vector<Eigen::Vector4d> found;
  for (std::size_t i = 0; i + 4 <= numbers.size(); i += 4) found.emplace_back(&numbers[i]);
  return found;
}

void read_fields(const VtkXml& file, const Element* fields, MeshFrame& frame) {
  const auto one = [&](const char* name) -> std::optional<double> {
    const Element* const array = named(fields, name);
    if (array == nullptr) return std::nullopt;
    const std::vector<double> numbers = file.numbers(*array);
    return numbers.empty() ? std::nullopt : std::optional(numbers.front());
  };
  frame.time = one("TimeValue");
  const auto kinetic = one("kinetic_energy"), gravity = one("gravity_energy"), elastic = one("elastic_energy");
  if (kinetic && gravity && elastic) frame.energies = {.kinetic = *kinetic, .gravity = *gravity, .elastic = *elastic};
  if (const Element* spheres = named(fields, "spheres")) frame.spheres = fours(file.numbers(*spheres));
  if (const Element* grounds = named(fields, "grounds")) frame.grounds = fours(file.numbers(*grounds));
}

void read_polygons(const VtkXml& file, const std::string& name, const Element* cells, Mesh& mesh) {
  const Element *const corners = named(cells, "connectivity"), *const ends = named(cells, "offsets");
  if (corners == nullptr || ends == nullptr) file.fail("it has no polygons");
  std::vector<std::size_t> sizes;
  double before = 0;
  for (const double end : file.numbers(*ends)) {
    if (!(end >= before && end - before < 1e9)) file.fail("the offsets of its polygons do not increase");
    sizes.push_back(static_cast<std::size_t>(end - before));
    before = end;
  }
  add_faces(name, sizes, file.numbers(*corners), mesh);
}

/// Reads the point data marked as texture coordinates, one pair for each vertex.
void read_texture_coordinates(const VtkXml& file, const Element* points, Mesh& mesh) {
  const Element* const array = points == nullptr ? nullptr : named(points, attribute(*points, "TCoords").c_str());
  if (array == nullptr) return;
  const std::vector<double> pairs = file.numbers(*array);
  if (pairs.size() != 2 * static_cast<std::size_t>(mesh.positions.rows())) return;
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) {
      const auto at = 2 * static_cast<std::size_t>(v);
      mesh.uvs.push_back({static_cast<float>(pairs[at]), static_cast<float>(pairs[at + 1])});
    }
  }
}

}  // namespace

MeshFrame read_vtk_xml(const std::string& name, const std::string& text) {
  const VtkXml file(name, text);
  const bool grid = attribute(file.root(), "type") == "UnstructuredGrid";
  const Element* const data = file.root().FirstChildElement(grid ? "UnstructuredGrid" : "PolyData");
  const Element* const piece = data == nullptr ? nullptr : data->FirstChildElement("Piece");
  if (piece == nullptr) file.fail("expected a piece of PolyData or of an UnstructuredGrid");
  if (piece->NextSiblingElement("Piece") != nullptr) file.fail("it has several pieces: write it as one");
  const Element* const points = piece->FirstChildElement("Points");
  const Element* const array = points == nullptr ? nullptr : points->FirstChildElement("DataArray");
  if (array == nullptr) file.fail("it has no points");
  MeshFrame frame;
  frame.mesh.positions = vertices_of(name, file.numbers(*array));
  const int expected = piece->IntAttribute("NumberOfPoints", 0);
  if (frame.mesh.positions.rows() != expected) {
    file.fail(fmt::format("it has {} points, and says that there are {}", frame.mesh.positions.rows(), expected));
  }
  read_polygons(file, name, piece->FirstChildElement(grid ? "Cells" : "Polys"), frame.mesh);
  if (const Element* velocity = named(piece->FirstChildElement("PointData"), "velocity")) {
    frame.velocities = vertices_of(name, file.numbers(*velocity));
  }
  read_texture_coordinates(file, piece->FirstChildElement("PointData"), frame.mesh);
  read_fields(file, data->FirstChildElement("FieldData"), frame);
  return frame;
}

std::vector<PvdEntry> read_pvd(const std::string& name, const std::string& text) {
  const VtkXml file(name, text);
  const Element* const collection = file.root().FirstChildElement("Collection");
  std::vector<PvdEntry> entries;
  for (const Element* of = collection == nullptr ? nullptr : collection->FirstChildElement("DataSet"); of != nullptr;
       of = of->NextSiblingElement("DataSet")) {
    PvdEntry entry{.part = of->IntAttribute("part", 0), .file = attribute(*of, "file")};
    if (of->QueryDoubleAttribute("timestep", &entry.time) != tinyxml2::XML_SUCCESS || entry.file.empty()) {
      file.fail(fmt::format("line {}: a DataSet needs a timestep and a file", of->GetLineNum()));
    }
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) file.fail("it names no file: there is no DataSet in a Collection");
  return entries;
}

}  // namespace drape
