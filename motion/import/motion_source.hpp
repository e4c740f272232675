#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// A moment of an imported motion.
struct ImportedMoment {
  Vertices x;       ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]; empty if unknown
  std::optional<Energies> energies = {};
};

/// Positions of spheres or planes in each moment.
struct ImportedShapes {
  /// Four numbers for each moment and each shape: centre and radius, or normal and height. Empty: no shapes.
  std::vector<std::vector<Eigen::Vector4d>> by_moment = {};
};

class MotionSource;

/// Objects beside the cloth in an imported file.
struct ImportedColliders {
  ImportedShapes spheres = {}, grounds = {};
  std::vector<std::shared_ptr<MotionSource>> bodies = {};
};

/// A motion in a file or files, read one moment at a time. Errors in the files are UsageErrors that name the file.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Returns the name of the file or files, for messages.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Returns all files that the motion is read from.
  [[nodiscard]] virtual std::vector<std::filesystem::path> files() const { return {name()}; }
  /// Returns the mesh at the first moment.
  [[nodiscard]] virtual const Mesh& mesh() const = 0;
  /// Returns the number of moments, at least 1.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Returns the times of the moments [s]; empty if they are unknown before reading.
  [[nodiscard]] virtual std::vector<double> times() { return {}; }
  /// Returns the i-th moment. Callers request each moment once, in order.
  /// @throws UsageError if it is incomplete or non-finite, or the number of vertices or the triangles have changed
  [[nodiscard]] virtual ImportedMoment moment(std::size_t i) = 0;
  /// Returns rest positions [m], if known.
  [[nodiscard]] virtual std::optional<Vertices> rest() { return std::nullopt; }
  /// Returns the frames per second of the film, if known.
  [[nodiscard]] virtual std::optional<double> fps() { return std::nullopt; }
  [[nodiscard]] virtual ImportedColliders colliders() { return {}; }
};

/// @throws UsageError "name: …" naming the vertex, if a coordinate is non-finite or beyond 10¹⁰⁰ m
void require_finite(const std::string& name, const Vertices& x);

/// Throws a UsageError that names the file.
[[noreturn]] void fail_import(const std::string& name, const std::string& message);

/// The content of a file with one moment of a motion.
struct MeshFrame {
  Mesh mesh;
  std::optional<double> time = {};  ///< [s]
  Vertices velocities = {};         ///< n×3 [m/s]; empty: unknown
  std::optional<Energies> energies = {};
  std::vector<Eigen::Vector4d> spheres = {}, grounds = {};  ///< centre and radius; normal and height
  std::vector<Mesh> bodies = {};
  std::optional<std::uint64_t> polygons = {};  ///< hash of the faces, if their shape determines the triangles
};

/// Triangulates faces with any number of corners and adds them to a mesh with known positions.
/// @param sizes   corners per face
/// @param corners vertices of all faces in sequence
/// @throws UsageError "name: …" if a face has fewer than three corners, or an invalid vertex
void add_faces(const std::string& name, const std::vector<std::size_t>& sizes, const std::vector<double>& corners,
               Mesh& mesh);

/// Groups numbers into rows of three.
/// @throws UsageError unless there are three for each vertex
Vertices vertices_of(const std::string& name, const std::vector<double>& numbers);

/// Grid of equal time steps that contains the moments of a motion.
struct TimeGrid {
  double step = 0.04;               ///< h [s]
  std::vector<std::int64_t> steps;  ///< step of each moment, from 0, increasing
  double fps = 25, speed = 1;       ///< film with one frame per step: speed/fps = h, if h suits a film
};

/// Finds the grid of a motion.
/// @param times   times of the moments [s]; empty: intervals of 1/fps
/// @param fps     given by the user; has precedence over times
/// @param of_file frame rate in the file
/// @throws UsageError if the times do not increase, or fit no such grid; the message begins with `name`
TimeGrid make_time_grid(const std::string& name, std::size_t count, const std::vector<double>& times,
                        std::optional<double> fps, std::optional<double> of_file);

/// Returns the time in drape's comment in a mesh file, "drape: frame 3 at 0.12 s" [s]; nothing unless it is in the
/// first lines.
inline std::optional<double> time_in_comment(std::string_view text) {
  constexpr std::string_view begin = "drape: frame ", at = " at ";
  text = text.substr(0, 400);
  const std::size_t comment = text.find(begin);
  const std::size_t place = comment == std::string_view::npos ? comment : text.find(at, comment);
  if (place == std::string_view::npos) return std::nullopt;
  double time = 0;
  const auto read = std::from_chars(text.data() + place + at.size(), text.data() + text.size(), time);
  return read.ec == std::errc() ? std::optional(time) : std::nullopt;
}

/// Reads one mesh file, by its extension.
/// @throws UsageError that names it
MeshFrame read_mesh_frame(const std::filesystem::path& file);

/// Checks that a frame has the vertices and triangles of the first one, and finite positions.
/// @throws UsageError "name: …" with the first difference
void require_same_mesh(const std::string& name, const Mesh& first, const Mesh& mesh);

/// Returns the extension in lower case: ".obj" for "A.OBJ".
std::string lower_ending(const std::filesystem::path& file);

/// Reads a PLY mesh: ASCII or binary of either byte order, with x, y, z of the element "vertex" and the list
/// "vertex_indices" or "vertex_index" of the element "face". Other elements and properties are ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_ply(const std::string& name, std::string_view text);

/// Reads a legacy VTK file (.vtk), ASCII or binary: the points and polygons of POLYDATA, or of an UNSTRUCTURED_GRID of
/// polygons. Other content is ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_vtk_legacy(const std::string& name, std::string_view text);

/// Reads a VTK XML file of PolyData or an unstructured grid of polygons (.vtp, .vtu): points, polygons, the point data
/// "velocity", and drape's field data: TimeValue, energies, spheres and grounds. Arrays may be ASCII, base64 or
/// appended, of either byte order, and compressed with zlib.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_vtk_xml(const std::string& name, const std::string& text);

/// An entry of a .pvd.
struct PvdEntry {
  double time = 0;  ///< [s]
  int part = 0;
  std::string file;  ///< relative to the .pvd
};

/// Reads a ParaView collection. @throws UsageError as above
std::vector<PvdEntry> read_pvd(const std::string& name, const std::string& text);

}  // namespace drape
