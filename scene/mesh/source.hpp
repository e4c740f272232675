#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files.hpp"
#include "drape/sim/mesh.hpp"

namespace drape {

/// The text of a mesh file and its name in messages. Readers use byte offsets; line and column are computed only for
/// messages.
class SourceText {
 public:
  SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  /// @throws UsageError if the file cannot be read
  static SourceText read(const std::filesystem::path& file);

  /// Opens a text of any size that stays in its file: piece() reads it, and text() is empty. A pipe is read whole.
  /// @throws UsageError if the file cannot be read
  static SourceText open(const std::filesystem::path& file);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns the whole text if it is in memory.
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool stays_in_file() const { return file_ != nullptr; }

  /// Returns the text from an offset on; empty at the end. A text in memory is returned to its end, otherwise a piece
  /// of at most `piece_bytes`.
  /// @param memory storage for the piece
  /// @throws UsageError if the file cannot be read, or is not text
  [[nodiscard]] std::string_view piece(std::size_t offset, std::string& memory) const;
  static constexpr std::size_t piece_bytes = 1 << 16;

  /// Returns the line of an offset, from 1.
  [[nodiscard]] std::size_t line(std::size_t offset) const;

  /// Throws a message with a place. Lines and columns count from 1; columns count UTF-8 characters.
  /// @throws UsageError "name:line:column: message"
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  /// @throws UsageError "name: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::pair<std::size_t, std::size_t> line_and_column(std::size_t offset) const;

  std::string name_;
  std::string text_;
  std::shared_ptr<const FilePieces> file_ = {};  // null: the text is in memory
  std::size_t begin_ = 0;                        // start of the text in the file, after a byte-order mark
};

/// A place in a file, for messages.
struct SourcePlace {
  const SourceText* source = nullptr;  ///< must outlive this object
  std::size_t offset = 0;

  /// @throws UsageError, as SourceText::fail
  [[noreturn]] void fail(const std::string& message) const { source->fail(offset, message); }
};

/// Quotes a piece of a file for a message: cut if long or at the end of the line, without control characters.
std::string in_quotes(std::string_view piece);

/// Returns true if a file name denotes a sequence: it contains {frame} or {frame:04}.
bool names_frames(const std::filesystem::path& file);

/// Returns true if a file belongs to such a sequence.
bool is_frame(const std::filesystem::path& file, const std::filesystem::path& named);

/// Returns the files of a sequence like "body/{frame:04}.obj", by number. Numbers are consecutive from any first one.
/// 04 pads shorter numbers with zeros to 4 digits.
/// @throws UsageError if there are none, or if one is missing in between
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file);

/// Largest number of corners of a concave face. Ear clipping takes time cubic in this number.
inline constexpr std::size_t most_concave_corners = 256;

/// Builder of a Mesh from the vertices and polygons of a file.
class MeshBuilder {
 public:
  using Uv = std::array<float, 2>;

  /// Adds a vertex at a position [m]. Vertices are numbered from 0 in the order of insertion.
  void add_vertex(const Eigen::Vector3d& position) { positions_.push_back(position); }

  [[nodiscard]] std::size_t vertex_count() const { return positions_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

  /// Adds a polygon as triangles: a fan from its first corner if convex, otherwise by ear clipping.
  /// @param corners at least 3, all below vertex_count()
  /// @param uvs one per corner, or empty
  /// @return false, without adding it, if the polygon is concave with more than most_concave_corners corners
  [[nodiscard]] bool add_polygon(std::span<const int> corners, std::span<const Uv> uvs);

  /// Returns the mesh. If some polygons have texture coordinates, the others get (0, 0).
  [[nodiscard]] Mesh finish();

 private:
  void add_triangle(const std::array<std::size_t, 3>& of, std::span<const int> corners, std::span<const Uv> uvs);

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Uv> uvs_;
};

/// Triangulates a polygon in space: returns points.size() − 2 triangles as indices into `points`, with the polygon's
/// winding. It clips ears (Meisters 1975) in the plane of the vector area (Newell's normal). A convex polygon gives the
/// fan (0,1,2), (0,2,3), …. A self-crossing polygon still uses each corner, but its triangles may overlap.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector3d> points);

/// Options of a mesh file in a scene.
struct MeshOptions {
  enum class Up { y, z };

  std::string prim = {};                         ///< prim of a USD file, "/World/cloth"; empty: the only mesh
  std::optional<Up> up = {};                     ///< up axis of an OBJ, which does not store it; default z
  std::optional<double> frames_per_second = {};  ///< frame rate of an OBJ sequence; default 24
};

/// Reads the mesh of a Wavefront OBJ file: all objects and groups together. Vertices keep their file order, including
/// unused ones. Faces may have any number of corners; negative (relative) numbers count back from the last vertex. OBJ
/// has no unit and no up axis: coordinates are taken as metres with z up. Materials, normals, lines and curves are
/// ignored.
/// @throws UsageError "file:line:column: message"
Mesh read_obj_mesh(const SourceText& source);

/// Returns the vertices of the faces of a group ('g') or an object ('o'), ascending.
/// @throws UsageError as above, and if there is no such group
std::vector<int> read_obj_group(const SourceText& source, const std::string& group);

/// An object of an OBJ file as a separate mesh.
struct ObjObject {
  std::string name;
  Mesh mesh;
};

/// Reads the objects of an OBJ file written by drape: the cloth first, then its obstacles. For any other OBJ returns
/// nothing, because its objects may be parts of one cloth.
/// @throws UsageError as read_obj_mesh()
std::vector<ObjObject> read_drape_objects(const SourceText& source);

}  // namespace drape
