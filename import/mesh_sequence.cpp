#include <fmt/format.h>

#include <algorithm>

#include "core/hash.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "import/drape_comment.hpp"
#include "import/mesh_sequence.hpp"
#include "import/ply.hpp"
#include "import/sources.hpp"
#include "import/vtk_legacy.hpp"
#include "import/vtk_xml.hpp"
#include "scene/mesh/obj.hpp"
#include "scene/mesh/obj_objects.hpp"
#include "scene/mesh/sequence.hpp"

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

}  // namespace drape
