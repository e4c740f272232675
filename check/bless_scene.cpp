#include "check/check_scene.hpp"
#include "check/draw_frames.hpp"
#include "check/golden_folder.hpp"
#include "check/machine.hpp"
#include "check/played_motion.hpp"
#include "check/record_motion.hpp"
#include "check/step_time.hpp"
#include "run/outputs.hpp"

namespace drape {

std::optional<Recording> record_scene(const Scene& scene, const CheckSettings& settings, GlBackend backend,
                                      const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  if (recorded != nullptr) recorded->require_every_step(scene);
  const std::optional<RecordPlan> plan = plan_recording(scene, settings, stop, progress, recorded);
  if (!plan) return std::nullopt;
  std::optional<Golden> golden = record_motion(scene, settings, *plan, stop, progress, recorded);
  if (!golden) return std::nullopt;
  if (settings.time && scene.step_count() > 0 && recorded == nullptr) golden->time = measure_step_time(scene, 0, stop);
  DrawFrames drawing(scene, golden->size, backend);
  std::vector<Png> pictures = drawing.draw(golden->frames, stop, progress);
  if (stop.stop_requested()) return std::nullopt;
  golden->date = utc_now();
  golden->machine = this_machine(drawing.renderer());
  return Recording{std::move(*golden), std::move(pictures)};
}

std::optional<Blessing> bless_scene(const Scene& scene, const CheckSettings& settings, GlBackend backend,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  has_golden(golden_folder(scene.file));  // throws if another file is in its place
  require_texture(scene);
  const std::optional<Recording> recording = record_scene(scene, settings, backend, stop, progress, recorded);
  if (!recording) return std::nullopt;
  Blessing blessing{.folder = golden_folder(scene.file), .frames = static_cast<int>(recording->pictures.size())};
  blessing.size = write_golden(blessing.folder, recording->golden, recording->pictures);
  return blessing;
}

}  // namespace drape
