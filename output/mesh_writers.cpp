#include "output/mesh_writers.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "core/bytes.hpp"
#include "core/text.hpp"
#include "drape/core/rotation.hpp"
#include "drape/sim/mesh.hpp"

namespace drape {
namespace {

constexpr int around = 48, from_pole_to_pole = 24;

/// Appends points and returns the index of the first.
int append(Surface& surface, const Vertices& points) {
  const Eigen::Index first = surface.positions.rows();
  surface.positions.conservativeResize(first + points.rows(), 3);
  surface.positions.bottomRows(points.rows()) = points;
  return static_cast<int>(first);
}

void append(Surface& surface, const SphereShape& sphere) {
  constexpr int rings = from_pole_to_pole - 1;
  constexpr Eigen::Index poles = Eigen::Index{rings} * around;  // index of the first pole
  Vertices points(poles + 2, 3);
  for (int i = 0; i < rings; ++i) {
    const double polar = std::numbers::pi * (i + 1) / from_pole_to_pole;
    for (int j = 0; j < around; ++j) {
      const double azimuth = 2 * std::numbers::pi * j / around;
      points.row(i * around + j) << std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar);
    }
  }
  points.row(poles) << 0, 0, 1;
  points.row(poles + 1) << 0, 0, -1;
  points = (sphere.radius * points).rowwise() + sphere.center.transpose();

  const int first = append(surface, points), north = first + rings * around, south = north + 1;
  for (int j = 0; j < around; ++j) {
    const int next = (j + 1) % around;
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = first + i * around + j, b = first + i * around + next;
      surface.triangles.push_back({a, a + around, b + around});
      surface.triangles.push_back({a, b + around, b});
    }
    surface.triangles.push_back({north, first + j, first + next});
    surface.triangles.push_back({south, first + (rings - 1) * around + next, first + (rings - 1) * around + j});
  }
}

}  // namespace

GroundPatch ground_patch(const Vertices& cloth) {
  if (cloth.rows() == 0) return {};
  const Eigen::RowVector3d low = cloth.colwise().minCoeff(), high = cloth.colwise().maxCoeff();
  return {.middle = (low + high) / 2, .side = 4 * (high - low).maxCoeff()};
}

Vertices ground_corners(const GroundShape& ground, const GroundPatch& patch) {
  const Eigen::Vector3d& n = ground.normal;
  const Eigen::Vector3d middle = patch.middle + (ground.height - n.dot(patch.middle)) * n;
  // The sides of a level ground are along x and y.
  const Eigen::Quaterniond turn = rotation_from_z(n);
  const Eigen::Vector3d x = patch.side / 2 * (turn * Eigen::Vector3d::UnitX()),
                        y = patch.side / 2 * (turn * Eigen::Vector3d::UnitY());
  Vertices corners(4, 3);
  corners << (middle - x - y).transpose(), (middle + x - y).transpose(), (middle + x + y).transpose(),
      (middle - x + y).transpose();
  return corners;
}

Surface surface_of(const std::vector<Collider>& colliders, const GroundPatch& patch) {
  Surface surface{.positions = Vertices(0, 3), .triangles = {}};
  for (const Collider& collider : colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      append(surface, *sphere);
    } else if (const auto* ground = std::get_if<GroundShape>(&collider)) {
      const int first = append(surface, ground_corners(*ground, patch));
      surface.triangles.push_back({first, first + 1, first + 2});
      surface.triangles.push_back({first, first + 2, first + 3});
    } else if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
      const int first = append(surface, mesh->positions);
      for (const auto& [a, b, c] : *mesh->triangles) surface.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return surface;
}

int frame_digits(const FilmInfo& film) {
  return static_cast<int>(std::to_string(film.first_frame + std::max(1, film.expected_frames) - 1).size());
}

std::string file_beside(const std::filesystem::path& file, const char* beside, const FilmInfo& film, int frame) {
  return (file.parent_path() / file.stem()).string() + PathTemplate(beside).path(film.scene, frame, frame_digits(film));
}

namespace {

/// Returns the lines that all frames share: vt and f. The triangles of each of several cloths are a group.
std::string surface_lines(const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs,
                          const std::vector<ClothPiece>& pieces) {
  std::string coordinates, faces;
  std::map<std::array<float, 2>, std::size_t> numbers;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const ClothPiece& piece : pieces) {
      if (pieces.size() > 1 && piece.first_triangle == static_cast<int>(t)) faces += "g " + piece.name + "\n";
    }
    faces += 'f';
    for (std::size_t corner = 0; corner < 3; ++corner) {
      fmt::format_to(std::back_inserter(faces), " {}", triangles[t][corner] + 1);
      if (uvs.empty()) continue;
      const std::array<float, 2>& uv = uvs[3 * t + corner];
      const auto [at, is_new] = numbers.emplace(uv, numbers.size() + 1);
      if (is_new) fmt::format_to(std::back_inserter(coordinates), "vt {:.9g} {:.9g}\n", uv[0], uv[1]);
      fmt::format_to(std::back_inserter(faces), "/{}", at->second);
    }
    faces += '\n';
  }
  return coordinates + faces;
}

