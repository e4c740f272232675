#include "motion/import/npz.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <charconv>
#include <cstring>
#include <regex>

#include "motion/import/import_motion.hpp"
#include "motion/import/motion_source.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

void require_shape(const NpyStream& array, std::vector<std::size_t> expected, const char* text) {
  bool good = array.shape().size() == expected.size();
  for (std::size_t i = 0; good && i < expected.size(); ++i) good = expected[i] == 0 || expected[i] == array.shape()[i];
  if (!good) array.fail(fmt::format("expected the shape {}, found ({})", text, fmt::join(array.shape(), ", ")));
}

/// Positions and faces of a cloth or a body.
class NpzMotion final : public MotionSource {
 public:
  NpzMotion(std::shared_ptr<const ZipReader> zip, std::unique_ptr<NpyStream> positions,
            std::unique_ptr<NpyStream> faces)
      : zip_(std::move(zip)), name_(zip_->file().string()), positions_(std::move(positions)) {
    require_shape(*positions_, {0, 0, 3}, "(frames, vertices, 3)");
    count_ = positions_->rows();
    if (count_ == 0 || positions_->shape()[1] == 0) positions_->fail("it has no frames or no vertices");
    mesh_.positions = next();
    if (faces->shape().size() != 2) faces->fail("expected the shape (faces, corners)");
    const std::vector<double> corners = faces->rest();
    add_faces(faces->name(), std::vector<std::size_t>(faces->rows(), faces->row_size()), corners, mesh_);
  }

  /// Reads the archive's other arrays for a cloth.
  void read_more() {
    velocities_ = array_named(*zip_, {"velocities"});
    if (velocities_ && velocities_->shape() != positions_->shape()) velocities_ = nullptr;
    energies_ = array_named(*zip_, {"energies"});
    if (energies_ && (energies_->rows() != count_ || energies_->fields().size() != 4)) energies_ = nullptr;
    if (const auto uvs = array_named(*zip_, {"uvs"});
        uvs && uvs->rows() == mesh_.triangles.size() && uvs->row_size() == 6) {
      const std::vector<double> all = uvs->rest();
      for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
        mesh_.uvs.push_back({static_cast<float>(all[i]), static_cast<float>(all[i + 1])});
      }
    }
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return count_; }

  [[nodiscard]] std::vector<double> times() override {
    const auto array = array_named(*zip_, {"times", "time", "t"});
    if (!array) return {};
    require_shape(*array, {count_}, "(frames,)");
    return array->rest();
  }

  [[nodiscard]] std::optional<Vertices> rest() override {
    const auto array = array_named(*zip_, {"rest"});
    if (!array) return std::nullopt;
    require_shape(*array, {static_cast<std::size_t>(mesh_.positions.rows()), 3}, "(vertices, 3)");
    Vertices x = vertices_of(array->name(), array->rest());
    require_finite(array->name(), x);
    return x;
  }

  [[nodiscard]] std::optional<double> fps() override {
    const auto array = array_named(*zip_, {"fps"});
    if (!array || array->rows() < 1) return std::nullopt;
    return array->row().front();
  }

  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    ImportedMoment moment{.x = i == 0 ? mesh_.positions : next()};
    if (velocities_) {
      moment.v = vertices_of(velocities_->name(), velocities_->row());
      require_finite(velocities_->name(), moment.v);
    }
    if (energies_) {
      const std::vector<double> all = energies_->row();  // total, kinetic, gravity, elastic
      moment.energies = Energies{.kinetic = all[1], .gravity = all[2], .elastic = all[3]};
    }
    return moment;
  }

  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders found;
    for (const auto& [name, shapes] : {std::pair("spheres", &found.spheres), std::pair("grounds", &found.grounds)}) {
      const auto array = array_named(*zip_, {name});
      if (!array || array->shape().size() != 3 || array->shape()[1] == 0) continue;
      require_shape(*array, {count_, 0, 4}, "(frames, shapes, 4)");
      for (std::size_t i = 0; i < count_; ++i) {
        const std::vector<double> all = array->row();
        std::vector<Eigen::Vector4d> row;
        for (std::size_t k = 0; k + 4 <= all.size(); k += 4) row.emplace_back(&all[k]);
        shapes->by_moment.push_back(std::move(row));
      }
    }
    for (int k = 1;; ++k) {
      auto positions = array_named(*zip_, {fmt::format("body{}_positions", k)});
      auto faces = array_named(*zip_, {fmt::format("body{}_faces", k)});
      if (!positions || !faces) break;
      found.bodies.push_back(std::make_shared<NpzMotion>(zip_, std::move(positions), std::move(faces)));
    }
    return found;
  }

 private:
  Vertices next() {
    Vertices x = vertices_of(positions_->name(), positions_->row());
    require_finite(fmt::format("{}: frame {}", positions_->name(), read_++), x);
    return x;
  }

  std::shared_ptr<const ZipReader> zip_;
  std::string name_;
  std::unique_ptr<NpyStream> positions_, velocities_, energies_;
  std::size_t count_ = 0, read_ = 0;
  Mesh mesh_;
};

}  // namespace

