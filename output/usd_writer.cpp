#include "output/usd_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "drape/core/error.hpp"
#include "drape/core/rotation.hpp"
#include "drape/render/image.hpp"
#include "output/mesh_writers.hpp"

namespace drape {
namespace {

/// Quotes an asset path with signs that do not occur in it.
std::string asset(const std::filesystem::path& file) {
  const std::string name = file.generic_string();
  return name.find('@') == std::string::npos ? "@" + name + "@" : "@@@" + name + "@@@";
}

/// Returns a file's path relative to another file's folder; absolute if there is none.
std::filesystem::path seen_from(const std::filesystem::path& other, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::path way = std::filesystem::relative(file, std::filesystem::absolute(other).parent_path(), error);
  if (error || way.empty()) return std::filesystem::absolute(file);
  // A resolver would look for a name without a leading dot in its search path.
  return *way.begin() == ".." ? way : "." / way;
}

}  // namespace

std::string usd_color(const Rgb& color) {
  const Eigen::Vector3f linear = linear_color(color);
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", linear[0], linear[1], linear[2]);
}

std::string usd_material(const std::string& path, const Look& look, const std::filesystem::path& file) {
  const bool textured = !look.texture.empty();
  const std::string color =
      textured ? fmt::format(".connect = <{}/Texture.outputs:rgb>", path) : fmt::format(" = {}", usd_color(look.color));
  std::string text = fmt::format(R"(    def Material "{1}"
    {{
        token outputs:surface.connect = <{0}/Surface.outputs:surface>

        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor{2}
            float inputs:roughness = 1
            token outputs:surface
        }}
)",
                                 path, path.substr(path.rfind('/') + 1), color);
  if (textured) {
    text += fmt::format(R"(
        def Shader "Texture"
        {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = {1}
            token inputs:sourceColorSpace = "sRGB"
            token inputs:wrapS = "repeat"
            token inputs:wrapT = "repeat"
            float2 inputs:st.connect = <{0}/Coordinates.outputs:result>
            float3 outputs:rgb
        }}

        def Shader "Coordinates"
        {{
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }}
)",
                        path, asset(seen_from(file, look.texture)));
  }
  return text + "    }\n";
}

