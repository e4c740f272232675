#include "run/poster.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <map>

#include "output/make_sink.hpp"
#include "output/registry.hpp"

namespace drape {

Poster::Poster(const FilmInfo& film) {
  std::map<Edge, int> waiting;  // edges of one triangle so far, with its third vertex
  for (const Triangle& t : film.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
      const Edge edge{std::min(a, b), std::max(a, b)};
      const auto [other, is_new] = waiting.emplace(edge, opposite);
      if (!is_new) hinges_.push_back({edge, {other->second, opposite}});
    }
  }
}

double Poster::bend(const Vertices& x) const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3d from = x.row(hinge.edge[0]), edge = x.row(hinge.edge[1]).transpose() - from;
    const Eigen::Vector3d n = edge.cross(x.row(hinge.opposite[0]).transpose() - from),
                          m = (x.row(hinge.opposite[1]).transpose() - from).cross(edge);
    sum += edge.norm() * std::atan2(n.cross(m).norm(), n.dot(m));
  }
  return sum;
}

void Poster::see(const Frame& frame, const Image& image) {
  constexpr double noise = 1e-9;  // rounding of coordinates bends even a flat cloth
  const double now = bend(frame.positions);
  if (image_ && now <= most_ + noise) return;
  most_ = now;
  image_ = image;
  frame_ = frame.index;
}

std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film) {
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    const OutputFormat* format = find_format(output);
    if (format == nullptr || !format->drawn() || format->file_per_frame()) continue;
    const std::filesystem::path file = output_files(output, film).front();
    files.push_back((file.parent_path() / file.stem()).string() + ".poster.png");
  }
  return files;
}

}  // namespace drape
