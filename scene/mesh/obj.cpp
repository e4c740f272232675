#include "scene/mesh/source.hpp"

#include <fmt/format.h>
#include <tiny_obj_loader.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <istream>
#include <numeric>
#include <span>
#include <streambuf>
#include <vector>

#include "core/text.hpp"

namespace drape {
namespace {

/// A stream buffer over a text that counts the bytes read.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());  // a stream buffer asks for char*, but an input one never writes
    setg(begin, begin, begin + text.size());
  }
  [[nodiscard]] std::size_t read() const { return static_cast<std::size_t>(gptr() - eback()); }
};

/// A blank-separated word of a statement.
struct Word {
  std::size_t offset;
  std::string_view text;
};

/// Reader based on tinyobjloader, which splits the file into statements and faces into corners. It silently reads a
/// word as 0. So each statement is checked on its own line, and its coordinates are read there, correctly rounded.
class ObjReader {
 public:
  /// @param group group whose vertices are collected
  explicit ObjReader(const SourceText& source, std::string group = {})
      : source_(source), buffer_(source.text()), group_(std::move(group)) {}

  Mesh read() {
    reject_empty_statements();
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, auto...) { static_cast<ObjReader*>(self)->vertex(); };
    callbacks.texcoord_cb = [](void* self, auto...) { static_cast<ObjReader*>(self)->texture_coordinates(); };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      static_cast<ObjReader*>(self)->face({corners, static_cast<std::size_t>(count)});
    };
    callbacks.group_cb = [](void* self, const char** names, int count) {
      static_cast<ObjReader*>(self)->enter({names, names + count}, static_cast<ObjReader*>(self)->in_group_);
    };
    callbacks.object_cb = [](void* self, const char* name) { static_cast<ObjReader*>(self)->enter_object(name); };
    std::istream stream(&buffer_);
    tinyobj::LoadObjWithCallback(stream, callbacks, this);
    if (builder_.vertex_count() == 0) source_.fail("there is no vertex ('v x y z') in the file");
    add_faces();
    if (builder_.triangle_count() == 0) source_.fail("there is no face ('f 1 2 3') in the file");
    return builder_.finish();
  }

  /// Returns the vertices of the group after read().
  [[nodiscard]] std::vector<int> group_vertices() {
    if (std::ranges::find(groups_, group_) == groups_.end()) {
      source_.fail(fmt::format("there is no group or object {} in the file{}", in_quotes(group_),
                               did_you_mean(group_, groups_, "it has")));
    }
    std::ranges::sort(group_vertices_);
    group_vertices_.erase(std::unique(group_vertices_.begin(), group_vertices_.end()), group_vertices_.end());
    return std::move(group_vertices_);
  }

 private:
  struct Corner {
    int vertex, uv;  // from 0; uv is -1 if absent
    std::size_t offset;
  };

  /// Rejects a lone "v". tinyobjloader skips it as an unknown statement, which would renumber the vertices.
  void reject_empty_statements() const {
    const std::string_view text = source_.text();
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
      const std::string_view line = text.substr(begin, end - begin);
      const std::size_t name = std::min(line.find_first_not_of(" \t"), line.size());
      const std::string_view statement = line.substr(name, line.find_last_not_of(" \t") + 1 - name);
      if (statement == "v" || statement == "vt" || statement == "f") {
        source_.fail(begin + name, fmt::format("expected numbers after {}", in_quotes(statement)));
      }
      begin = end + 1;
    }
  }

  [[nodiscard]] std::vector<Word> split(std::size_t begin, std::size_t end) const {
    const std::string_view text = source_.text();
    std::vector<Word> words;
    while (true) {
      begin = text.find_first_not_of(" \t", begin);
      if (begin >= end || text[begin] == '#') return words;
      const std::size_t stop = std::min(text.find_first_of(" \t\r\n", begin), end);
      words.push_back({begin, text.substr(begin, stop - begin)});
      begin = stop;
    }
  }

  /// Returns the words of the statement that tinyobjloader has just read; the first is its name.
  [[nodiscard]] std::vector<Word> statement() const {
    const std::string_view text = source_.text();
    std::size_t end = buffer_.read();
    if (end > 0 && text[end - 1] == '\n') --end;
    if (end > 0 && text[end - 1] == '\r') --end;
    const std::size_t before = end == 0 ? std::string_view::npos : text.find_last_of("\r\n", end - 1);
    return split(before == std::string_view::npos ? 0 : before + 1, end);
  }

  /// Returns the finite numbers of a statement.
  std::vector<double> numbers(std::size_t at_least, const char* form) const {
    const std::vector<Word> words = statement();
    std::vector<double> result;
    for (const Word& word : std::span(words).subspan(1)) {
      const std::string_view digits =
          word.text.substr(word.text.starts_with('+') && !word.text.starts_with("+-") ? 1 : 0);
      double value = 0;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        source_.fail(word.offset, fmt::format("expected a finite number, found {}", in_quotes(word.text)));
      }
      result.push_back(value);
    }
    if (result.size() < at_least) {
      source_.fail(words[0].offset, fmt::format("expected '{}', found {} numbers", form, result.size()));
    }
    return result;
  }

  void vertex() {
    const std::vector<double> xyz = numbers(3, "v x y z");
    builder_.add_vertex({xyz[0], xyz[1], xyz[2]});
  }

  void texture_coordinates() {
    const std::vector<double> uv = numbers(1, "vt u v");
    uvs_.push_back({static_cast<float>(uv[0]), uv.size() > 1 ? static_cast<float>(uv[1]) : 0.0F});
  }

  void check_corner(const Word& word) const {
    std::string_view rest = word.text;
    bool valid = true;
    for (int part = 0; valid; ++part) {
      const std::string_view number = rest.substr(0, rest.find('/'));
      int value = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      const bool is_number = error == std::errc{} && end == number.data() + number.size();
      const bool left_out = number.empty() && part == 1 && number.size() < rest.size();  // 3//2
      valid = part < 3 && (is_number || left_out);
      if (number.size() == rest.size()) break;
      rest.remove_prefix(number.size() + 1);
    }
    if (!valid) {
      source_.fail(word.offset,
                   fmt::format("expected a corner such as 3, 3/1, 3/1/2 or 3//2, found {}", in_quotes(word.text)));
    }
  }

  void face(std::span<const tinyobj::index_t> found) {
    const std::vector<Word> words = statement();
    const std::span<const Word> corners = std::span(words).subspan(1);
    for (const Word& word : corners) check_corner(word);
    if (corners.size() < 3) {
      source_.fail(words[0].offset, fmt::format("a face needs at least 3 corners, found {}", corners.size()));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t offset = corners[i].offset;
      if (found[i].vertex_index == 0) source_.fail(offset, "vertices are numbered from 1, found 0");
      // A relative number counts back from the latest vertex; an absolute one may refer to a later line of the file.
      const bool has_uv = found[i].texcoord_index != 0;
      corners_.push_back({absolute(found[i].vertex_index, builder_.vertex_count(), "vertices", offset),
                          has_uv ? absolute(found[i].texcoord_index, uvs_.size(), "texture coordinates", offset) : -1,
                          offset});
      if (in_group_ || in_object_) group_vertices_.push_back(corners_.back().vertex);
    }
    faces_in_group_ = in_group_;
    face_sizes_.push_back(corners.size());
  }

  void enter(const std::vector<std::string>& names, bool& inside) {
    if (group_.empty()) return;
    groups_.insert(groups_.end(), names.begin(), names.end());
    inside = std::ranges::find(names, group_) != names.end();
  }

  /// An object ends the group before it, unless that has no faces yet: some programs write "g" before "o".
  void enter_object(const std::string& name) {
    if (faces_in_group_) in_group_ = faces_in_group_ = false;
    enter({name}, in_object_);
  }

  [[nodiscard]] int absolute(int number, std::size_t so_far, const char* what, std::size_t offset) const {
    if (number > 0) return number - 1;
    if (static_cast<std::size_t>(-static_cast<std::int64_t>(number)) > so_far) {
      source_.fail(offset, fmt::format("{} counts back beyond the first of the {} {} so far", number, so_far, what));
    }
    return static_cast<int>(so_far) + number;
  }

  void add_faces() {
    std::vector<int> vertices;
    std::vector<MeshBuilder::Uv> uvs;
    std::size_t first = 0;
    for (const std::size_t size : face_sizes_) {
      vertices.clear();
      uvs.clear();
      for (const Corner& corner : std::span(corners_).subspan(first, size)) {
        check_range(corner.vertex, builder_.vertex_count(), "vertices", corner.offset);
        vertices.push_back(corner.vertex);
        if (corner.uv < 0) continue;
        check_range(corner.uv, uvs_.size(), "texture coordinates", corner.offset);
        uvs.push_back(uvs_[static_cast<std::size_t>(corner.uv)]);
      }
      if (uvs.size() < size) uvs.clear();
      if (!builder_.add_polygon(vertices, uvs)) {
        source_.fail(corners_[first].offset,
                     fmt::format("a concave face of {} corners: triangulate it before exporting", size));
      }
      first += size;
    }
  }

  void check_range(int index, std::size_t count, const char* what, std::size_t offset) const {
    if (static_cast<std::size_t>(index) >= count) {
      source_.fail(offset, fmt::format("the face names number {}, but the file has {} {}", index + 1, count, what));
    }
  }

  const SourceText& source_;
  TextBuffer buffer_;
  MeshBuilder builder_;
  std::vector<MeshBuilder::Uv> uvs_;
  std::vector<Corner> corners_;
  std::vector<std::size_t> face_sizes_;
  std::string group_;
  bool in_group_ = false, in_object_ = false, faces_in_group_ = false;
  std::vector<std::string> groups_;
  std::vector<int> group_vertices_;
};

}  // namespace

