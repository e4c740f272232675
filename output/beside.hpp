#pragma once

#include <filesystem>
#include <string>

#include "output/format.hpp"

namespace drape {

/// What OutputFormat::beside can hold.
inline constexpr const char* first_mesh = ".obj";
inline constexpr const char* cloth_frames = "/{frame}.vtp";
inline constexpr const char* collider_frames = "/colliders-{frame}.vtp";

/// How many digits a frame's number has where its place in a path does not say it: as many as the film's last frame, so
/// that files sort by name.
int frame_digits(const FilmInfo& film);

/// The name of a file that goes with another one: the extension of that replaced by an entry of OutputFormat::beside.
std::string file_beside(const std::filesystem::path& file, const char* beside, const FilmInfo& film, int frame);

}  // namespace drape