namespace {

/// Formats a point with the shortest numbers that are read back as the same single-precision values.
std::string point(const Eigen::RowVector3d& x) {
  const Eigen::RowVector3f p = x.cast<float>();
  require_single_precision(p);
  return fmt::format("({}, {}, {})", p[0], p[1], p[2]);
}

std::string point_list(const Vertices& points) {
  std::string text = "[";
  for (const auto& x : points.rowwise()) text += (text.size() > 1 ? ", " : "") + point(x);
  return text + "]";
}

/// Returns the lowest and the highest corner of the points' bounding box.
std::string box(const Vertices& points) {
  return fmt::format("[{}, {}]", point(points.colwise().minCoeff()), point(points.colwise().maxCoeff()));
}

/// Returns a row-major matrix that rotates z to the normal, then translates; for row vectors, as in USD.
std::string placing(const Eigen::Quaterniond& turn, const Eigen::Vector3d& place) {
  const Eigen::Matrix3d r = turn.toRotationMatrix().transpose();
  std::string text = "(";
  for (int i = 0; i < 3; ++i) text += fmt::format("({}, {}, {}, 0), ", r(i, 0), r(i, 1), r(i, 2));
  return text + fmt::format("({}, {}, {}, 1))", place.x(), place.y(), place.z());
}

/// Formats a list of `count` items; Count is any integer type.
template <class Count, class Text>
std::string list(Count count, Text text_of) {
  std::string text = "[";
  for (Count i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + text_of(i);
  return text + "]";
}

/// Returns the cloths' names as USD allows them: "table_cloth" for "table-cloth", or "table_cloth_2" if another has it.
std::vector<std::string> identifiers(const std::vector<ClothPiece>& pieces) {
  const auto allowed = [](const std::string& name) { return name.find('-') == std::string::npos; };
  std::set<std::string> taken;
  for (const ClothPiece& piece : pieces) {
    if (allowed(piece.name)) taken.insert(piece.name);
  }
  std::vector<std::string> names;
  for (const ClothPiece& piece : pieces) {
    std::string name = piece.name;
    if (!allowed(name)) {
      std::ranges::replace(name, '-', '_');
      const std::string first = name;
      for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", first, k);
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::string material_of(const std::string& cloth) { return "/Scene/Material_" + cloth; }

}  // namespace

void UsdSamples::add(int time_code, std::string value) {
  text_.append(fmt::format("            {}: {},\n", time_code, value));
  if (first_.empty()) {
    first_ = std::move(value);
  } else {
    moves_ = moves_ || value != first_;
  }
}

void UsdSamples::write(PartialFile& file, const std::string& indent, const std::string& declaration) {
  file.write(fmt::format("{}{} = {}\n", indent, declaration, first_));
  if (!moves_) return;
  file.write(fmt::format("{}{}.timeSamples = {{\n", indent, declaration));
  text_.copy_to(file);
  file.write(indent + "}\n");
}

namespace {

constexpr std::size_t most_bytes_of_copy = 1'000'000'000;

/// Checks that the copy of a texture replaces no other file.
void require_replaceable(const std::filesystem::path& copy, const std::filesystem::path& texture) {
  require_writable(copy);
  if (!std::filesystem::exists(copy) || read_file(copy, most_bytes_of_copy) == read_file(texture, most_bytes_of_copy)) {
    return;
  }
  throw UsageError(
      fmt::format("{} exists and is not the motion's texture, which is written there beside a .usda: "
                  "rename it, or give the .usda another name",
                  copy.string()));
}

/// Returns the names of the copies of a look's textures beside a file: film.texture.png, film.texture2.png.
std::map<std::filesystem::path, std::filesystem::path> texture_copies(const std::filesystem::path& file,
                                                                      const Look& look) {
  std::map<std::filesystem::path, std::filesystem::path> copies;
  const auto add = [&](const std::filesystem::path& texture) {
    if (texture.empty() || copies.contains(texture)) return;
    const std::string number = copies.empty() ? "" : std::to_string(copies.size() + 1);
    copies[texture] = file.parent_path() / (file.stem().string() + ".texture" + number + texture.extension().string());
  };
  add(look.texture);
  for (const ClothLook& cloth : look.cloths) add(cloth.texture);
  return copies;
}

}  // namespace

UsdWriter::UsdWriter(const std::filesystem::path& file, const FilmInfo& film)
    : film_(film),
      copies_(film.temporary_textures && film.look != nullptr ? texture_copies(file, *film.look) : decltype(copies_)()),
      file_(file),
      points_(file_, "its points"),
      extent_(file_, "its extents") {
  for (const auto& [texture, copy] : copies_) require_replaceable(copy, texture);
  if (film.cloth != nullptr) patch_ = ground_patch(film.cloth->positions);
}

void UsdWriter::add_first(const Frame& frame) {
  for (const Collider& collider : frame.colliders) {
    if (std::holds_alternative<SphereShape>(collider)) {
      balls_.push_back(std::make_unique<Ball>(
          Ball{UsdSamples(file_, "its spheres' places"), UsdSamples(file_, "its spheres' radii")}));
    } else if (const auto* ground = std::get_if<GroundShape>(&collider)) {
      grounds_.push_back(*ground);
    } else if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
      bodies_.push_back(std::make_unique<Body>(Body{mesh->triangles, UsdSamples(file_, "its bodies' points")}));
    }
  }
}

void UsdWriter::add(const Frame& frame) {
  if (count_++ == 0) add_first(frame);
  points_.add(frame.index, point_list(frame.positions));
  extent_.add(frame.index, box(frame.positions));
  std::size_t ball = 0, body = 0;
  for (const Collider& collider : frame.colliders) {
    if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
      bodies_.at(body++)->points.add(frame.index, point_list(mesh->positions));
    }
    const auto* sphere = std::get_if<SphereShape>(&collider);
    if (sphere == nullptr) continue;
    const Eigen::Vector3d& c = sphere->center;
    balls_.at(ball)->place.add(frame.index, fmt::format("({}, {}, {})", c.x(), c.y(), c.z()));
    balls_.at(ball++)->radius.add(frame.index, fmt::format("{}", sphere->radius));
  }
}

void UsdWriter::write_header() {
  file_.write(
      fmt::format("#usda 1.0\n(\n"
                  "    defaultPrim = \"Scene\"\n"
                  "    metersPerUnit = 1\n"
                  "    upAxis = \"Z\"\n"
                  "    timeCodesPerSecond = {}\n"
                  "    framesPerSecond = {}\n"
                  "    startTimeCode = {}\n"
                  "    endTimeCode = {}\n"
                  ")\n\n"
                  "def Xform \"Scene\"\n{{\n",
                  1 / film_.seconds_per_frame, film_.fps, film_.first_frame, film_.first_frame + count_ - 1));
}

void UsdWriter::write_faces(const std::vector<Triangle>& triangles) {
  const std::string indent(8, ' ');
  file_.write(indent + "uniform token subdivisionScheme = \"none\"\n" + indent +
              "uniform token orientation = \"rightHanded\"\n" + indent + "uniform bool doubleSided = 1\n");
  file_.write(indent + "int[] faceVertexCounts = " +
              list(triangles.size(), [](std::size_t) { return std::string("3"); }) + "\n");
  file_.write(indent + "int[] faceVertexIndices = " +
              list(triangles.size(), [&](std::size_t t) { return fmt::format("{}", fmt::join(triangles[t], ", ")); }) +
              "\n");
}

void UsdWriter::write_bodies(const std::string& color) {
  const std::string indent(8, ' ');
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    file_.write(fmt::format("\n    def Mesh \"Body{}\"\n    {{\n", i + 1));
    write_faces(*bodies_[i]->triangles);
    bodies_[i]->points.write(file_, indent, "point3f[] points");
    file_.write(indent + "color3f[] primvars:displayColor = [" + color + "]\n    }\n");
  }
}

void UsdWriter::write_cloth() {
  const std::vector<Triangle>& triangles = film_.triangles();
  const auto& uvs = film_.texture_coordinates();
  const std::string indent(8, ' ');
  file_.write("    def Mesh \"Cloth\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {\n");
  write_faces(triangles);
  points_.write(file_, indent, "point3f[] points");
  extent_.write(file_, indent, "float3[] extent");
  if (!uvs.empty()) {
    file_.write(indent + "texCoord2f[] primvars:st = " +
                list(uvs.size(), [&](std::size_t i) { return fmt::format("({}, {})", uvs[i][0], uvs[i][1]); }) +
                " (\n" + indent + "    interpolation = \"faceVarying\"\n" + indent + ")\n");
  }
  if (!several_looks()) {
    file_.write(indent + "rel material:binding = </Scene/ClothMaterial>\n    }\n\n");
    return;
  }
  const std::vector<std::string> names = identifiers(film_.cloth->pieces);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const ClothPiece& piece = film_.cloth->pieces[k];
    const std::string faces =
        list(piece.triangle_count, [&](int t) { return fmt::format("{}", piece.first_triangle + t); });
    file_.write(
        fmt::format("\n{0}def GeomSubset \"{1}\" (\n{0}    prepend apiSchemas = [\"MaterialBindingAPI\"]\n{0})\n{0}{{\n"
                    "{0}    uniform token elementType = \"face\"\n{0}    uniform token familyName = \"materialBind\"\n"
                    "{0}    int[] indices = {2}\n{0}    rel material:binding = <{3}>\n{0}}}\n",
                    indent, names[k], faces, material_of(names[k])));
  }
  file_.write("    }\n\n");
}

