#pragma once

#include <filesystem>
#include <string>

#include "render/settings.hpp"

namespace drape {

/// Returns "(r, g, b)" in linear light, USD's colour format.
std::string usd_color(const Rgb& color);

/// Returns the cloth's Material, a purely diffuse UsdPreviewSurface in the look's colour or texture.
/// @param path  path of the prim: "/Scene/ClothMaterial"; indented for one level
/// @param file  output file: the texture's path is relative to it
std::string usd_material(const std::string& path, const Look& look, const std::filesystem::path& file);

}  // namespace drape
