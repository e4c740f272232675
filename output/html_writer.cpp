#include "output/html_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "drape/core/error.hpp"
#include "drape/core/rotation.hpp"
#include "output/mesh_writers.hpp"
#include "output/png_encoder.hpp"
#include "render/overlay/color_scale.hpp"
#include "reports/components.hpp"
#include "reports/page.hpp"

namespace drape {
namespace {

/// Maps 0, −1, 1, −2, … to 0, 1, 2, 3, …
std::uint64_t zigzag(std::int64_t number) {
  return (static_cast<std::uint64_t>(number) << 1) ^ static_cast<std::uint64_t>(number >> 63);
}

/// Returns the length of all residuals [bits], without their prefixes.
std::int64_t length(const VertexIntegers& residuals) {
  std::int64_t bits = 0;
  for (const std::int64_t residual : residuals.reshaped()) bits += std::bit_width(zigzag(residual));
  return bits;
}

}  // namespace

LowerNeighbours::LowerNeighbours(const std::vector<Triangle>& triangles, Eigen::Index vertices) {
  std::vector<std::array<int, 2>> edges;  // the higher vertex first
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      if (low != high) edges.push_back({high, low});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  begin_.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& [high, low] : edges) {
    ++begin_[static_cast<std::size_t>(high) + 1];
    neighbours_.push_back(low);
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

std::int64_t LowerNeighbours::mean(const VertexIntegers& values, Eigen::Index column, Eigen::Index vertex) const {
  const std::size_t from = begin_[static_cast<std::size_t>(vertex)], to = begin_[static_cast<std::size_t>(vertex) + 1];
  if (from == to) return 0;
  std::int64_t sum = 0;
  for (std::size_t k = from; k < to; ++k) sum += values(neighbours_[k], column);
  const auto count = static_cast<std::int64_t>(to - from);
  return sum >= 0 ? sum / count : -((count - 1 - sum) / count);
}

IntegerTrack::IntegerTrack(const std::vector<Triangle>& triangles, Eigen::Index vertices, Eigen::Index columns)
    : neighbours_(triangles, vertices),
      before_(VertexIntegers::Zero(vertices, columns)),
      two_before_(VertexIntegers::Zero(vertices, columns)) {}

void IntegerTrack::append(const VertexIntegers& now, std::string& bytes) {
  if (!first_ && now == before_) {
    bytes += '\0';
    two_before_ = before_;
    return;
  }
  first_ = false;
  VertexIntegers best;
  char mode = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  const auto consider = [&](char as, VertexIntegers&& residuals) {
    const std::int64_t bits = length(residuals);
    if (bits >= least) return;
    least = bits;
    mode = as;
    best = std::move(residuals);
  };
  for (const char line : {char{0}, char{1}}) {
    VertexIntegers residuals = now - before_;
    if (line == 1) residuals -= before_ - two_before_;
    VertexIntegers from_neighbours = residuals;
    for (Eigen::Index c = 0; c < now.cols(); ++c) {
      for (Eigen::Index i = 0; i < now.rows(); ++i) from_neighbours(i, c) -= neighbours_.mean(residuals, c, i);
    }
    consider(static_cast<char>(1 + line), std::move(residuals));
    consider(static_cast<char>(3 + line), std::move(from_neighbours));
  }
  bytes += mode;
  for (const std::int64_t residual : best.reshaped()) append_varint(residual, bytes);
  two_before_ = before_;
  before_ = now;
}

void append_varint(std::int64_t number, std::string& bytes) {
  std::uint64_t rest = zigzag(number);
  for (; rest >= 128; rest >>= 7) bytes += static_cast<char>((rest & 127) | 128);
  bytes += static_cast<char>(rest);
}

namespace {

constexpr double cloth_parts = 6000, edge_parts = 100;  // precisions in the cloth's size and in an edge
constexpr double farthest = 1e8;                        // [precision]; differences of three positions fit into 32 bits
constexpr int most_texture_pixels = 256;
constexpr double texture_parts = 4096;  // steps per texture coordinate
constexpr double least_strain = 0.0005, strain_steps = 48;

double diagonal(const Vertices& x) {
  return x.rows() == 0 ? 0 : (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
}

void append_triangles(const std::vector<Triangle>& triangles, std::string& bytes) {
  int before = 0;
  for (const Triangle& t : triangles) {
    for (const int vertex : t) {
      append_varint(vertex - before, bytes);
      before = vertex;
    }
  }
}

/// Returns "[0.85, 0.65, 0.13]".
std::string list(const Rgb& color) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", color.r, color.g, color.b); }

void append_floats(std::initializer_list<double> numbers, std::string& bytes) {
  for (const double number : numbers) append_number<float>(bytes, static_cast<float>(number));
}

/// Returns the number of vertices of the cloth and the bodies.
std::size_t vertices_of(const Frame& frame) {
  auto count = static_cast<std::size_t>(frame.positions.rows());
  for (const Collider& collider : frame.colliders) {
    if (const auto* body = std::get_if<MeshShape>(&collider)) count += static_cast<std::size_t>(body->positions.rows());
  }
  return count;
}

}  // namespace

/// A growing zlib stream.
class MotionPacker::Compressor {
 public:
  Compressor() {
    if (deflateInit(&stream_, Z_BEST_COMPRESSION) != Z_OK) throw OutputError("zlib has no memory");
  }
  ~Compressor() { deflateEnd(&stream_); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  void append(std::string_view bytes) { run(bytes, Z_NO_FLUSH); }
  std::string finish() {
    run({}, Z_FINISH);
    return std::move(packed_);
  }

 private:
  void run(std::string_view bytes, int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    std::array<Bytef, 1 << 15> room;
    do {
      stream_.next_out = room.data();
      stream_.avail_out = static_cast<uInt>(room.size());
      deflate(&stream_, flush);
      packed_.append(reinterpret_cast<const char*>(room.data()), room.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_ = {};
  std::string packed_;
};

MotionPacker::MotionPacker(const FilmInfo& film)
    : film_(film), scale_(std::nullopt), compressor_(std::make_unique<Compressor>()) {}

MotionPacker::~MotionPacker() = default;

void MotionPacker::add_mesh(const std::vector<Triangle>& triangles, Eigen::Index vertices, std::string& bytes) {
  const auto count = static_cast<std::size_t>(vertices);
  meshes_.push_back({IntegerTrack(triangles, vertices, 3), count, triangles.size()});
  append_triangles(triangles, bytes);
}

void MotionPacker::add_first(const Frame& frame) {
  const Vertices& x = frame.positions;
  const Vertices& rest = film_.cloth != nullptr ? film_.cloth->rest : x;
  time_ = frame.time;
  lowest_ = x.colwise().minCoeff();
  highest_ = x.colwise().maxCoeff();
  origin_ = (lowest_ + highest_) / 2;
  patch_ = ground_patch(x);
  const double size = std::max(diagonal(x), diagonal(rest)), edge = mean_edge(rest, film_.triangles());
  precision_ = size / cloth_parts;
  if (edge > 0) precision_ = std::min(precision_, edge / edge_parts);
  if (!(precision_ > 0)) precision_ = 1e-6;
  std::string bytes;
  add_mesh(film_.triangles(), x.rows(), bytes);
  add_texture(bytes);
  poster_.emplace(film_.triangles());
  stretch_.emplace(rest, film_.triangles());
  strain_.emplace(film_.triangles(), x.rows(), 1);
  for (const Collider& collider : frame.colliders) {
    if (std::holds_alternative<SphereShape>(collider)) ++spheres_;
    if (std::holds_alternative<GroundShape>(collider)) ++grounds_;
    if (const auto* body = std::get_if<MeshShape>(&collider)) add_mesh(*body->triangles, body->positions.rows(), bytes);
  }
  compressor_->append(bytes);
}

void MotionPacker::add_texture(std::string& bytes) {
  const auto& uvs = film_.texture_coordinates();
  if (film_.look == nullptr || film_.look->texture.empty() || uvs.empty()) return;
  texture_ = png_of_texture(film_.look->texture, most_texture_pixels);
  std::array<std::int64_t, 2> before{};
  for (const std::array<float, 2>& uv : uvs) {
    for (std::size_t c = 0; c < 2; ++c) {
      const auto now = static_cast<std::int64_t>(std::llround(texture_parts * static_cast<double>(uv[c])));
      append_varint(now - before[c], bytes);
      before[c] = now;
    }
  }
}

VertexIntegers MotionPacker::whole(const Vertices& x) const {
  const Vertices parts = (x.rowwise() - origin_) / precision_;
  if (parts.size() > 0 && !(parts.cwiseAbs().maxCoeff() < farthest)) {
    throw OutputError(fmt::format(
        "a vertex is further than {:.3g} m from the cloth's first frame, which is beyond a page's precision",
        farthest * precision_));
  }
  return parts.array().round().cast<std::int64_t>();
}

void MotionPacker::add(const Frame& frame) {
  const std::size_t vertices = vertices_of(frame), most_frames = most_positions / std::max<std::size_t>(vertices, 1);
  if (static_cast<std::size_t>(std::max(film_.expected_frames, frames_ + 1)) > most_frames) {
    throw OutputError(
        fmt::format("a page holds {} frames of {} vertices at most: choose fewer, with --frames or --every",
                    most_frames, vertices));
  }
  if (frames_ == 0) add_first(frame);
  ++frames_;
  poster_->see(frame.positions);
  std::string bytes;
  meshes_.front().track.append(whole(frame.positions), bytes);
  const Eigen::VectorXd strain = (*stretch_)(frame.positions).array() - 1;
  scale_.survey(strain);
  const Eigen::ArrayXd logs = (1 + strain.array().max(0.) / least_strain).log() * (strain_steps / std::log(2.));
  strain_->append(logs.round().cast<std::int64_t>().matrix(), bytes);
  lowest_ = lowest_.cwiseMin(frame.positions.colwise().minCoeff());
  highest_ = highest_.cwiseMax(frame.positions.colwise().maxCoeff());
  pack_colliders(frame, bytes);
  compressor_->append(bytes);
}

void MotionPacker::pack_colliders(const Frame& frame, std::string& bytes) {
  const auto cover = [&](const Eigen::RowVector3d& low, const Eigen::RowVector3d& high) {
    lowest_ = lowest_.cwiseMin(low);
    highest_ = highest_.cwiseMax(high);
  };
  std::string balls, planes;
  std::size_t mesh = 1;
  for (const Collider& collider : frame.colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      append_floats({sphere->center.x(), sphere->center.y(), sphere->center.z(), sphere->radius}, balls);
      cover(sphere->center.transpose().array() - sphere->radius, sphere->center.transpose().array() + sphere->radius);
    } else if (const auto* ground = std::get_if<GroundShape>(&collider)) {
      append_floats({ground->normal.x(), ground->normal.y(), ground->normal.z(), ground->height}, planes);
    } else {
      const Vertices& x = std::get<MeshShape>(collider).positions;
      meshes_.at(mesh++).track.append(whole(x), bytes);
      if (x.rows() > 0) cover(x.colwise().minCoeff(), x.colwise().maxCoeff());
    }
  }
  bytes += balls + planes;
}

std::string MotionPacker::description(const View& first, const Eigen::Vector3d& up) const {
  const Look look = film_.look != nullptr ? *film_.look : Look{};
  std::vector<std::size_t> vertices, triangles;
  for (const Mesh& mesh : meshes_) {
    vertices.push_back(mesh.vertices);
    triangles.push_back(mesh.triangles);
  }
  std::vector<std::string> colors;
  constexpr int stops = 16;
  for (int i = 0; i <= stops; ++i) colors.push_back(list(viridis(static_cast<double>(i) / stops)));
  std::vector<std::string> marks;
  for (const Tick& mark : scale_.marks(100)) marks.push_back(fmt::format("[{:.6g}, \"{}\"]", mark.value, mark.label));
  const Eigen::Matrix3d base = rotation_from_z(up).toRotationMatrix(), axes = first.axes() * base;
  constexpr double degrees = 180 / std::numbers::pi;
  return fmt::format(
      "{{\"frames\": {}, \"poster\": {}, \"fps\": {}, \"time\": {}, \"seconds\": {}, \"vertices\": [{}], "
      "\"triangles\": [{}], "
      "\"spheres\": {}, \"grounds\": {}, \"origin\": [{}], \"precision\": {}, \"lowest\": [{}], \"highest\": [{}], "
      "\"side\": {}, \"leastStrain\": {}, \"strainSteps\": {}, \"limit\": {}, \"scale\": [{}], \"marks\": [{}], "
      "\"cloth\": {}, \"sphere\": {}, \"body\": {}, \"ground\": {}, \"grid\": {}, \"base\": [[{:.6g}], [{:.6g}], "
      "[{:.6g}]], \"azimuth\": {:.6g}, \"elevation\": {:.6g}, \"lines\": {}, \"textured\": {}}}",
      frames_, poster_->index(), film_.fps, time_, film_.seconds_per_frame, fmt::join(vertices, ", "),
      fmt::join(triangles, ", "), spheres_, grounds_, fmt::join(origin_, ", "), precision_, fmt::join(lowest_, ", "),
      fmt::join(highest_, ", "), patch_.side, least_strain, strain_steps, scale_.limit(), fmt::join(colors, ", "),
      fmt::join(marks, ", "), list(look.color), list(look.sphere_color), list(look.body_color), list(look.ground_color),
      look.ground_grid, fmt::join(base.col(0), ", "), fmt::join(base.col(1), ", "), fmt::join(base.col(2), ", "),
      degrees * std::atan2(-axes(0, 0), axes(0, 1)), degrees * std::asin(std::clamp(axes(2, 2), -1.0, 1.0)),
      look.mesh_lines, !texture_.empty());
}

html::PlayedMotion MotionPacker::finish(const View& first, const Eigen::Vector3d& up) {
  return {.description = description(first, up),
          .data = compressor_->finish(),
          .texture = texture_,
          .frames = frames_,
          .precision = precision_,
          .size = (highest_ - lowest_).norm(),
          .vertices = meshes_.front().vertices,
          .triangles = meshes_.front().triangles};
}

HtmlWriter::HtmlWriter(const std::filesystem::path& file, const FilmInfo& film)
    : film_(film), file_(file), packer_(film), samples_(film.expected_frames, film.triangles().size()) {}

void HtmlWriter::add(const Frame& frame) {
  try {
    packer_.add(frame);
    samples_.add(frame);
  } catch (const OutputError& error) {
    throw OutputError(fmt::format("{}: {}", file_.file().string(), error.what()));
  }
}

View HtmlWriter::first_view(const Camera& camera) const {
  const std::vector<Frame>& frames = samples_.frames();
  const Look usual;
  return camera_path(camera, {.aspect = static_cast<double>(film_.width) / (film_.height - film_.bands),
                              .fps = film_.fps,
                              .count = static_cast<int>(frames.size()),
                              .triangles = film_.triangles(),
                              .start = frames.front().positions,
                              .look = film_.look != nullptr ? *film_.look : usual,
                              .pass = [&](const auto& visit) { std::ranges::for_each(frames, visit); }})
      .at(0);
}

std::vector<OutputFile> HtmlWriter::finish(Ending ending) {
  if (packer_.frames() == 0) return {};
  const Camera usual{.azimuth = Camera::usual_azimuth, .elevation = Camera::usual_elevation};
  const Camera& camera = film_.camera != nullptr ? *film_.camera : usual;
  const html::PlayedMotion motion = packer_.finish(first_view(camera), camera.up);
  html::Page page{.title = film_.scene,
                  .kind = "drape",
                  .heading = film_.scene,
                  .introduction = {},
                  .content = html::motion_player("motion", motion, "The cloth of " + film_.scene),
                  .foot = {{"Motion", describe(motion)}}};
  file_.write(html::render(page));
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size, fmt::format("right to {:.2g} mm", 1000 * motion.precision / 2)}};
}

OutputFormat html_format() {
  return {.extension = ".html",
          .help = "the motion as a page for any browser: turn, play, colour by stretch; needs no network",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<HtmlWriter>(file, film);
          })};
}

}  // namespace drape
