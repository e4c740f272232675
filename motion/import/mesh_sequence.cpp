#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/import/motion_source.hpp"
#include "motion/import/npz.hpp"
#include "scene/mesh/source.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_bytes_of_frame = 4'000'000'000;

/// Hashes the vertices of all polygons of an OBJ, whose triangulation depends on their shape.
std::uint64_t polygons_of(std::string_view text) {
  Hash hash;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (!line.starts_with("f ") && !line.starts_with("f\t")) continue;
    bool in_vertex = true;  // before the slashes
    for (const char c : line) {
      const bool space = c == ' ' || c == '\t' || c == '\r';
      in_vertex = space || (in_vertex && c != '/');
      if (in_vertex && c != '\r') hash.add(&c, 1);
    }
  }
  return hash.value();
}

/// Reads an OBJ. If drape has written it, its other objects become bodies.
MeshFrame read_obj_frame(const fs::path& file) {
  const SourceText source = SourceText::read(file);
  MeshFrame frame{.mesh = {}, .time = time_in_comment(source.text())};
  std::vector<ObjObject> objects = read_drape_objects(source);
  if (objects.empty()) {
    frame.mesh = read_obj_mesh(source);
    frame.polygons = polygons_of(source.text());
    return frame;
  }
  for (ObjObject& object : objects) {
    if (&object == &objects.front()) {
      frame.mesh = std::move(object.mesh);
    } else {
      frame.bodies.push_back(std::move(object.mesh));
    }
  }
  return frame;
}

class MeshSequence final : public MotionSource {
 public:
  explicit MeshSequence(const fs::path& file)
      : name_(file.string()), files_(names_frames(file) ? frame_files(file) : std::vector<fs::path>{file}) {
    first_ = read_mesh_frame(files_.front());
    require_finite(files_.front().string(), first_.mesh.positions);
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<fs::path> files() const override { return files_; }
  [[nodiscard]] const Mesh& mesh() const override { return first_.mesh; }
  [[nodiscard]] std::size_t count() const override { return files_.size(); }

  /// Returns the times in the files; empty unless the first two and the last have valid ones. Reading them all costs
  /// an extra pass, which a .pvd avoids.
  [[nodiscard]] std::vector<double> times() override {
    if (!first_.time || files_.size() < 2) return {};
    const std::optional<double> second = read_mesh_frame(files_[1]).time, last = read_mesh_frame(files_.back()).time;
    if (!second || !last || !(*second > *first_.time)) return {};
    std::vector<double> all;
    for (const fs::path& file : files_) {
      const std::size_t i = all.size();
      all.push_back(i == 0 ? *first_.time : i == 1 ? *second : read_mesh_frame(file).time.value_or(*first_.time));
    }
    return all;
  }

  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    MeshFrame frame = i == 0 ? first_ : read_mesh_frame(files_[i]);
    // Keep the first triangulation: a bending quad might be split along its other diagonal.
    if (frame.polygons && frame.polygons == first_.polygons) frame.mesh.triangles = first_.mesh.triangles;
    require_same_mesh(files_[i].string(), first_.mesh, frame.mesh);
    return {.x = std::move(frame.mesh.positions), .v = std::move(frame.velocities), .energies = frame.energies};
  }

  [[nodiscard]] ImportedColliders colliders() override;

 private:
  std::string name_;
  std::vector<fs::path> files_;
  MeshFrame first_;
};

/// The k-th body in the files of a sequence.
class BodyOfSequence final : public MotionSource {
 public:
  BodyOfSequence(std::vector<fs::path> files, std::size_t k, Mesh first)
      : files_(std::move(files)), k_(k), first_(std::move(first)) {
    name_ = files_.front().string();
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<fs::path> files() const override { return files_; }
  [[nodiscard]] const Mesh& mesh() const override { return first_; }
  [[nodiscard]] std::size_t count() const override { return files_.size(); }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    MeshFrame frame = read_mesh_frame(files_[i]);
    if (frame.bodies.size() <= k_) fail_import(files_[i].string(), "it has fewer objects than the first file");
    require_same_mesh(files_[i].string(), first_, frame.bodies[k_]);
    return {.x = std::move(frame.bodies[k_].positions)};
  }

 private:
  std::string name_;
  std::vector<fs::path> files_;
  std::size_t k_;
  Mesh first_;
};