std::unique_ptr<MotionSource> open_npz(const fs::path& file) {
  const auto zip = std::make_shared<const ZipReader>(file);
  auto positions = array_named(*zip, {"positions", "vertices", "verts", "x"});
  auto faces = array_named(*zip, {"faces", "triangles", "f"});
  if (!positions || !faces) {
    std::string names;
    for (const ZipReader::Member& member : zip->members()) names += (names.empty() ? "" : ", ") + member.name;
    fail_import(file.string(),
                fmt::format("expected the arrays positions and faces, found {}", names.empty() ? "none" : names));
  }
  auto motion = std::make_unique<NpzMotion>(zip, std::move(positions), std::move(faces));
  motion->read_more();
  return motion;
}

namespace {

/// Parses a type such as "<f8"; returns nothing for unsupported types.
std::optional<NumberType> numpy_type(const std::string& text) {
  if (text.size() != 3) return std::nullopt;
  const auto size = static_cast<std::size_t>(text[2] - '0');
  const bool known = size == 1 || size == 2 || size == 4 || size == 8;
  using Kind = NumberType::Kind;
  const std::optional<Kind> kind = text[1] == 'f'                     ? std::optional(Kind::real)
                                   : text[1] == 'i'                   ? std::optional(Kind::integer)
                                   : text[1] == 'u' || text[1] == 'b' ? std::optional(Kind::natural)
                                                                      : std::nullopt;
  if (!known || !kind || (*kind == Kind::real && size < 4)) return std::nullopt;
  return NumberType{*kind, size, text[0] == '>'};
}

constexpr std::size_t most_header_bytes = 1 << 20;

}  // namespace

NpyStream::NpyStream(const ZipReader& zip, const ZipReader::Member& member)
    : stream_(zip, member), name_(fmt::format("{}: {}", zip.file().string(), member.name)) {
  if (name_.ends_with(".npy")) name_.resize(name_.size() - 4);
  read_header();
}

void NpyStream::fail(const std::string& message) const { fail_import(name_, message); }

