#pragma once

#include <filesystem>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Possible entries of OutputFormat::beside.
inline constexpr const char* first_mesh = ".obj";
inline constexpr const char* cloth_frames = "/{frame}.vtp";
inline constexpr const char* collider_frames = "/colliders-{frame}.vtp";

/// Returns the default number of digits of a frame's number: those of the film's last frame, so that files sort by
/// name.
int frame_digits(const FilmInfo& film);

/// Returns the name of a companion file: replaces the extension of `file` by an entry of OutputFormat::beside.
std::string file_beside(const std::filesystem::path& file, const char* beside, const FilmInfo& film, int frame);

}  // namespace drape