ImportedColliders MeshSequence::colliders() {
  ImportedColliders found;
  for (std::size_t k = 0; k < first_.bodies.size(); ++k) {
    found.bodies.push_back(std::make_shared<BodyOfSequence>(files_, k, first_.bodies[k]));
  }
  if (first_.spheres.empty() && first_.grounds.empty()) return found;
  for (const fs::path& file : files_) {
    const MeshFrame frame = &file == &files_.front() ? first_ : read_mesh_frame(file);
    found.spheres.by_moment.push_back(frame.spheres);
    found.grounds.by_moment.push_back(frame.grounds);
  }
  return found;
}

}  // namespace

void require_same_mesh(const std::string& name, const Mesh& first, const Mesh& mesh) {
  require_finite(name, mesh.positions);
  if (mesh.positions.rows() != first.positions.rows() || mesh.triangles.size() != first.triangles.size()) {
    fail_import(
        name,
        fmt::format("expected the {} vertices and {} triangles of the first frame, found {} vertices and {} "
                    "triangles",
                    first.positions.rows(), first.triangles.size(), mesh.positions.rows(), mesh.triangles.size()));
  }
  const auto other = std::ranges::mismatch(mesh.triangles, first.triangles);
  if (other.in1 == mesh.triangles.end()) return;
  fail_import(name, fmt::format("expected the triangles of the first frame, but triangle {} has other vertices",
                                other.in1 - mesh.triangles.begin()));
}

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

MeshFrame read_mesh_frame(const fs::path& file) {
  const std::string ending = lower_ending(file), name = file.string();
  if (ending == ".obj") return read_obj_frame(file);
  const std::string text = read_file(file, most_bytes_of_frame);
  if (ending == ".ply") return read_ply(name, text);
  if (ending == ".vtp" || ending == ".vtu") return read_vtk_xml(name, text);
  if (ending == ".vtk") return read_vtk_legacy(name, text);
  fail_import(name, "expected a mesh in an .obj, .ply, .vtp, .vtu or .vtk file");
}

std::unique_ptr<MotionSource> open_mesh_sequence(const fs::path& file) { return std::make_unique<MeshSequence>(file); }

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

namespace fs = std::filesystem;
namespace {

constexpr std::size_t header_bytes = 32;

class Pc2 final : public MotionSource {
 public:
  Pc2(const fs::path& file, const fs::path& mesh)
      : name_(file.string()), mesh_file_(mesh), stream_(file, std::ios::binary) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || !stream_)
      fail_import(name_, "the file cannot be read: " + (error ? error.message() : "no permission"));
    std::string header(header_bytes, '\0');
    if (!stream_.read(header.data(), header_bytes) || std::memcmp(header.data(), "POINTCACHE2", 12) != 0) {
      fail_import(name_, "it is no point cache: it does not begin with POINTCACHE2");
    }
    const auto whole = [&](std::size_t at) {
      return number_at(header.data() + at, {NumberType::Kind::integer, 4, false});
    };
    const double points = whole(16), samples = whole(28);
    mesh_ = read_mesh_frame(mesh).mesh;
    if (points != static_cast<double>(mesh_.positions.rows())) {
      fail_import(name_, fmt::format("it has {} points, and {} has {} vertices", points, mesh.string(),
                                     mesh_.positions.rows()));
    }
    if (samples < 1) fail_import(name_, fmt::format("it has {} samples; expected at least one", samples));
    const double expected = header_bytes + 12.0 * points * samples;
    if (static_cast<double>(size) < expected) {
      fail_import(name_, fmt::format("it is cut short: {} samples of {} points take {} bytes, found {}", samples,
                                     points, expected, size));
    }
    count_ = static_cast<std::size_t>(samples);
    mesh_.positions = read();
    require_finite(name_, mesh_.positions);
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<fs::path> files() const override { return {name_, mesh_file_}; }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return count_; }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    if (i == 0) return {.x = mesh_.positions};
    ImportedMoment moment{.x = read()};
    require_finite(fmt::format("{}: sample {}", name_, i), moment.x);
    return moment;
  }

 private:
  Vertices read() {
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> rows(mesh_.positions.rows(), 3);
    stream_.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(float)));
    if (!stream_) fail_import(name_, "it is cut short");
    return rows.cast<double>();
  }

  std::string name_;
  fs::path mesh_file_;
  std::ifstream stream_;
  Mesh mesh_;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<MotionSource> open_pc2(const fs::path& file, const fs::path& mesh) {
  return std::make_unique<Pc2>(file, mesh.empty() ? fs::path(file).replace_extension(".obj") : mesh);
}

}  // namespace drape
