#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "output/format.hpp"

namespace drape {

using AnySink = std::variant<std::unique_ptr<Encoder>, std::unique_ptr<MotionWriter>>;

/// Returns the names of all files of a film.
/// @param path as in make_sink()
/// @throws UsageError if the path has an unknown placeholder
std::vector<std::string> output_files(const std::string& path, const FilmInfo& film);

/// Makes the sink of a film, and the folders it needs. Errors of the path are reported here, before the first frame is
/// drawn.
/// @param path destination; its extension selects the format, see output_formats(). Placeholders: {scene} is the
///             scene's name; {frame:04} a frame's number, padded with zeros to 4 digits; {frame} one padded so that
///             names sort; "{{" and "}}" a brace. Files of an earlier, longer sequence stay.
/// @throws UsageError  if the path has an unknown extension or placeholder, or fps is out of the format's range
/// @throws OutputError if the folder cannot be written to, or there is no codec
AnySink make_sink(const std::string& path, const FilmInfo& film);

/// Makes the sink of a film for one file, whose name is taken literally.
/// @throws the same errors
AnySink make_sink(const OutputFormat& format, const std::filesystem::path& file, const FilmInfo& film);

}  // namespace drape