Mesh read_obj_mesh(const SourceText& source) { return ObjReader(source).read(); }

std::vector<int> read_obj_group(const SourceText& source, const std::string& group) {
  ObjReader reader(source, group);
  reader.read();
  return reader.group_vertices();
}

namespace {

/// Extracts the faces of some vertices (ascending) as a separate mesh.
Mesh part_of(const Mesh& mesh, const std::vector<int>& vertices) {
  std::vector<int> numbers(static_cast<std::size_t>(mesh.positions.rows()), -1);
  Mesh part;
  part.positions.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    numbers[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
    part.positions.row(static_cast<Eigen::Index>(i)) = mesh.positions.row(vertices[i]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle = mesh.triangles[t];
    for (int& v : triangle) v = numbers[static_cast<std::size_t>(v)];
    if (*std::ranges::min_element(triangle) < 0) continue;
    part.triangles.push_back(triangle);
    if (mesh.uvs.empty()) continue;
    const auto first = mesh.uvs.begin() + static_cast<std::ptrdiff_t>(3 * t);
    part.uvs.insert(part.uvs.end(), first, first + 3);
  }
  return part;
}

}  // namespace

std::vector<ObjObject> read_drape_objects(const SourceText& source) {
  constexpr std::string_view object = "\no ", cloth = "\no cloth\n";
  const std::string_view text = source.text();
  if (!text.starts_with("# drape: frame") || text.find(cloth) == std::string_view::npos) return {};
  const Mesh all = read_obj_mesh(source);
  std::vector<int> of_cloth(static_cast<std::size_t>(all.positions.rows()));
  std::iota(of_cloth.begin(), of_cloth.end(), 0);
  std::vector<ObjObject> objects(1, {"cloth", {}});
  for (std::size_t at = text.find(object); at != std::string_view::npos; at = text.find(object, at + 1)) {
    const std::size_t begin = at + object.size();
    const std::string name(text.substr(begin, text.find('\n', begin) - begin));
    if (name == "cloth") continue;
    const std::vector<int> vertices = read_obj_group(source, name);
    std::vector<int> others;  // the cloth's vertices, including unused ones
    std::ranges::set_difference(of_cloth, vertices, std::back_inserter(others));
    of_cloth = std::move(others);
    objects.push_back({name, part_of(all, vertices)});
    objects.back().mesh.uvs.clear();
  }
  objects.front().mesh = part_of(all, of_cloth);
  return objects;
}

}  // namespace drape
