#include "output/pc2_writer.hpp"

#include <memory>

#include "output/beside.hpp"
#include "output/bytes.hpp"
#include "output/obj_writer.hpp"

namespace drape {

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

}  // namespace drape
