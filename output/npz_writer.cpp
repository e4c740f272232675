#include "output/npz_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <utility>

#include "output/bytes.hpp"
#include "output/zip_writer.hpp"

namespace drape {
namespace {

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <class Shape>
std::size_t count_of(const Frame& frame) {
  std::size_t count = 0;
  for (const Collider& collider : frame.colliders) count += std::holds_alternative<Shape>(collider) ? 1 : 0;
  return count;
}

std::string numbers(std::initializer_list<double> values) {
  std::string bytes;
  for (const double value : values) append_number<double>(bytes, value);
  return bytes;
}

}  // namespace

NpyArray::NpyArray(const PartialFile& output, std::string name, std::string type, std::vector<std::size_t> row)
    : name_(std::move(name)), type_(std::move(type)), row_(std::move(row)), data_(output, "its " + name_) {}

void NpyArray::append(std::string_view row) { append_rows(1, row); }

void NpyArray::append_rows(std::size_t count, std::string_view bytes) {
  data_.append(bytes);
  crc32_ = crc32_of(bytes, crc32_);
  rows_ += count;
}

std::string NpyArray::header() const {
  std::string shape = fmt::format("{},", rows_);
  for (const std::size_t length : row_) shape += fmt::format(" {},", length);
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({}), }}", type_, shape);
  constexpr std::size_t before = 10, alignment = 64;
  text.append(alignment - 1 - (before + text.size()) % alignment, ' ');
  text += '\n';
  std::string header = "\x93NUMPY";
  header += {1, 0};
  append_number<std::uint16_t>(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

std::uint32_t NpyArray::crc32() const {
  return static_cast<std::uint32_t>(::crc32_combine(crc32_of(header()), crc32_, static_cast<z_off_t>(data_.size())));
}

void NpyArray::copy_to(PartialFile& file) {
  file.write(header());
  data_.copy_to(file);
}

NpzWriter::NpzWriter(const std::filesystem::path& file, const FilmInfo& film) : film_(film), file_(file) {}

NpyArray& NpzWriter::make(std::string name, std::string type, std::vector<std::size_t> row) {
  return *arrays_.emplace_back(std::make_unique<NpyArray>(file_, std::move(name), std::move(type), std::move(row)));
}

void NpzWriter::make_colliders(const Frame& first) {
  of_.spheres = &make("spheres", "'<f8'", {count_of<SphereShape>(first), 4});
  of_.grounds = &make("grounds", "'<f8'", {count_of<GroundShape>(first), 4});
  for (const Collider& collider : first.colliders) {
    const auto* mesh = std::get_if<MeshShape>(&collider);
    if (mesh == nullptr) continue;
    NpyArray& positions = make(fmt::format("body{}_positions", bodies_.size() + 1), "'<f8'",
                               {static_cast<std::size_t>(mesh->positions.rows()), 3});
    bodies_.push_back({&positions, mesh->triangles, {}});
  }
}

void NpzWriter::add_bodies(const Frame& frame) {
  std::size_t k = 0;
  for (const Collider& collider : frame.colliders) {
    const auto* mesh = std::get_if<MeshShape>(&collider);
    if (mesh == nullptr) continue;
    Body& body = bodies_.at(k++);
    const std::string now = vertex_bytes<double>(mesh->positions);
    if (frames_ == 0) {
      body.first = now;
      body.positions->append(now);
      continue;
    }
    if (!body.moves && now == body.first) continue;
    for (std::size_t i = 1; !body.moves && i < frames_; ++i) body.positions->append(body.first);
    body.moves = true;
    body.positions->append(now);
  }
  ++frames_;
}

void NpzWriter::add(const Frame& frame) {
  if (arrays_.empty()) {
    vertices_ = static_cast<std::size_t>(frame.positions.rows());
    of_.positions = &make("positions", "'<f8'", {vertices_, 3});
    of_.velocities = &make("velocities", "'<f8'", {vertices_, 3});
    of_.times = &make("times", "'<f8'", {});
    of_.frames = &make("frames", "'<i8'", {});
    of_.energies =
        &make("energies", "[('total', '<f8'), ('kinetic', '<f8'), ('gravity', '<f8'), ('elastic', '<f8')]", {});
    make_colliders(frame);
  }
  of_.positions->append(vertex_bytes<double>(frame.positions));
  of_.velocities->append(vertex_bytes<double>(frame.velocities));
  of_.times->append(numbers({frame.time}));
  std::string index;
  append_number<std::int64_t>(index, frame.index);
  of_.frames->append(index);
  const Energies e = frame.energies.value_or(Energies{});
  of_.energies->append(numbers({e.total(), e.kinetic, e.gravity, e.elastic}));
  std::string spheres, grounds;
  for (const Collider& collider : frame.colliders) {
    if (const auto* s = std::get_if<SphereShape>(&collider)) {
      spheres += numbers({s->center.x(), s->center.y(), s->center.z(), s->radius});
    } else if (const auto* g = std::get_if<GroundShape>(&collider)) {
      grounds += numbers({g->normal.x(), g->normal.y(), g->normal.z(), g->height});
    }
  }
  of_.spheres->append(spheres);
  of_.grounds->append(grounds);
  add_bodies(frame);
}

std::vector<OutputFile> NpzWriter::finish(Ending ending) {
  if (arrays_.empty()) return {};
  make("faces", "'<i4'", {3}).append_rows(film_.triangles().size(), bytes_of(film_.triangles()));
  make("uvs", "'<f4'", {3, 2})
      .append_rows(film_.texture_coordinates().size() / 3, bytes_of(film_.texture_coordinates()));
  if (film_.cloth != nullptr)
    make("rest", "'<f8'", {3}).append_rows(vertices_, vertex_bytes<double>(film_.cloth->rest));
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const std::vector<Triangle>& triangles = *bodies_[k].triangles;
    make(fmt::format("body{}_faces", k + 1), "'<i4'", {3}).append_rows(triangles.size(), bytes_of(triangles));
  }
  make("fps", "'<f8'", {}).append(numbers({film_.fps}));

  ZipWriter zip(file_);
  for (const auto& array : arrays_) {
    zip.begin(array->file_name(), array->header().size() + array->data_size(), array->crc32());
    array->copy_to(file_);
  }
  zip.finish();
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat npz_format() {
  return {.extension = ".npz",
          .help = "the motion as numpy arrays: positions, velocities, faces, times, energies and more",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<NpzWriter>(file, film);
          })};
}

}  // namespace drape