void append_vertices(const Vertices& positions, std::string& text) {
  for (const auto& x : positions.rowwise()) {
    fmt::format_to(std::back_inserter(text), "v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
  }
}

/// Appends spheres and bodies as objects, after `before` vertices.
void append_objects(const std::vector<Collider>& colliders, Eigen::Index before, std::string& text) {
  int spheres = 0, bodies = 0;
  for (const Collider& collider : colliders) {
    if (std::holds_alternative<GroundShape>(collider)) continue;
    const bool ball = std::holds_alternative<SphereShape>(collider);
    const Surface surface = surface_of({collider}, {});
    fmt::format_to(std::back_inserter(text), "o {}{}\n", ball ? "sphere" : "body", ball ? ++spheres : ++bodies);
    append_vertices(surface.positions, text);
    for (const auto& [a, b, c] : surface.triangles) {
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", before + a + 1, before + b + 1, before + c + 1);
    }
    before += surface.positions.rows();
  }
}

std::function<std::string(const Frame&)> make_writer(const FilmInfo& film, bool with_objects) {
  static const std::vector<ClothPiece> none;
  const std::string surface =
      surface_lines(film.triangles(), film.texture_coordinates(), film.cloth == nullptr ? none : film.cloth->pieces);
  return [surface, with_objects](const Frame& frame) {
    std::string text = fmt::format("# drape: frame {} at {:.9g} s, in metres, z up\n", frame.index, frame.time);
    const auto is_ground = [](const Collider& collider) { return std::holds_alternative<GroundShape>(collider); };
    const bool objects = with_objects && !std::ranges::all_of(frame.colliders, is_ground);
    if (objects) text += "o cloth\n";
    append_vertices(frame.positions, text);
    text += surface;
    if (objects) append_objects(frame.colliders, frame.positions.rows(), text);
    return text;
  };
}

}  // namespace

std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film) { return make_writer(film, true); }
std::function<std::string(const Frame&)> cloth_obj_writer(const FilmInfo& film) { return make_writer(film, false); }

OutputFormat obj_format() {
  return {.extension = ".obj",
          .help = "the cloth as a Wavefront mesh [m, z up], with spheres and bodies as objects, without the ground",
          .made_by = {},
          .packages = {},
          .make = FrameMaker<Frame>(obj_writer)};
}

namespace {

/// Returns the bytes of the vertices, each with the number of its cloth if there are several.
std::string ply_vertices(const Vertices& positions, const std::vector<int>& cloth_of) {
  if (cloth_of.empty()) return vertex_bytes<double>(positions);
  std::string bytes;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    for (const double x : positions.row(i)) append_number<double>(bytes, x);
    append_number<std::int32_t>(bytes, cloth_of[static_cast<std::size_t>(i)]);
  }
  return bytes;
}

}  // namespace

std::function<std::string(const Frame&)> ply_writer(const FilmInfo& film) {
  std::string faces;
  for (const Triangle& triangle : film.triangles()) {
    append_number<std::uint8_t>(faces, 3);
    for (const int vertex : triangle) append_number<std::int32_t>(faces, vertex);
  }
  std::vector<int> cloth_of;  // number of each vertex's cloth, of several
  std::string names, property;
  if (film.cloth != nullptr && film.cloth->pieces.size() > 1) {
    cloth_of = pieces_of_vertices(*film.cloth);
    property = "property int cloth\n";
    for (std::size_t k = 0; k < film.cloth->pieces.size(); ++k) {
      names += fmt::format("comment cloth {} is {}\n", k, film.cloth->pieces[k].name);
    }
  }
  return [=, count = film.triangles().size()](const Frame& frame) {
    return fmt::format(
               "ply\nformat binary_little_endian 1.0\ncomment drape: frame {} at {:.9g} s, in metres, z up\n{}"
               "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
               "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
               frame.index, frame.time, names, frame.positions.rows(), property, count) +
           ply_vertices(frame.positions, cloth_of) + faces;
  };
}

OutputFormat ply_format() {
  return {.extension = ".ply",
          .help = "the cloth as a binary PLY mesh [m, z up]",
          .made_by = {},
          .packages = {},
          .make = FrameMaker<Frame>(ply_writer)};
}

