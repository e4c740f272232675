#include "scene/mesh/source.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

namespace drape {
namespace {

/// Returns true for a continuation byte of UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Rejects binary USD with a hint to export it as ASCII.
void require_no_binary_usd(const std::filesystem::path& file, const std::string& bytes) {
  const auto fail = [&](const char* form) {
    throw UsageError(fmt::format("{}: this is a {}; export it as ASCII, with the ending .usda", shown(file), form));
  };
  if (bytes.starts_with("PXR-USDC")) fail("binary USD file (usdc)");
  if (bytes.starts_with("PK\x03\x04")) fail("packed USD file (usdz)");
}

}  // namespace

SourceText SourceText::read(const std::filesystem::path& file) {
  // A grid of four million cells, the largest allowed, takes about half a gigabyte as text.
  constexpr std::size_t most_bytes = 2'000'000'000;
  std::string bytes = read_file(file, most_bytes);
  require_no_binary_usd(file, bytes);
  return {file.string(), text_of(file, std::move(bytes))};
}

SourceText SourceText::open(const std::filesystem::path& file) {
  if (!FilePieces::possible(file)) return read(file);
  SourceText source(file.string(), {});
  source.file_ = std::make_shared<const FilePieces>(file);
  std::string first;
  source.file_->read(0, piece_bytes, first);
  require_no_binary_usd(file, first);
  source.begin_ = first.size() - text_of(file, first).size();
  return source;
}

std::string_view SourceText::piece(std::size_t offset, std::string& memory) const {
  if (file_ == nullptr) return std::string_view(text_).substr(std::min(offset, text_.size()));
  file_->read(begin_ + offset, piece_bytes, memory);
  if (memory.find('\0') != std::string::npos) text_of(name_, memory);  // throws
  return memory;
}

std::pair<std::size_t, std::size_t> SourceText::line_and_column(std::size_t offset) const {
  std::size_t line = 1, column = 1, at = 0;
  std::string memory;
  while (at < offset) {
    const std::string_view text = piece(at, memory).substr(0, offset - at);
    if (text.empty()) break;
    at += text.size();
    for (const char c : text) {
      if (c == '\n') {
        ++line;
        column = 1;
      } else if (!continues_character(c)) {
        ++column;
      }
    }
  }
  return {line, column};
}

std::size_t SourceText::line(std::size_t offset) const { return line_and_column(offset).first; }

void SourceText::fail(std::size_t offset, const std::string& message) const {
  const auto [line, column] = line_and_column(offset);
  throw UsageError(fmt::format("{}:{}:{}: {}", shown(name_), line, column, message));
}

void SourceText::fail(const std::string& message) const { throw UsageError(shown(name_) + ": " + message); }

std::string in_quotes(std::string_view piece) {
  constexpr std::size_t longest = 40;
  std::size_t cut = std::min({piece.find('\n'), longest, piece.size()});
  while (cut > 0 && cut < piece.size() && continues_character(piece[cut])) --cut;
  return '\'' + escape_controls(piece.substr(0, cut)) + (cut < piece.size() ? "…'" : "'");
}

namespace {

constexpr std::string_view frame_opening = "{frame";

[[noreturn]] void fail_sequence(const std::filesystem::path& file, const std::string& message) {
  throw UsageError(shown(file) + ": " + escape_controls(message));
}

/// A file name split around its number.
struct FrameName {
  std::string before, after;
  std::size_t width = 0;  // least digits of the number; 0: any, without leading zeros

  [[nodiscard]] std::string with(std::int64_t number) const {
    return before + fmt::format("{:0{}}", number, width) + after;
  }
};

/// Parses a name that contains {frame} or {frame:04}; returns nothing for other names.
std::optional<FrameName> frame_name(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::size_t begin = name.find(frame_opening), end = name.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  const std::string digits = name.substr(begin + frame_opening.size(), end - begin - frame_opening.size());
  const bool padded = digits.size() == 3 && digits.starts_with(":0") && digits[2] >= '1' && digits[2] <= '9';
  if (!digits.empty() && !padded) return std::nullopt;
  return FrameName{name.substr(0, begin), name.substr(end + 1),
                   padded ? static_cast<std::size_t>(digits[2] - '0') : std::size_t{0}};
}

/// Returns the number in a name; -1 if the name does not belong to the sequence.
std::int64_t number_of(const FrameName& of, const std::string& name) {
  if (name.size() <= of.before.size() + of.after.size()) return -1;
  const std::string digits = name.substr(of.before.size(), name.size() - of.before.size() - of.after.size());
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = error == std::errc{} && end == digits.data() + digits.size() && number >= 0;
  return whole && of.with(number) == name ? number : -1;
}

}  // namespace

bool names_frames(const std::filesystem::path& file) {
  return file.filename().string().find(frame_opening) != std::string::npos;
}

bool is_frame(const std::filesystem::path& file, const std::filesystem::path& named) {
  const std::optional<FrameName> of = frame_name(named);
  return of && file.parent_path() == named.parent_path() && number_of(*of, file.filename().string()) >= 0;
}

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& file) {
  const std::optional<FrameName> name = frame_name(file);
  if (!name) fail_sequence(file, "expected {frame} or {frame:04} in the name");
  const FrameName& of = *name;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::map<std::int64_t, std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::int64_t number = number_of(of, entry->path().filename().string());
    if (number >= 0) found.emplace(number, file.parent_path() / entry->path().filename());
  }
  if (error) fail_sequence(folder, "the folder cannot be read: " + error.message());
  if (found.empty()) fail_sequence(file, fmt::format("there is no such file; the first could be {}", of.with(1)));
  std::vector<std::filesystem::path> files;
  for (const auto& [number, path] : found) {
    const std::int64_t expected = found.begin()->first + static_cast<std::int64_t>(files.size());
    if (number != expected)
      fail_sequence(file, fmt::format("{} is missing before {}", of.with(expected), of.with(number)));
    files.push_back(path);
  }
  return files;
}

