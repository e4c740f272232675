#include "output/vtk_writer.hpp"

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/bytes.hpp"
#include "core/text.hpp"
#include "drape/sim/mesh.hpp"
#include "output/mesh_writers.hpp"

namespace drape {
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
