#include "output/glb_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/files.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "output/codecs/codecs.hpp"
#include "output/mesh_writers.hpp"
#include "output/png_encoder.hpp"

namespace drape {
namespace {

constexpr const char* floats = "\"componentType\": 5126, \"type\": \"VEC3\"";
constexpr const char* of_vertices = ", \"byteStride\": 12, \"target\": 34962";

std::string three(const Eigen::RowVector3f& v) {
  return fmt::format("[{}, {}, {}]", static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

template <class Matrix>
std::string_view matrix_bytes(const Matrix& m) {
  return {reinterpret_cast<const char*>(m.data()), static_cast<std::size_t>(m.size()) * sizeof(float)};
}

}  // namespace

int GltfParts::add_view(std::uint64_t size, const std::string& more) {
  views_.push_back(fmt::format("{{\"buffer\": 0, \"byteOffset\": {}, \"byteLength\": {}{}}}", size_, size, more));
  size_ += size;
  return static_cast<int>(views_.size()) - 1;
}

int GltfParts::add_accessor(int view, std::uint64_t offset, std::uint64_t count, const std::string& more) {
  accessors_.push_back(
      fmt::format("{{\"bufferView\": {}, \"byteOffset\": {}, \"count\": {}, {}}}", view, offset, count, more));
  return static_cast<int>(accessors_.size()) - 1;
}

GltfMorphedMesh::GltfMorphedMesh(const PartialFile& output, const std::vector<Triangle>& triangles,
                                 const std::vector<std::array<float, 2>>& uvs, Eigen::Index vertices, bool smooth)
    : triangles_(triangles), smooth_(smooth), positions_(output, "its positions"), normals_(output, "its normals") {
  for (Eigen::Index v = 0; v < vertices; ++v) vertex_of_.push_back(static_cast<int>(v));
  if (!uvs.empty()) uvs_.assign(vertex_of_.size(), {0, 0});
  std::vector<char> seen(vertex_of_.size(), 0);
  std::map<std::pair<int, std::array<float, 2>>, std::uint32_t> others;
  for (std::size_t corner = 0; corner < 3 * triangles.size(); ++corner) {
    const int v = triangles[corner / 3][corner % 3];
    indices_.push_back(static_cast<std::uint32_t>(v));
    if (uvs.empty()) continue;
    const std::array<float, 2> uv{uvs[corner][0], 1 - uvs[corner][1]};  // glTF's v points down
    char& known = seen[static_cast<std::size_t>(v)];
    if (known == 0) uvs_[static_cast<std::size_t>(v)] = uv;
    known = 1;
    if (uvs_[static_cast<std::size_t>(v)] == uv) continue;
    const auto [at, is_new] = others.emplace(std::pair(v, uv), static_cast<std::uint32_t>(vertex_of_.size()));
    if (is_new) {
      vertex_of_.push_back(v);
      uvs_.push_back(uv);
    }
    indices_.back() = at->second;
  }
}

GltfMorphedMesh::Singles GltfMorphedMesh::split(const Vertices& of_vertices) const {
  Singles rows(static_cast<Eigen::Index>(vertex_of_.size()), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = of_vertices.row(vertex_of_[static_cast<std::size_t>(i)]).cast<float>();
  }
  return rows;
}

Vertices GltfMorphedMesh::normals(const Vertices& x) const {
  Vertices sum = Vertices::Zero(x.rows(), 3);
  for (const auto& [a, b, c] : triangles_) {
    const Eigen::RowVector3d ab = x.row(b) - x.row(a), ac = x.row(c) - x.row(a), n = ab.cross(ac);
    for (const int v : {a, b, c}) sum.row(v) += n;
  }
  for (Eigen::Index v = 0; v < sum.rows(); ++v) {
    const double length = sum.row(v).norm();
    if (length > 0) {
      sum.row(v) /= length;
    } else {
      sum.row(v) << 0, 0, 1;
    }
  }
  return sum;
}

void GltfMorphedMesh::add(const Vertices& x) {
  Singles places = split(x), n;
  if (!places.allFinite())
    throw OutputError("a position beyond 3.4e38 m does not fit into the single precision of .glb files");
  if (smooth_) n = split(normals(x));
  if (bounds_.empty()) {
    first_x_ = places;
    first_n_ = n;
  } else {
    moves_ = moves_ || places != first_x_;
    places -= first_x_;
    if (smooth_) n -= first_n_;
  }
  bounds_.push_back({places.colwise().minCoeff(), places.colwise().maxCoeff()});
  positions_.append(matrix_bytes(places));
  normals_.append(matrix_bytes(n));
}

std::string GltfMorphedMesh::attributes(int position, std::optional<int> normal) const {
  return fmt::format("\"POSITION\": {}{}", position, normal ? fmt::format(", \"NORMAL\": {}", *normal) : "");
}

std::string GltfMorphedMesh::describe(GltfParts& parts, int material) {
  const std::uint64_t count = vertex_of_.size(), size = 12 * count;
  const int indices = parts.add_accessor(parts.add_view(4 * indices_.size(), ", \"target\": 34963"), 0, indices_.size(),
                                         "\"componentType\": 5125, \"type\": \"SCALAR\"");
  std::string base_uvs;
  if (!uvs_.empty()) {
    const int view = parts.add_view(8 * count, ", \"byteStride\": 8, \"target\": 34962");
    base_uvs = fmt::format(", \"TEXCOORD_0\": {}",
                           parts.add_accessor(view, 0, count, "\"componentType\": 5126, \"type\": \"VEC2\""));
  }
  const std::size_t frames = moves_ ? bounds_.size() : 1;
  const int places = parts.add_view(frames * size, of_vertices);
  const int directions = smooth_ ? parts.add_view(frames * size, of_vertices) : -1;
  std::string base, targets;
  for (std::size_t k = 0; k < frames; ++k) {
    const int position = parts.add_accessor(
        places, k * size, count,
        fmt::format("{}, \"min\": {}, \"max\": {}", floats, three(bounds_[k].low), three(bounds_[k].high)));
    std::optional<int> normal;
    if (smooth_) normal = parts.add_accessor(directions, k * size, count, floats);
    if (k == 0) {
      base = attributes(position, normal) + base_uvs;
    } else {
      targets += fmt::format("{}{{{}}}", targets.empty() ? "" : ", ", attributes(position, normal));
    }
  }
  return fmt::format("{{\"attributes\": {{{}}}, \"indices\": {}, \"material\": {}{}}}", base, indices, material,
                     targets.empty() ? "" : fmt::format(", \"targets\": [{}]", targets));
}

void GltfMorphedMesh::write(PartialFile& file) {
  file.write(bytes_of(indices_));
  file.write(bytes_of(uvs_));
  if (moves_) {
    positions_.copy_to(file);
    normals_.copy_to(file);
    return;
  }
  file.write(matrix_bytes(first_x_));
  file.write(matrix_bytes(first_n_));
}

namespace {

constexpr int most_frames = 3000;  // each time of the animation stores the weights of all targets
constexpr std::size_t most_texture_bytes = 64'000'000;

std::string material(const std::string& name, const Rgb& color, const std::string& more = {}) {
  const Eigen::Vector3f linear = linear_color(color);
  return fmt::format(
      "{{\"name\": \"{}\", \"doubleSided\": true, \"pbrMetallicRoughness\": {{\"baseColorFactor\": [{:.6g}, {:.6g}, "
      "{:.6g}, 1], \"metallicFactor\": 0, \"roughnessFactor\": 0.9{}}}}}",
      name, linear[0], linear[1], linear[2], more);
}

/// Returns the bytes of a texture as glTF supports them: a PNG or JPEG file as it is, others as PNG; empty: none.
std::string texture_bytes(const std::filesystem::path& texture, std::string& type) {
  if (texture.empty()) return {};
  std::string bytes = read_file(texture, most_texture_bytes);
  const bool jpeg = is_upright_rgb_jpeg(bytes);
  type = jpeg ? "image/jpeg" : "image/png";
  return jpeg || is_png(bytes) ? bytes : png_of_texture(texture, largest_texture);
}

/// Pads a text to a multiple of 4 bytes.
std::string padded(std::string text, char with) {
  while (text.size() % 4 != 0) text += with;
  return text;
}

}  // namespace

GlbWriter::GlbWriter(const std::filesystem::path& file, const FilmInfo& film) : film_(film), file_(file) {
  if (film.expected_frames > most_frames) {
    throw UsageError(
        fmt::format("{}: a .glb holds {} frames at most, as each is a morph target, and the film has {}: choose fewer, "
                    "with --frames or --every",
                    file.string(), most_frames, film.expected_frames));
  }
  if (film.cloth != nullptr) patch_ = ground_patch(film.cloth->positions);
}

void GlbWriter::add_sheets(const Frame& frame) {
  const std::vector<Triangle>& triangles = film_.triangles();
  const std::vector<std::array<float, 2>>& uvs = film_.texture_coordinates();
  std::vector<ClothPiece> pieces;
  if (film_.cloth != nullptr && film_.cloth->pieces.size() > 1) pieces = film_.cloth->pieces;
  if (pieces.empty()) {
    pieces.push_back({.name = "Cloth",
                      .vertex_count = static_cast<int>(frame.positions.rows()),
                      .triangle_count = static_cast<int>(triangles.size())});
  }
  for (const ClothPiece& piece : pieces) {
    Sheet& sheet = sheets_.emplace_back();
    sheet.name = piece.name;
    sheet.first_vertex = piece.first_vertex;
    sheet.vertex_count = piece.vertex_count;
    const auto begin = triangles.begin() + piece.first_triangle;
    sheet.triangles.assign(begin, begin + piece.triangle_count);
    for (Triangle& triangle : sheet.triangles) {
      for (int& vertex : triangle) vertex -= piece.first_vertex;
    }
    std::vector<std::array<float, 2>> own_uvs;
    if (!uvs.empty()) {
      const auto first = uvs.begin() + 3 * static_cast<std::ptrdiff_t>(piece.first_triangle);
      own_uvs.assign(first, first + 3 * static_cast<std::ptrdiff_t>(piece.triangle_count));
    }
    sheet.mesh = std::make_unique<GltfMorphedMesh>(file_, sheet.triangles, own_uvs, piece.vertex_count, true);
  }
}

void GlbWriter::add_first(const Frame& frame) {
  add_sheets(frame);
  static const std::vector<std::array<float, 2>> no_uvs;
  for (const Collider& collider : frame.colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      SphereShape around_origin = *sphere;
      around_origin.center.setZero();
      Ball ball{.first = *sphere,
                .surface = std::make_unique<Surface>(surface_of({around_origin}, {})),
                .mesh = {},
                .places = {},
                .scales = {}};
      ball.mesh = std::make_unique<GltfMorphedMesh>(file_, ball.surface->triangles, no_uvs,
                                                    ball.surface->positions.rows(), true);
      ball.mesh->add(ball.surface->positions);
      balls_.push_back(std::move(ball));
      continue;
    }
    Solid solid;
    const auto* body = std::get_if<MeshShape>(&collider);
    solid.is_ground = body == nullptr;
    solid.name = fmt::format("{}{}", solid.is_ground ? "Ground" : "Body", solids_.size() + 1);
    Eigen::Index vertices = 4;
    if (body != nullptr) {
      solid.triangles = body->triangles;
      vertices = body->positions.rows();
    } else {
      solid.triangles = std::make_shared<const std::vector<Triangle>>(std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    }
    solid.mesh = std::make_unique<GltfMorphedMesh>(file_, *solid.triangles, no_uvs, vertices, false);
    solids_.push_back(std::move(solid));
  }
}

void GlbWriter::add(const Frame& frame) {
  if (times_.empty()) add_first(frame);
  times_.push_back(static_cast<float>(static_cast<double>(times_.size()) / film_.fps));
  for (const Sheet& sheet : sheets_) {
    sheet.mesh->add(frame.positions.middleRows(sheet.first_vertex, sheet.vertex_count));
  }
  std::size_t ball = 0, solid = 0;
  for (const Collider& collider : frame.colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      Ball& of = balls_.at(ball++);
      for (const double x : sphere->center) of.places.push_back(static_cast<float>(x));
      of.scales.insert(of.scales.end(), 3, static_cast<float>(sphere->radius / of.first.radius));
      of.moves = of.moves || sphere->center != of.first.center;
      of.grows = of.grows || sphere->radius != of.first.radius;
    } else if (const auto* body = std::get_if<MeshShape>(&collider)) {
      solids_.at(solid++).mesh->add(body->positions);
    } else {
      Solid& of = solids_.at(solid++);
      if (times_.size() == 1) of.mesh->add(ground_corners(std::get<GroundShape>(collider), patch_));
    }
  }
}

std::vector<std::string> GlbWriter::sheet_materials(GltfParts& parts, std::vector<std::string>& tail,
                                                    std::string& images) const {
  const Look look = film_.look != nullptr ? *film_.look : Look{};
  std::vector<std::string> materials, sources, textures;
  std::vector<std::filesystem::path> known;
  for (std::size_t k = 0; k < sheets_.size(); ++k) {
    const bool of_its_own = look.cloths.size() == sheets_.size();
    const Rgb color = of_its_own ? look.cloths[k].color : look.color;
    const std::filesystem::path& file = of_its_own ? look.cloths[k].texture : look.texture;
    const std::string name = sheets_.size() == 1 ? "cloth" : sheets_[k].name;
    std::size_t number = static_cast<std::size_t>(std::ranges::find(known, file) - known.begin());
    if (number == known.size()) {
      std::string type;
      std::string bytes = film_.texture_coordinates().empty() ? "" : texture_bytes(file, type);
      if (bytes.empty()) {
        materials.push_back(material(name, color));
        continue;
      }
      known.push_back(file);
      sources.push_back(
          fmt::format("{{\"bufferView\": {}, \"mimeType\": \"{}\"}}", parts.add_view(bytes.size()), type));
      textures.push_back(fmt::format("{{\"sampler\": 0, \"source\": {}}}", number));
      tail.push_back(std::move(bytes));
    }
    materials.push_back(material(name, {1, 1, 1}, fmt::format(", \"baseColorTexture\": {{\"index\": {}}}", number)));
  }
  if (!known.empty()) {
    images = fmt::format(", \"images\": [{}], \"samplers\": [{{}}], \"textures\": [{}]", fmt::join(sources, ", "),
                         fmt::join(textures, ", "));
  }
  return materials;
}

std::string GlbWriter::animation(GltfParts& parts, std::vector<std::string>& tail,
                                 const std::vector<std::size_t>& morphing) const {
  if (morphing.empty() && std::ranges::none_of(balls_, [](const Ball& ball) { return ball.moves || ball.grows; })) {
    return "";
  }
  std::vector<std::string> channels, samplers;
  const std::size_t frames = times_.size();
  const auto add_floats = [&](const std::vector<float>& values, std::size_t count, const std::string& more) {
    tail.emplace_back(bytes_of(values));
    return parts.add_accessor(parts.add_view(4 * values.size()), 0, count, "\"componentType\": 5126, " + more);
  };
  const int input =
      add_floats(times_, frames,
                 fmt::format("\"type\": \"SCALAR\", \"min\": [0], \"max\": [{}]", static_cast<double>(times_.back())));
  const auto add_channel = [&](std::size_t node, const char* path, int output) {
    channels.push_back(fmt::format("{{\"sampler\": {}, \"target\": {{\"node\": {}, \"path\": \"{}\"}}}}",
                                   samplers.size(), node, path));
    samplers.push_back(fmt::format("{{\"input\": {}, \"output\": {}, \"interpolation\": \"LINEAR\"}}", input, output));
  };
  if (!morphing.empty()) {
    std::vector<float> weights(frames * (frames - 1), 0);
    for (std::size_t k = 1; k < frames; ++k) weights[k * (frames - 1) + k - 1] = 1;
    const int shared = add_floats(weights, weights.size(), "\"type\": \"SCALAR\"");
    for (const std::size_t node : morphing) add_channel(node, "weights", shared);
  }
  for (std::size_t k = 0; k < balls_.size(); ++k) {
    const auto add_vectors = [&](const char* path, const std::vector<float>& values) {
      add_channel(1 + sheets_.size() + k, path, add_floats(values, frames, "\"type\": \"VEC3\""));
    };
    if (balls_[k].moves) add_vectors("translation", balls_[k].places);
    if (balls_[k].grows) add_vectors("scale", balls_[k].scales);
  }
  return fmt::format(", \"animations\": [{{\"name\": \"motion\", \"channels\": [{}], \"samplers\": [{}]}}]",
                     fmt::join(channels, ", "), fmt::join(samplers, ", "));
}

std::string GlbWriter::json(GltfParts& parts, std::vector<std::string>& tail) {
  const Look look = film_.look != nullptr ? *film_.look : Look{};
  std::vector<std::string> meshes, nodes;
  std::vector<std::size_t> morphing;  // nodes
  const auto add_mesh = [&](const std::string& name, GltfMorphedMesh& mesh, int material_number,
                            const std::string& more) {
    const std::string primitive = mesh.describe(parts, material_number);
    std::string weights;
    if (mesh.moves()) {
      weights = fmt::format(", \"weights\": [{}]", fmt::join(std::vector<int>(times_.size() - 1, 0), ", "));
      morphing.push_back(nodes.size() + 1);
    }
    nodes.push_back(fmt::format("{{\"name\": \"{}\", \"mesh\": {}{}}}", name, meshes.size(), more));
    meshes.push_back(fmt::format("{{\"name\": \"{}\", \"primitives\": [{}]{}}}", name, primitive, weights));
  };
  const int sheets = static_cast<int>(sheets_.size());  // each with a material of its own, before those of obstacles
  for (int k = 0; k < sheets; ++k) {
    const Sheet& sheet = sheets_[static_cast<std::size_t>(k)];
    add_mesh(sheet.name, *sheet.mesh, k, "");
  }
  for (Ball& ball : balls_) {
    add_mesh(fmt::format("Sphere{}", 1 + (&ball - balls_.data())), *ball.mesh, sheets,
             fmt::format(", \"translation\": [{:.9g}, {:.9g}, {:.9g}]", ball.first.center.x(), ball.first.center.y(),
                         ball.first.center.z()));
  }
  for (Solid& solid : solids_) add_mesh(solid.name, *solid.mesh, sheets + (solid.is_ground ? 2 : 1), "");

  const std::string animations = animation(parts, tail, morphing);
  std::string images;
  const std::vector<std::string> materials = sheet_materials(parts, tail, images);
  std::vector<std::size_t> children(nodes.size());
  std::iota(children.begin(), children.end(), std::size_t{1});
  // A rotation by −90° about x turns z up into y up.
  return fmt::format(
      "{{\"asset\": {{\"version\": \"2.0\", \"generator\": \"drape\"}}, \"scene\": 0, \"scenes\": [{{\"nodes\": "
      "[0]}}], "
      "\"nodes\": [{{\"name\": \"Scene\", \"rotation\": [-0.7071067811865476, 0, 0, 0.7071067811865476], \"children\": "
      "[{}]}}, {}], \"meshes\": [{}], \"materials\": [{}, {}, {}, {}], \"bufferViews\": [{}], \"accessors\": [{}], "
      "\"buffers\": [{{\"byteLength\": {}}}]{}{}}}",
      fmt::join(children, ", "), fmt::join(nodes, ", "), fmt::join(meshes, ", "), fmt::join(materials, ", "),
      material("sphere", look.sphere_color), material("body", look.body_color), material("ground", look.ground_color),
      fmt::join(parts.views(), ", "), fmt::join(parts.accessors(), ", "), parts.size(), animations, images);
}

std::vector<OutputFile> GlbWriter::finish(Ending ending) {
  if (times_.empty()) return {};
  GltfParts parts;
  std::vector<std::string> tail;
  const std::string text = padded(json(parts, tail), ' ');
  const std::uint64_t bytes = (parts.size() + 3) / 4 * 4, whole = 12 + 8 + text.size() + 8 + bytes;
  if (whole > UINT32_MAX) {
    throw OutputError(fmt::format("{}: a .glb holds 4 GB at most: choose fewer frames, with --frames or --every",
                                  file_.file().string()));
  }
  std::string head = "glTF";
  append_number<std::uint32_t>(head, 2);
  append_number<std::uint32_t>(head, static_cast<std::uint32_t>(whole));
  append_number<std::uint32_t>(head, static_cast<std::uint32_t>(text.size()));
  head += "JSON" + text;
  append_number<std::uint32_t>(head, static_cast<std::uint32_t>(bytes));
  head += std::string("BIN\0", 4);
  file_.write(head);
  for (const Sheet& sheet : sheets_) sheet.mesh->write(file_);
  for (Ball& ball : balls_) ball.mesh->write(file_);
  for (Solid& solid : solids_) solid.mesh->write(file_);
  for (const std::string& part : tail) file_.write(part);
  file_.write(std::string(bytes - parts.size(), '\0'));
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat glb_format() {
  return {.extension = ".glb",
          .help = "the motion as binary glTF, for browsers and viewers: cloth, texture, spheres, bodies and grounds",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<GlbWriter>(file, film);
          })};
}

}  // namespace drape