namespace {

/// A flat polygon, seen from its front.
class Outline {
 public:
  explicit Outline(std::span<const Eigen::Vector3d> points) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Subtract one corner: far from the origin, products of the coordinates themselves cancel badly.
      const Eigen::Vector3d p = points[i] - points[0];
      const Eigen::Vector3d q = points[(i + 1) % points.size()] - points[0];
      normal += p.cross(q);
    }
    // Drop the normal's largest component: this projection does not flatten the polygon to a line.
    Eigen::Index drop = 2;
    normal.cwiseAbs().maxCoeff(&drop);
    const Eigen::Index u = (drop + 1) % 3, v = (drop + 2) % 3;
    const double side = normal[drop] < 0 ? -1 : 1;
    for (const Eigen::Vector3d& p : points) flat_.emplace_back(p[u] - points[0][u], side * (p[v] - points[0][v]));
  }

  /// Returns twice the signed area of the triangle of three corners: positive for a left turn at b.
  [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
    const Eigen::Vector2d p = flat_[b] - flat_[a], q = flat_[c] - flat_[a];
    return p.x() * q.y() - p.y() * q.x();
  }

  [[nodiscard]] bool convex() const {
    const std::size_t n = flat_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (area(i, (i + 1) % n, (i + 2) % n) < 0) return false;
    }
    return true;
  }

  /// Returns true if the triangle a, b, c can be cut off: it turns left and contains no other corner of `rest`.
  [[nodiscard]] bool is_ear(std::size_t a, std::size_t b, std::size_t c, const std::vector<std::size_t>& rest) const {
    if (area(a, b, c) <= 0) return false;
    for (const std::size_t other : rest) {
      if (other == a || other == b || other == c) continue;
      if (area(a, b, other) >= 0 && area(b, c, other) >= 0 && area(c, a, other) >= 0) return false;
    }
    return true;
  }

 private:
  std::vector<Eigen::Vector2d> flat_;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector3d> points) {
  std::vector<std::array<std::size_t, 3>> triangles;
  const Outline outline(points);
  if (points.size() == 3 || outline.convex()) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) triangles.push_back({0, i, i + 1});
    return triangles;
  }
  std::vector<std::size_t> rest(points.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  while (rest.size() > 3) {
    // If no ear exists (the outline crosses itself or is flat), cut any corner, so that every corner stays in use.
    std::size_t ear = 1;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const std::size_t before = rest[(i + rest.size() - 1) % rest.size()], after = rest[(i + 1) % rest.size()];
      if (outline.is_ear(before, rest[i], after, rest)) {
        ear = i;
        break;
      }
    }
    triangles.push_back({rest[(ear + rest.size() - 1) % rest.size()], rest[ear], rest[(ear + 1) % rest.size()]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

void MeshBuilder::add_triangle(const std::array<std::size_t, 3>& of, std::span<const int> corners,
                               std::span<const Uv> uvs) {
  triangles_.push_back({corners[of[0]], corners[of[1]], corners[of[2]]});
  if (uvs.empty()) return;
  uvs_.resize(3 * (triangles_.size() - 1), Uv{0, 0});
  for (const std::size_t corner : of) uvs_.push_back(uvs[corner]);
}

bool MeshBuilder::add_polygon(std::span<const int> corners, std::span<const Uv> uvs) {
  if (corners.size() == 3) {
    add_triangle({0, 1, 2}, corners, uvs);
    return true;
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(corners.size());
  for (const int corner : corners) points.push_back(positions_[static_cast<std::size_t>(corner)]);
  if (points.size() > most_concave_corners && !Outline(points).convex()) return false;
  for (const auto& triangle : triangulate(points)) add_triangle(triangle, corners, uvs);
  return true;
}

Mesh MeshBuilder::finish() {
  Mesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    mesh.positions.row(static_cast<Eigen::Index>(i)) = positions_[i].transpose();
  }
  if (!uvs_.empty()) uvs_.resize(3 * triangles_.size(), Uv{0, 0});
  mesh.triangles = std::move(triangles_);
  mesh.uvs = std::move(uvs_);
  return mesh;
}

}  // namespace drape
