#include "output/obj_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <string_view>
#include <utility>

namespace drape {
namespace {

/// What is the same in all frames: the lines vt and f.
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

}  // namespace

std::function<std::string(const Frame&)> obj_writer(const FilmInfo& film) {
  const std::string surface = surface_lines(film.triangles(), film.texture_coordinates());
  return [surface](const Frame& frame) {
    std::string text = fmt::format("# drape: frame {} at {:.9g} s, in metres, z up\n", frame.index, frame.time);
    for (const auto& x : frame.positions.rowwise()) {
      fmt::format_to(std::back_inserter(text), "v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
    }
    return text + surface;
  };
}

OutputFormat obj_format() {
  return {.extension = ".obj",
          .help = "the cloth as a Wavefront mesh [m, z up], without spheres and ground",
          .made_by = {},
          .packages = {},
          .make = FrameMaker<Frame>(obj_writer)};
}

}  // namespace drape