void NpyStream::read_header() {
  const std::string magic = stream_.read(8);
  if (!magic.starts_with("\x93NUMPY")) fail("it is no array of numpy's");
  const bool wide = magic[6] != 1;
  const std::string length = stream_.read(wide ? 4 : 2);
  const auto size =
      static_cast<std::size_t>(number_at(length.data(), {NumberType::Kind::natural, length.size(), false}));
  if (size > most_header_bytes) fail("its header is too long");
  const std::string header = stream_.read(size);
  std::smatch found;
  static const std::regex shape_text(R"('shape':\s*\(([0-9, L]*)\))"), plain(R"('descr':\s*'([^']*)')"),
      records(R"('descr':\s*\[(.*?)\])"), field(R"(\('([^']*)',\s*'([^']*)'\))");
  if (!std::regex_search(header, found, shape_text)) fail("its header has no shape");
  const std::string axes = found[1];
  double bytes = 1;
  for (std::size_t at = 0; (at = axes.find_first_of("0123456789", at)) != std::string::npos;) {
    std::size_t length_of_axis = 0;
    const auto read = std::from_chars(axes.data() + at, axes.data() + axes.size(), length_of_axis);
    if (read.ec != std::errc()) fail("its shape cannot be read");
    shape_.push_back(length_of_axis);
    bytes *= static_cast<double>(length_of_axis);
    at = static_cast<std::size_t>(read.ptr - axes.data());
  }
  const auto take = [&](const std::string& text) {
    const std::optional<NumberType> type = numpy_type(text);
    if (!type) fail(fmt::format("its numbers are of the type {}; expected floats or whole numbers", text));
    type_ = *type;
  };
  if (std::regex_search(header, found, plain)) {
    take(found[1]);
  } else if (std::regex_search(header, found, records)) {
    const std::string list = found[1];
    std::string common;
    for (std::sregex_iterator one(list.begin(), list.end(), field), end; one != end; ++one) {
      fields_.push_back((*one)[1]);
      if (!common.empty() && common != (*one)[2]) fail("its records have fields of several types");
      common = (*one)[2];
      take(common);
    }
  }
  if (header.find("'fortran_order': True") != std::string::npos && shape_.size() > 1) {
    fail("expected numbers in C order, found Fortran's: save numpy.ascontiguousarray of it");
  }
  bytes *= static_cast<double>(type_.size * std::max<std::size_t>(1, fields_.size()));
  if (bytes > static_cast<double>(stream_.left()))
    fail("it is damaged or cut short: its header says more than there is");
}

std::size_t NpyStream::row_size() const {
  std::size_t size = std::max<std::size_t>(1, fields_.size());
  for (std::size_t i = 1; i < shape_.size(); ++i) size *= shape_[i];
  return size;
}

std::vector<double> NpyStream::row() {
  if (next_++ >= rows()) fail("it has too few rows");
  return numbers_in(stream_.read(row_size() * type_.size), type_);
}

std::vector<double> NpyStream::rest() {
  std::vector<double> all;
  while (next_ < rows()) {
    const std::vector<double> one = row();
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

std::unique_ptr<NpyStream> array_named(const ZipReader& zip, std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    const auto found = std::ranges::find(zip.members(), name + ".npy", &ZipReader::Member::name);
    if (found != zip.members().end()) return std::make_unique<NpyStream>(zip, *found);
  }
  return nullptr;
}

namespace {

std::uint64_t whole(const std::string& bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) return 0;
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, size);
  return value;
}

std::string bytes_at(std::ifstream& stream, std::uint64_t begin, std::uint64_t count) {
  std::string bytes(count, '\0');
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(begin));
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return bytes;
}

constexpr std::uint64_t most_directory_bytes = 100'000'000;

}  // namespace

