#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "output/format.hpp"

namespace drape {

using AnySink = std::variant<std::unique_ptr<Encoder>, std::unique_ptr<MotionWriter>>;

/// The names of all files that a film goes to.
/// @param path as in make_sink()
/// @throws UsageError if the path has an unknown placeholder
std::vector<std::string> output_files(const std::string& path, const FilmInfo& film);

/// Makes what writes a film, and the folders it needs. What can fail because of the path fails here, before the first
/// frame is drawn.
/// @param path where to, and by the extension in which form, see output_formats(). {scene} stands for the scene's name;
///             {frame:04} for a frame's number, where 04 pads with zeros to 4 digits and {frame} alone pads so that
///             names sort; "{{" and "}}" for a brace. Files of an earlier, longer sequence stay.
/// @throws UsageError  if the path has an unknown extension or placeholder, or fps is out of the format's range
/// @throws OutputError if the folder cannot be written to, or there is no codec
AnySink make_sink(const std::string& path, const FilmInfo& film);

/// Makes what writes a film to one file, whose name is taken as it is.
/// @throws as above
AnySink make_sink(const OutputFormat& format, const std::filesystem::path& file, const FilmInfo& film);

}  // namespace drape
