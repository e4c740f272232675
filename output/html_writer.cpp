#include "output/html_writer.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "html/components.hpp"
#include "html/page.hpp"

namespace drape {

HtmlWriter::HtmlWriter(const std::filesystem::path& file, const FilmInfo& film)
    : scene_(film.scene), file_(file), packer_(film) {}

void HtmlWriter::add(const Frame& frame) {
  try {
    packer_.add(frame);
  } catch (const OutputError& error) {
    throw OutputError(fmt::format("{}: {}", file_.file().string(), error.what()));
  }
}

std::vector<OutputFile> HtmlWriter::finish(Ending ending) {
  if (packer_.frames() == 0) return {};
  const html::PlayedMotion motion = packer_.finish();
  html::Page page{.title = scene_,
                  .kind = "drape",
                  .heading = scene_,
                  .introduction = {},
                  .content = html::motion_player("motion", motion, "The cloth of " + scene_),
                  .foot = {{"Motion", describe(motion)}}};
  file_.write(html::render(page));
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size, fmt::format("right to {:.2g} mm", 1000 * motion.precision / 2)}};
}

OutputFormat html_format() {
  return {.extension = ".html",
          .help = "the motion as a page for any browser: turn, play, colour by stretch; needs no network",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Frame>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<HtmlWriter>(file, film);
          })};
}

}  // namespace drape
