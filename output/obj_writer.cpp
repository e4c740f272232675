#include "output/obj_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "output/collider_mesh.hpp"

namespace drape {
namespace {

/// Returns the lines that all frames share: vt and f.
std::string surface_lines(const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs) {
  std::string coordinates, faces;
  std::map<std::array<float, 2>, std::size_t> numbers;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
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
  const std::string surface = surface_lines(film.triangles(), film.texture_coordinates());
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

}  // namespace drape