Pc2Writer::Pc2Writer(const std::filesystem::path& file, const FilmInfo& film)
    : expected_(film.expected_frames),
      file_(file),
      mesh_(file_beside(file, first_mesh, film, film.first_frame)),
      mesh_text_(cloth_obj_writer(film)) {}

std::string Pc2Writer::header(Eigen::Index points, int samples) const {
  std::string bytes("POINTCACHE2\0", 12);
  append_number<std::int32_t>(bytes, 1);  // version of the format
  append_number<std::int32_t>(bytes, static_cast<std::int32_t>(points));
  append_number<float>(bytes, 0);  // frame of the first sample
  append_number<float>(bytes, 1);  // frames per sample
  append_number<std::int32_t>(bytes, samples);
  return bytes;
}

void Pc2Writer::add(const Frame& frame) {
  if (samples_++ == 0) {
    points_ = frame.positions.rows();
    mesh_.write(mesh_text_(frame));
    file_.write(header(points_, expected_));
  }
  file_.write(vertex_bytes<float>(frame.positions));
}

std::vector<OutputFile> Pc2Writer::finish(Ending ending) {
  if (samples_ == 0) return {};
  if (samples_ != expected_) file_.overwrite(0, header(points_, samples_));
  const std::uintmax_t mesh_size = mesh_.commit(ending), size = file_.commit(ending);
  return {{file_.name(ending), size}, {mesh_.name(ending), mesh_size}};
}

OutputFormat pc2_format() {
  return {.extension = ".pc2",
          .help = "the motion as a point cache for Blender's Mesh Cache [m, z up], plus an .obj",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<Pc2Writer>(file, film);
          }),
          .beside = {first_mesh}};
}

namespace {

/// Returns a DataArray whose numbers are in base64, after the count of their bytes.
/// @param attributes "type=… Name=…"
std::string data_array(const std::string& attributes, std::string_view bytes) {
  std::string block;
  append_number<std::uint64_t>(block, bytes.size());
  return fmt::format("<DataArray {} format=\"binary\">{}</DataArray>\n", attributes, base64(block.append(bytes)));
}

std::string doubles(const std::string& name, int components, std::string_view bytes) {
  return data_array(fmt::format(R"(type="Float64" Name="{}" NumberOfComponents="{}")", name, components), bytes);
}

/// Returns a DataArray with any number of rows, for field data.
std::string field(const std::string& name, int components, const std::vector<double>& values) {
  const std::size_t tuples = values.size() / static_cast<std::size_t>(components);
  return data_array(
      fmt::format(R"(type="Float64" Name="{}" NumberOfComponents="{}" NumberOfTuples="{}")", name, components, tuples),
      bytes_of(values));
}

std::string polygons(const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> ends;
  for (std::size_t t = 0; t < triangles.size(); ++t) ends.push_back(static_cast<std::int32_t>(3 * (t + 1)));
  return "<Polys>\n" + data_array(R"(type="Int32" Name="connectivity")", bytes_of(triangles)) +
         data_array(R"(type="Int32" Name="offsets")", bytes_of(ends)) + "</Polys>\n";
}

std::string points(const Vertices& x) {
  return "<Points>\n" + doubles("points", 3, vertex_bytes<double>(x)) + "</Points>\n";
}

/// Returns a whole file.
std::string poly_data(Eigen::Index point_count, std::size_t triangle_count, const std::string& fields,
                      const std::string& contents) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<PolyData>\n<FieldData>\n{}</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n{}</Piece>\n</PolyData>\n</VTKFile>\n",
      fields, point_count, triangle_count, contents);
}

/// Returns texture coordinates per vertex, as VTK requires; empty if there are none or a vertex has two.
std::string texture_coordinates(const FilmInfo& film, std::size_t vertex_count) {
  using Pair = std::array<float, 2>;
  constexpr float unknown = std::numeric_limits<float>::infinity();
  const std::vector<Pair>& uvs = film.texture_coordinates();
  if (uvs.empty()) return {};
  std::vector<Pair> of_vertices(vertex_count, {unknown, unknown});
  for (std::size_t corner = 0; corner < uvs.size(); ++corner) {
    Pair& known = of_vertices.at(static_cast<std::size_t>(film.triangles()[corner / 3][corner % 3]));
    if (known[0] != unknown && known != uvs[corner]) return {};
    known = uvs[corner];
  }
  for (Pair& pair : of_vertices) {
    if (pair[0] == unknown) pair = {0, 0};
  }
  return data_array(R"(type="Float32" Name="st" NumberOfComponents="2")", bytes_of(of_vertices));
}

