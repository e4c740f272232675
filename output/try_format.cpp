#include "output/try_format.hpp"

#include <algorithm>

#include "output/make_sink.hpp"

namespace drape {
namespace {

void give_two_frames(Encoder& encoder) {
  Image image(64, 64);
  encoder.add(image);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{200});
  encoder.add(image);
}

void give_two_frames(MotionWriter& writer) {
  Frame frame;
  frame.positions = Vertices::Identity(3, 3);
  frame.velocities = Vertices::Zero(3, 3);
  frame.energies.emplace();
  writer.add(frame);
  frame.index = 1;
  writer.add(frame);
}

}  // namespace

std::string try_format(const OutputFormat& format, const std::filesystem::path& file) {
  if (format.of_steps()) return "by drape itself";
  Cloth cloth;
  cloth.positions = cloth.rest = Vertices::Identity(3, 3);
  cloth.velocities = Vertices::Zero(3, 3);
  cloth.triangles = {{0, 1, 2}};
  FilmInfo film;
  film.expected_frames = 2;
  film.cloth = &cloth;
  const AnySink any = make_sink(format, file, film);
  return std::visit(
      [&](const auto& sink) {
        give_two_frames(*sink);
        sink->finish();
        const std::string codec = sink->codec(), by = format.made_by.empty() ? "drape itself" : format.made_by;
        return codec.empty() ? "by " + by : codec + ", by " + by;
      },
      any);
}

}  // namespace drape