bool UsdWriter::several_looks() const {
  return film_.cloth != nullptr && film_.look != nullptr && film_.look->cloths.size() > 1 &&
         film_.look->cloths.size() == film_.cloth->pieces.size();
}

std::filesystem::path UsdWriter::lasting(const std::filesystem::path& texture) const {
  const auto copy = copies_.find(texture);
  return copy == copies_.end() ? texture : copy->second;
}

void UsdWriter::write_materials() {
  Look look = film_.look != nullptr ? *film_.look : Look{};
  look.texture = lasting(look.texture);
  if (!several_looks()) return file_.write(usd_material("/Scene/ClothMaterial", look, file_.file()));
  const std::vector<std::string> names = identifiers(film_.cloth->pieces);
  for (std::size_t k = 0; k < names.size(); ++k) {
    look.color = look.cloths[k].color;
    look.texture = lasting(look.cloths[k].texture);
    file_.write(usd_material(material_of(names[k]), look, file_.file()));
  }
}

void UsdWriter::write_colliders() {
  const Look look = film_.look != nullptr ? *film_.look : Look{};
  const std::string indent(8, ' ');
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    file_.write(fmt::format("\n    def Sphere \"Sphere{}\"\n    {{\n", i + 1));
    balls_[i]->radius.write(file_, indent, "double radius");
    balls_[i]->place.write(file_, indent, "double3 xformOp:translate");
    file_.write(indent + "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n" + indent +
                "color3f[] primvars:displayColor = [" + usd_color(look.sphere_color) + "]\n    }\n");
  }
  write_bodies(usd_color(look.body_color));
  for (std::size_t i = 0; i < grounds_.size(); ++i) {
    const GroundShape& ground = grounds_[i];
    const Vertices corners = ground_corners(ground, patch_);
    Eigen::Vector3d middle = corners.colwise().mean().transpose();
    middle +=
        (ground.height - ground.normal.dot(middle)) * ground.normal;  // lets a level ground be read back unchanged
    file_.write(fmt::format("\n    def Plane \"Ground{}\"\n    {{\n", i + 1));
    file_.write(fmt::format(
        "{0}uniform token axis = \"Z\"\n{0}double width = {1}\n{0}double length = {1}\n"
        "{0}matrix4d xformOp:transform = {2}\n"
        "{0}uniform token[] xformOpOrder = [\"xformOp:transform\"]\n"
        "{0}color3f[] primvars:displayColor = [{3}]\n    }}\n",
        indent, patch_.side, placing(rotation_from_z(ground.normal), middle), usd_color(look.ground_color)));
  }
}

std::vector<OutputFile> UsdWriter::finish(Ending ending) {
  if (count_ == 0) return {};
  for (const auto& [texture, copy] : copies_) {  // before they are named
    require_replaceable(copy, texture);
    write_file_atomically(copy, read_file(texture, most_bytes_of_copy));
  }
  write_header();
  write_cloth();
  write_materials();
  write_colliders();
  file_.write("}\n");
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat usda_format() {
  return {.extension = ".usda",
          .help = "the motion as ASCII USD [m, z up]: cloth, material, spheres, bodies and grounds",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<UsdWriter>(file, film);
          })};
}

}  // namespace drape
