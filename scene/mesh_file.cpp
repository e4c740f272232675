#include "scene/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scene/mesh/obj.hpp"
#include "scene/mesh/obj_objects.hpp"
#include "scene/mesh/sequence.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/mesh.hpp"

namespace drape {
namespace {

/// About 1.6 GB.
constexpr double most_numbers = 2e8;
constexpr double usual_frames_per_second = 24;

using Inputs = std::vector<std::filesystem::path>;

enum class Format { obj, usd };

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

[[noreturn]] void fail_file(const std::filesystem::path& file, const std::string& message) {
  SourceText(file.string(), "").fail(message);
}

Format format_of(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".obj") return Format::obj;
  if (ending == ".usda" || ending == ".usd") return Format::usd;
  const std::string found = ending.empty() ? "a name without an ending" : in_quotes(file.extension().string());
  fail_file(file, "expected a mesh in an .obj, .usda or .usd file, found " + found);
}

void check_options(const std::filesystem::path& file, Format format, const MeshOptions& options) {
  if (format == Format::obj && !options.prim.empty()) fail_file(file, "an OBJ has no prims: omit 'prim'");
  if (format == Format::usd && options.up) fail_file(file, "a USD file says itself which axis is up: omit 'up'");
}

void add_inputs(const std::filesystem::path& file, const UsdStage* stage, Inputs* inputs) {
  if (inputs == nullptr) return;
  inputs->push_back(file);
  if (stage == nullptr) return;
  for (const std::filesystem::path& referenced : stage->referenced_files()) inputs->push_back(referenced);
}

Mesh read_obj(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const SourceText source = SourceText::read(file);
  std::vector<ObjObject> objects = read_drape_objects(source);
  Mesh mesh = objects.empty() ? read_obj_mesh(source) : std::move(objects.front().mesh);
  add_inputs(file, nullptr, inputs);
  if (options.up == MeshOptions::Up::y) {  // y up: (x, y, z) → (x, −z, y), as for USD
    mesh.positions.col(1).swap(mesh.positions.col(2));
    mesh.positions.col(1) *= -1;
  }
  return mesh;
}

void require_same_triangles(const std::filesystem::path& frame, const Mesh& first, const Mesh& mesh) {
  if (mesh.positions.rows() != first.positions.rows() || mesh.triangles.size() != first.triangles.size()) {
    fail_file(frame, fmt::format(
                         "expected the {} vertices and {} triangles of the first frame, found {} vertices and {} "
                         "triangles",
                         first.positions.rows(), first.triangles.size(), mesh.positions.rows(), mesh.triangles.size()));
  }
  const auto other = std::ranges::mismatch(mesh.triangles, first.triangles);
  if (other.in1 == mesh.triangles.end()) return;
  fail_file(frame, fmt::format("expected the triangles of the first frame, but triangle {} has other vertices",
                               1 + (other.in1 - mesh.triangles.begin())));
}

MeshMotion read_sequence(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  MeshMotion motion;
  for (const std::filesystem::path& frame : frame_files(file)) {
    Mesh mesh = read_obj(frame, options, inputs);
    if (motion.samples.empty()) motion.mesh = mesh;
    require_same_triangles(frame, motion.mesh, mesh);
    motion.times.push_back(static_cast<double>(motion.samples.size()) /
                           options.frames_per_second.value_or(usual_frames_per_second));
    motion.samples.push_back(std::move(mesh.positions));
    if (static_cast<double>(motion.samples.size()) * static_cast<double>(motion.samples[0].size()) > most_numbers) {
      fail_file(frame, "so many frames and vertices take too much memory: export fewer of either");
    }
  }
  if (motion.samples.size() > 1) return motion;
  motion.times.clear();
  motion.samples.clear();
  return motion;
}

}  // namespace

bool is_obj(const std::filesystem::path& file) { return ending_of(file) == ".obj"; }

std::vector<int> read_mesh_group(const std::filesystem::path& file, const std::string& group) {
  if (file.empty() || !is_obj(file)) fail_file(file.empty() ? "grid" : file, "only an OBJ has groups");
  return read_obj_group(SourceText::read(file), group);
}

std::vector<int> read_mesh_primvar(const std::filesystem::path& file, const MeshOptions& options,
                                   const std::string& primvar) {
  if (file.empty() || is_obj(file)) fail_file(file.empty() ? "grid" : file, "only a USD file has primvars");
  const SourceText source = SourceText::read(file);
  return read_usd_primvar(UsdStage(source, {.primvar = primvar}), options.prim, primvar);
}

Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const Format format = format_of(file);
  check_options(file, format, options);
  if (format == Format::obj) return read_obj(file, options, inputs);
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source);
  add_inputs(file, &stage, inputs);
  return read_usd_mesh(stage, options.prim);
}

MeshMotion read_mesh_motion(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const Format format = format_of(file);
  check_options(file, format, options);
  if (format == Format::obj && names_frames(file)) return read_sequence(file, options, inputs);
  if (options.frames_per_second) {
    fail_file(file, format == Format::obj ? "a single OBJ does not move: omit 'fps', or name its frames as in "
                                            "body_{frame:04}.obj"
                                          : "a USD file says itself when its samples are: omit 'fps'");
  }
  if (format == Format::obj) return {.mesh = read_obj(file, options, inputs)};
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source, {.moving_points = true});
  add_inputs(file, &stage, inputs);
  return read_usd_mesh_motion(stage, options.prim);
}

}  // namespace drape