ZipReader::ZipReader(std::filesystem::path file) : file_(std::move(file)) {
  const std::string name = file_.string();
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file_, error);
  std::ifstream stream(file_, std::ios::binary);
  if (error || !stream) fail_import(name, "the file cannot be read: " + (error ? error.message() : "no permission"));
  const auto fail = [&]() {
    fail_import(name, "expected an NPZ file, found no directory of one: it is cut short, or something else");
  };
  const std::uint64_t tail_size = std::min<std::uint64_t>(size, 22 + 65535 + 20);
  const std::string tail = bytes_at(stream, size - tail_size, tail_size);
  const std::size_t end = tail.rfind("PK\x05\x06");
  if (end == std::string::npos) fail();
  std::uint64_t bytes = whole(tail, end + 12, 4), begin = whole(tail, end + 16, 4), count = whole(tail, end + 10, 2);
  if (end >= 20 && tail.compare(end - 20, 4, "PK\x06\x07") == 0) {
    const std::string wide = bytes_at(stream, whole(tail, end - 20 + 8, 8), 56);
    if (wide.size() < 56 || !wide.starts_with("PK\x06\x06")) fail();
    count = whole(wide, 32, 8);
    bytes = whole(wide, 40, 8);
    begin = whole(wide, 48, 8);
  }
  if (bytes > most_directory_bytes || begin > size || bytes > size - begin) fail();
  const std::string directory = bytes_at(stream, begin, bytes);
  for (std::size_t at = 0; members_.size() < count;) {
    constexpr std::size_t header_size = 46;
    if (directory.compare(at, 4, "PK\x01\x02") != 0 || directory.size() - at < header_size) fail();
    const std::size_t name_size = whole(directory, at + 28, 2), extra_size = whole(directory, at + 30, 2);
    if (directory.size() - at - header_size < name_size) fail();
    Member member{.name = directory.substr(at + 46, name_size),
                  .offset = whole(directory, at + 42, 4),
                  .packed = whole(directory, at + 20, 4),
                  .size = whole(directory, at + 24, 4)};
    const std::uint64_t method = whole(directory, at + 10, 2);
    if (method != 0 && method != 8)
      fail_import(name, fmt::format("its member {} is packed in an unknown way", member.name));
    member.deflated = method == 8;
    for (std::size_t extra = at + 46 + name_size, last = extra + extra_size;
         extra + 4 <= last && extra + 4 <= directory.size();) {
      const std::size_t length = whole(directory, extra + 2, 2);
      if (whole(directory, extra, 2) == 1) {  // 64-bit sizes, for fields at their maximum
        std::size_t field = extra + 4;
        for (std::uint64_t* number : {&member.size, &member.packed, &member.offset}) {
          if (*number != 0xFFFFFFFF) continue;
          *number = whole(directory, field, 8);
          field += 8;
        }
      }
      extra += 4 + length;
    }
    if (member.offset > size || member.packed > size) fail();
    members_.push_back(std::move(member));
    at += 46 + name_size + extra_size + whole(directory, at + 32, 2);
    if (at > directory.size()) fail();
  }
}

struct ZipStream::Inflater {
  z_stream state{};
  std::string input = {};
  Inflater() { inflateInit2(&state, -MAX_WBITS); }
  ~Inflater() { inflateEnd(&state); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

ZipStream::ZipStream(const ZipReader& zip, const ZipReader::Member& member)
    : name_(fmt::format("{}: {}", zip.file().string(), member.name)),
      stream_(zip.file(), std::ios::binary),
      packed_left_(member.packed),
      left_(member.size) {
  const std::string header = bytes_at(stream_, member.offset, 30);
  if (header.size() < 30 || !header.starts_with("PK\x03\x04")) fail_cut();
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(member.offset + 30 + whole(header, 26, 2) + whole(header, 28, 2)));
  if (member.deflated) {
    inflater_ = std::make_unique<Inflater>();
  } else if (packed_left_ < left_) {
    fail_cut();
  }
}

ZipStream::~ZipStream() = default;

void ZipStream::fail_cut() const { fail_import(name_, "it is damaged or cut short"); }

std::string ZipStream::read(std::size_t count) {
  if (count > left_) fail_cut();
  std::string bytes;
  left_ -= count;
  if (!inflater_) {
    bytes.resize(count);
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!stream_) fail_cut();
    return bytes;
  }
  bytes.resize(count);
  z_stream& state = inflater_->state;
  constexpr std::size_t piece = 1 << 16;
  for (std::size_t done = 0; done < count;) {
    if (state.avail_in == 0) {
      inflater_->input.resize(static_cast<std::size_t>(std::min<std::uint64_t>(piece, packed_left_)));
      stream_.read(inflater_->input.data(), static_cast<std::streamsize>(inflater_->input.size()));
      if (!stream_ || inflater_->input.empty()) fail_cut();
      packed_left_ -= inflater_->input.size();
      state.next_in = reinterpret_cast<Bytef*>(inflater_->input.data());
      state.avail_in = static_cast<uInt>(inflater_->input.size());
    }
    const std::size_t wanted = std::min<std::size_t>(count - done, std::size_t{1} << 30);
    state.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
    state.avail_out = static_cast<uInt>(wanted);
    const int result = inflate(&state, Z_NO_FLUSH);
    done += wanted - state.avail_out;
    if (result == Z_STREAM_END && done < count) fail_cut();
    if (result != Z_OK && result != Z_STREAM_END && !(result == Z_BUF_ERROR && state.avail_in == 0)) fail_cut();
  }
  return bytes;
}

}  // namespace drape
