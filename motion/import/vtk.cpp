#include <fmt/format.h>
#include <tinyxml2.h>
#include <zlib.h>
#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/import/motion_source.hpp"
#include "motion/import/npz.hpp"

namespace drape {
namespace {

/// Checks the types of a grid's cells.
void require_polygons(const std::string& name, const std::vector<double>& types) {
  constexpr double triangle = 5, polygon = 7, quad = 9;
  for (const double type : types) {
    if (type == triangle || type == polygon || type == quad) continue;
    fail_import(name, fmt::format("a cell is of type {}; expected polygons alone, of type 5, 7 or 9", type));
  }
}

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
    frame.time = time_;
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
        {"VTKTYPEINT32", {Kind::integer, 4, true}}, {"LONG", {Kind::integer, 8, true}},
        {"CHAR", {Kind::integer, 1, true}},         {"UNSIGNED_CHAR", {Kind::natural, 1, true}},
        {"SHORT", {Kind::integer, 2, true}},        {"UNSIGNED_SHORT", {Kind::natural, 2, true}},
        {"UNSIGNED_INT", {Kind::natural, 4, true}}, {"UNSIGNED_LONG", {Kind::natural, 8, true}}};
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
      require_polygons(name_, numbers(count(), ints));
    } else if (name == "FIELD") {
      read_field();
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

  /// Reads the arrays of a field, of which only the time counts.
  void read_field() {
    word();  // name of the field
    for (std::size_t arrays = count(); arrays > 0; --arrays) {
      std::string_view name = word();
      while (upper(name) == "METADATA") {
        while (!line().empty() && !rest_.empty()) {
        }
        name = word();
      }
      const std::size_t components = count(), tuples = count();
      const std::vector<double> values = numbers(components * tuples, type(word()));
      if (name == "TimeValue" && values.size() == 1) time_ = values.front();
    }
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
  std::optional<double> time_;
};

}  // namespace

MeshFrame read_vtk_legacy(const std::string& name, std::string_view text) { return LegacyReader(name, text).read(); }

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
    const std::optional<std::string> bytes = from_base64(text);
    if (!bytes) fail(fmt::format("the array {} is no base64", attribute(array, "Name")));
    return block(array, *bytes);
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
  if (const Element* const types = named(cells, "types")) require_polygons(name, file.numbers(*types));
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

namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_bytes_of_list = 200'000'000;

/// Returns the triangles that belong to no sphere and no ground: those of pieces with a vertex off all of them. drape
/// writes spheres, grounds and bodies as one mesh.
std::vector<Triangle> triangles_of_bodies(const MeshFrame& shapes, const Mesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.positions.rows());
  std::vector<std::size_t> piece(count);
  std::iota(piece.begin(), piece.end(), std::size_t{0});
  const auto root = [&](std::size_t v) {
    while (piece[v] != v) v = piece[v] = piece[piece[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) piece[root(static_cast<std::size_t>(v))] = root(static_cast<std::size_t>(t[0]));
  }
  constexpr double rounding = 1e-6;
  const double size = mesh.positions.cwiseAbs().maxCoeff();
  const auto on_all = [&](const auto& gap_to, const std::vector<Eigen::Vector4d>& all, std::vector<char>& bodies) {
    for (const Eigen::Vector4d& one : all) {
      std::vector<char> off(count, 0);  // by root
      for (std::size_t v = 0; v < count; ++v) {
        const double gap = gap_to(one, Eigen::Vector3d(mesh.positions.row(static_cast<Eigen::Index>(v)).transpose()));
        if (!(std::abs(gap) <= rounding * size)) off[root(v)] = 1;
      }
      for (std::size_t v = 0; v < count; ++v) bodies[v] = static_cast<char>(bodies[v] != 0 && off[root(v)] != 0);
    }
  };
  std::vector<char> bodies(count, 1);
  on_all([](const Eigen::Vector4d& s, const Eigen::Vector3d& p) { return (p - s.head<3>()).norm() - s[3]; },
         shapes.spheres, bodies);
  on_all([](const Eigen::Vector4d& g, const Eigen::Vector3d& p) { return g.head<3>().dot(p) - g[3]; }, shapes.grounds,
         bodies);
  std::vector<Triangle> kept;
  std::ranges::copy_if(mesh.triangles, std::back_inserter(kept),
                       [&](const Triangle& t) { return bodies[static_cast<std::size_t>(t[0])] != 0; });
  return kept;
}