std::string fields_of(const Frame& frame) {
  std::string text = field("TimeValue", 1, {frame.time});
  if (frame.energies) {
    const Energies& e = *frame.energies;
    text += field("total_energy", 1, {e.total()}) + field("kinetic_energy", 1, {e.kinetic}) +
            field("gravity_energy", 1, {e.gravity}) + field("elastic_energy", 1, {e.elastic});
  }
  std::vector<double> spheres, grounds;
  for (const Collider& collider : frame.colliders) {
    if (const auto* s = std::get_if<SphereShape>(&collider)) {
      spheres.insert(spheres.end(), {s->center.x(), s->center.y(), s->center.z(), s->radius});
    } else if (const auto* g = std::get_if<GroundShape>(&collider)) {
      grounds.insert(grounds.end(), {g->normal.x(), g->normal.y(), g->normal.z(), g->height});
    }
  }
  if (!spheres.empty()) text += field("spheres", 4, spheres);
  if (!grounds.empty()) text += field("grounds", 4, grounds);
  return text;
}

/// Escapes a text for an attribute's value.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : printable(text)) {
    const char* const entity = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : nullptr;
    if (entity != nullptr) {
      result += entity;
    } else {
      result += c;
    }
  }
  return result;
}

OutputFormat vtk_format(std::string extension, std::string help, decltype(OutputFormat::make) make) {
  return {.extension = std::move(extension),
          .help = std::move(help),
          .made_by = {},
          .packages = {},
          .make = std::move(make)};
}

}  // namespace

std::function<std::string(const Frame&)> vtp_writer(const FilmInfo& film) {
  const std::string faces = polygons(film.triangles());
  const std::size_t face_count = film.triangles().size();
  std::optional<VertexStretch> stretch;
  std::string coordinates;
  if (film.cloth != nullptr) {
    stretch.emplace(film.cloth->rest, film.cloth->triangles);
    coordinates = texture_coordinates(film, static_cast<std::size_t>(film.cloth->rest.rows()));
  }
  return [=](const Frame& frame) {
    std::string of_points = fmt::format("<PointData Vectors=\"velocity\"{}{}>\n", stretch ? " Scalars=\"stretch\"" : "",
                                        coordinates.empty() ? "" : " TCoords=\"st\"");
    of_points += doubles("velocity", 3, vertex_bytes<double>(frame.velocities));
    if (stretch) {
      const Eigen::VectorXd values = (*stretch)(frame.positions);
      of_points += doubles("stretch", 1, bytes_of(std::vector<double>(values.begin(), values.end())));
    }
    of_points += coordinates + "</PointData>\n";
    return poly_data(frame.positions.rows(), face_count, fields_of(frame), of_points + points(frame.positions) + faces);
  };
}

PvdWriter::PvdWriter(const std::filesystem::path& file, const FilmInfo& film)
    : film_(film), file_(file), cloth_(vtp_writer(film)) {
  if (film.cloth != nullptr) patch_ = ground_patch(film.cloth->positions);
  require_writable(file_beside(file, cloth_frames, film, film.first_frame));
}

void PvdWriter::add_part(double time, int part, const std::filesystem::path& file) {
  const std::filesystem::path name = file.parent_path().filename() / file.filename();
  lines_ += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", time, part, escaped(name.string()));
}

void PvdWriter::add(const Frame& frame) {
  const std::string file = file_beside(file_.file(), cloth_frames, film_, frame.index);
  written_.push_back({file, write_file_atomically(file, cloth_(frame))});
  add_part(frame.time, 0, file);
  if (frame.colliders.empty()) return;
  const Surface surface = surface_of(frame.colliders, patch_);
  std::string now = poly_data(surface.positions.rows(), surface.triangles.size(), {},
                              points(surface.positions) + polygons(surface.triangles));
  if (now != colliders_) {
    colliders_ = std::move(now);
    colliders_file_ = file_beside(file_.file(), collider_frames, film_, frame.index);
    written_.push_back({colliders_file_, write_file_atomically(colliders_file_, colliders_)});
  }
  add_part(frame.time, 1, colliders_file_);
}

std::vector<OutputFile> PvdWriter::finish(Ending ending) {
  if (written_.empty()) return {};
  file_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" + lines_ +
              "</Collection>\n</VTKFile>\n");
  const std::uintmax_t size = file_.commit(ending);
  written_.insert(written_.begin(), {file_.name(ending), size});
  return std::move(written_);
}

OutputFormat vtp_format() {
  return vtk_format(".vtp", "the cloth as VTK PolyData, with velocities and stretch", FrameMaker<Frame>(vtp_writer));
}

OutputFormat pvd_format() {
  OutputFormat format = vtk_format(".pvd", "the motion for ParaView, plus a folder of .vtp files",
                                   FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
                                     return std::make_unique<PvdWriter>(file, film);
                                   }));
  format.beside = {cloth_frames, collider_frames};
  return format;
}

}  // namespace drape
