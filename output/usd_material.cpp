#include "output/usd_material.hpp"

#include <fmt/format.h>

#include <system_error>

#include "render/color.hpp"

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

}  // namespace drape
