#include "output/ply_writer.hpp"

#include <fmt/format.h>

#include "output/bytes.hpp"

namespace drape {

std::function<std::string(const Frame&)> ply_writer(const FilmInfo& film) {
  std::string faces;
  for (const Triangle& triangle : film.triangles()) {
    append_number<std::uint8_t>(faces, 3);
    for (const int vertex : triangle) append_number<std::int32_t>(faces, vertex);
  }
  return [faces, count = film.triangles().size()](const Frame& frame) {
    return fmt::format(
               "ply\nformat binary_little_endian 1.0\ncomment drape: frame {} at {:.9g} s, in metres, z up\n"
               "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
               "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
               frame.index, frame.time, frame.positions.rows(), count) +
           vertex_bytes<double>(frame.positions) + faces;
  };
}

OutputFormat ply_format() {
  return {.extension = ".ply",
          .help = "the cloth as a binary PLY mesh [m, z up]",
          .made_by = {},
          .packages = {},
          .make = FrameMaker<Frame>(ply_writer)};
}

}  // namespace drape
