#include "run/poster.hpp"

#include "output/make_sink.hpp"
#include "output/registry.hpp"

namespace drape {

void Poster::see(const Frame& frame, const Image& image) {
  if (!frames_.see(frame.positions)) return;
  image_ = image;
  frame_ = frame.index;
}

std::vector<std::string> poster_files(const std::vector<std::string>& outputs, const FilmInfo& film) {
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    const OutputFormat* format = find_format(output);
    if (format == nullptr || !format->drawn() || format->file_per_frame()) continue;
    const std::filesystem::path file = output_files(output, film).front();
    files.push_back((file.parent_path() / file.stem()).string() + ".poster.png");
  }
  return files;
}

}  // namespace drape