/// The files of one part of a collection.
class PvdPart final : public MotionSource {
 public:
  PvdPart(std::string name, std::vector<double> times, std::vector<fs::path> files,
          std::vector<std::shared_ptr<PvdPart>> bodies)
      : name_(std::move(name)), times_(std::move(times)), files_(std::move(files)), bodies_(std::move(bodies)) {
    first_ = read_mesh_frame(files_.front());
    require_finite(files_.front().string(), first_.mesh.positions);
    mesh_ = first_.mesh;
  }

  /// Removes the triangles of spheres and grounds; returns false if none remain.
  bool keep_bodies(const MeshFrame& shapes) {
    if (shapes.spheres.empty() && shapes.grounds.empty()) return true;
    mesh_.triangles = triangles_of_bodies(shapes, first_.mesh);
    std::vector<int> numbers(static_cast<std::size_t>(first_.mesh.positions.rows()), -1);
    for (const Triangle& triangle : mesh_.triangles) {
      for (const int v : triangle) numbers[static_cast<std::size_t>(v)] = 0;
    }
    kept_.clear();
    for (std::size_t v = 0; v < numbers.size(); ++v) {
      if (numbers[v] < 0) continue;
      numbers[v] = static_cast<int>(kept_.size());
      kept_.push_back(static_cast<int>(v));
    }
    for (Triangle& triangle : mesh_.triangles) {
      for (int& v : triangle) v = numbers[static_cast<std::size_t>(v)];
    }
    mesh_.positions = first_.mesh.positions(kept_, Eigen::all);
    mesh_.uvs.clear();
    return !kept_.empty();
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<fs::path> files() const override {
    std::vector<fs::path> all{name_};
    all.insert(all.end(), files_.begin(), files_.end());
    return all;
  }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return files_.size(); }
  [[nodiscard]] std::vector<double> times() override { return times_; }

  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    MeshFrame frame = i == 0 ? first_ : read_mesh_frame(files_[i]);
    require_same_mesh(files_[i].string(), first_.mesh, frame.mesh);
    if (!kept_.empty()) return {.x = frame.mesh.positions(kept_, Eigen::all)};
    return {.x = std::move(frame.mesh.positions), .v = std::move(frame.velocities), .energies = frame.energies};
  }

  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders found;
    for (const auto& body : bodies_) {
      if (body->keep_bodies(first_)) found.bodies.push_back(body);
    }
    if (first_.spheres.empty() && first_.grounds.empty()) return found;
    for (const fs::path& file : files_) {
      const MeshFrame frame = &file == &files_.front() ? first_ : read_mesh_frame(file);
      found.spheres.by_moment.push_back(frame.spheres);
      found.grounds.by_moment.push_back(frame.grounds);
    }
    return found;
  }

 private:
  std::string name_;
  std::vector<double> times_;
  std::vector<fs::path> files_;
  std::vector<std::shared_ptr<PvdPart>> bodies_;
  MeshFrame first_;
  Mesh mesh_;
  std::vector<int> kept_;  // vertices of bodies; empty: all
};

}  // namespace

std::unique_ptr<MotionSource> open_pvd(const fs::path& file) {
  const std::string name = file.string();
  struct Part {
    std::vector<double> times;
    std::vector<fs::path> files;
  };
  std::map<int, Part> parts;
  for (const PvdEntry& entry : read_pvd(name, read_file(file, most_bytes_of_list))) {
    Part& part = parts[entry.part];
    if (!part.times.empty() && !(entry.time > part.times.back())) {
      fail_import(name, fmt::format("the timestep {} of part {} does not come after {}", entry.time, entry.part,
                                    part.times.back()));
    }
    part.times.push_back(entry.time);
    part.files.push_back(file.parent_path() / entry.file);
  }
  std::vector<std::shared_ptr<PvdPart>> bodies;
  const int cloth = parts.begin()->first;
  for (const auto& [number, part] : parts) {
    if (number == cloth) continue;
    bodies.push_back(std::make_shared<PvdPart>(name, part.times, part.files, std::vector<std::shared_ptr<PvdPart>>{}));
  }
  Part& own = parts.begin()->second;
  return std::make_unique<PvdPart>(name, std::move(own.times), std::move(own.files), std::move(bodies));
}

}  // namespace drape
