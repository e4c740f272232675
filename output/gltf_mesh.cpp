#include "output/gltf_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <map>
#include <utility>

#include "output/bytes.hpp"

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

}  // namespace drape
