#pragma once

#include <filesystem>
#include <string>

#include "render/settings.hpp"

namespace drape {

/// "(r, g, b)" in linear light, as USD has colours.
std::string usd_color(const Rgb& color);

/// The cloth's Material, a UsdPreviewSurface: one that is all scattered light, of the look's colour or its texture.
/// @param path  of the prim: "/Scene/ClothMaterial"; it is written one level deep
/// @param file  that it is written to: the texture's path is as seen from there
std::string usd_material(const std::string& path, const Look& look, const std::filesystem::path& file);

}  // namespace drape
