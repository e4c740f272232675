#include "check/check_scene.hpp"
#include "check/draw_windows.hpp"
#include "check/golden_folder.hpp"
#include "check/machine.hpp"
#include "check/record_motion.hpp"
#include "run/outputs.hpp"

namespace drape {

std::optional<Blessing> bless_scene(const Scene& scene, const CheckSettings& settings, GlBackend backend,
                                    const std::stop_token& stop, Progress& progress) {
  has_golden(golden_folder(scene.file));  // or it throws
  require_texture(scene);
  std::optional<Golden> golden = record_motion(scene, settings, plan_windows(scene, settings), stop, progress);
  if (!golden) return std::nullopt;
  DrawWindows drawing(scene, golden->size, golden->view, backend);
  const std::vector<Png> pictures = drawing.draw(golden->windows, stop, progress);
  if (stop.stop_requested()) return std::nullopt;
  golden->date = utc_now();
  golden->machine = this_machine(drawing.renderer());
  Blessing blessing{.folder = golden_folder(scene.file), .frames = static_cast<int>(pictures.size())};
  blessing.size = write_golden(blessing.folder, *golden, pictures);
  return blessing;
}

}  // namespace drape
