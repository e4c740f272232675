#include "output/npz_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <utility>

#include "output/mesh_writers.hpp"

namespace drape {
namespace {

constexpr std::uint16_t version = 45;    // first with 64-bit sizes
constexpr std::uint16_t first_day = 33;  // 1 January 1980, the earliest date
constexpr std::uint32_t in_extra = ~0U;  // marks a size or offset stored in the extra field
constexpr std::uint16_t in_record = 0xFFFF;

/// Appends the part common to an entry's local header and its directory header.
void append_entry(std::string& header, std::uint32_t crc32, std::size_t name, std::size_t extra) {
  append_number<std::uint16_t>(header, version);
  append_number<std::uint16_t>(header, 0);  // flags
  append_number<std::uint16_t>(header, 0);  // stored
  append_number<std::uint16_t>(header, 0);  // time
  append_number<std::uint16_t>(header, first_day);
  append_number<std::uint32_t>(header, crc32);
  append_number<std::uint32_t>(header, in_extra);  // compressed
  append_number<std::uint32_t>(header, in_extra);  // uncompressed
  append_number<std::uint16_t>(header, static_cast<std::uint16_t>(name));
  append_number<std::uint16_t>(header, static_cast<std::uint16_t>(extra));
}

/// Returns the extra field with 64-bit sizes.
std::string wide_field(std::initializer_list<std::uint64_t> numbers) {
  std::string field;
  append_number<std::uint16_t>(field, 1);
  append_number<std::uint16_t>(field, static_cast<std::uint16_t>(8 * numbers.size()));
  for (const std::uint64_t number : numbers) append_number<std::uint64_t>(field, number);
  return field;
}

}  // namespace

void ZipWriter::write(std::string_view bytes) {
  file_.write(bytes);
  written_ += bytes.size();
}

void ZipWriter::begin(const std::string& name, std::uint64_t size, std::uint32_t crc32) {
  entries_.push_back({name, size, written_, crc32});
  const std::string extra = wide_field({size, size});
  std::string header = "PK\x03\x04";
  append_entry(header, crc32, name.size(), extra.size());
  write(header + name + extra);
  written_ += size;
}

void ZipWriter::finish() {
  const std::uint64_t start = written_;
  for (const Entry& entry : entries_) {
    const std::string extra = wide_field({entry.size, entry.size, entry.offset});
    std::string header = "PK\x01\x02";
    append_number<std::uint16_t>(header, version);  // of the writer
    append_entry(header, entry.crc32, entry.name.size(), extra.size());
    append_number<std::uint16_t>(header, 0);  // comment
    append_number<std::uint16_t>(header, 0);  // disk
    append_number<std::uint16_t>(header, 0);  // attributes
    append_number<std::uint32_t>(header, 0);
    append_number<std::uint32_t>(header, in_extra);  // offset
    write(header + entry.name + extra);
  }
  const std::uint64_t end = written_;

  std::string tail = "PK\x06\x06";         // end of the directory, 64-bit
  append_number<std::uint64_t>(tail, 44);  // size of the rest
  append_number<std::uint16_t>(tail, version);
  append_number<std::uint16_t>(tail, version);
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint64_t>(tail, entries_.size());
  append_number<std::uint64_t>(tail, entries_.size());
  append_number<std::uint64_t>(tail, end - start);
  append_number<std::uint64_t>(tail, start);
  tail += "PK\x06\x07";  // locator of that record
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint64_t>(tail, end);
  append_number<std::uint32_t>(tail, 1);
  tail += "PK\x05\x06";  // 16-bit end of the directory, whose values refer to the 64-bit one
  append_number<std::uint32_t>(tail, 0);
  append_number<std::uint16_t>(tail, in_record);
  append_number<std::uint16_t>(tail, in_record);
  append_number<std::uint32_t>(tail, in_extra);
  append_number<std::uint32_t>(tail, in_extra);
  append_number<std::uint16_t>(tail, 0);
  write(tail);
}

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

void NpzWriter::make_cloths(const std::vector<ClothPiece>& pieces) {
  const auto longer = [](const ClothPiece& a, const ClothPiece& b) { return a.name.size() < b.name.size(); };
  const std::size_t longest = std::ranges::max_element(pieces, longer)->name.size();
  std::string names;  // UTF-32; the names are ASCII
  for (const ClothPiece& piece : pieces) {
    for (std::size_t i = 0; i < longest; ++i) {
      append_number<std::uint32_t>(names, i < piece.name.size() ? static_cast<unsigned char>(piece.name[i]) : 0U);
    }
  }
  make("cloth_names", fmt::format("'<U{}'", longest), {}).append_rows(pieces.size(), names);
  make("cloths", "'<i4'", {}).append_rows(vertices_, bytes_of(pieces_of_vertices(*film_.cloth)));
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
  if (film_.cloth != nullptr && film_.cloth->pieces.size() > 1) make_cloths(film_.cloth->pieces);
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
