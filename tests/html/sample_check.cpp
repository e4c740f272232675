#include "tests/html/sample_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "drape/render/renderer.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "output/png_encoder.hpp"

namespace drape::test {
namespace {

constexpr std::array<int, 2> size{320, 240};

/// Draws a homework scene every 20 steps.
class Camera {
 public:
  explicit Camera(const std::string& name)
      : scene_(load_scene(std::string(DRAPE_SOURCE_DIR) + "/scenes/homework/" + name + ".toml")),
        simulation_(scene_.simulation) {}

  Image next() {
    for (int i = 0; i < 20; ++i) simulation_.step();
    Renderer renderer(DRAPE_SOURCE_DIR, {size[0], size[1]}, View{{-3.2, 5.5, 1.6}, {0, 0, -0.6}, {0, 0, 1}, 30},
                      scene_.look, simulation_.cloth().vertex_count(), simulation_.cloth().triangles, scene_.uvs);
    Frame frame;
    frame.positions = simulation_.state().x;
    frame.colliders = simulation_.colliders(simulation_.time());
    return renderer.draw(frame);
  }

 private:
  Scene scene_;
  Simulation simulation_;
};

/// Compares by the absolute difference, a stand-in for the error map, which has its own tests.
FrameResult compared(int number, const Image& expected, const Image& actual) {
  FrameResult frame;
  frame.frame = number;
  frame.time = number / 25.0;
  frame.expected = encode_png(expected);
  if (expected == actual) return frame;
  Image difference(size[0], size[1]), map(size[0], size[1]);
  PictureDifference& d = frame.difference;
  for (int y = 0; y < size[1]; ++y) {
    for (int x = 0; x < size[0]; ++x) {
      int largest = 0;
      for (int c = 0; c < 3; ++c) {
        const int distance = std::abs(expected.at(x, y)[c] - actual.at(x, y)[c]);
        difference.at(x, y)[c] = static_cast<std::uint8_t>(std::min(255, 2 * distance));
        largest = std::max(largest, distance);
      }
      map.at(x, y)[0] = static_cast<std::uint8_t>(largest);
      map.at(x, y)[2] = static_cast<std::uint8_t>(largest / 2);
      d.pixels += largest > 0 ? 1 : 0;
      if (largest > d.largest_channel) {
        d.largest_channel = largest;
        d.worst_pixel = {x, y};
      }
    }
  }
  d.verdict = d.largest_channel > 3 ? PictureVerdict::changed : PictureVerdict::noise;
  d.fraction = static_cast<double>(d.pixels) / (size[0] * size[1]);
  d.max_flip = d.largest_channel / 300.0;
  d.mean_flip = d.max_flip * d.fraction;
  frame.actual = encode_png(actual);
  frame.amplified = encode_png(difference);
  frame.flip_map = encode_png(map);
  return frame;
}

/// Changes the picture: 0 not at all, 1 by a rounding, from 2 on by a growing square.
Image changed(Image image, int how) {
  for (int y = 100; y < 100 + 6 * how - 6; ++y) {
    for (int x = 140; x < 140 + 6 * how - 6; ++x) image.at(x, y)[2] = 200;
  }
  if (how == 1) image.at(30, 40)[0] = static_cast<std::uint8_t>(image.at(30, 40)[0] - 1);
  return image;
}

/// @param growth factor of a deviation per step, from 1e-16 m; 0: the same bits
WindowResult window(int index, double growth, double tolerance) {
  WindowResult w;
  w.first_step = std::int64_t{20} * index;
  w.last_step = w.first_step + 20;
  for (const int i : {10, 20}) {
    const Deviation here{w.first_step + i, 213, growth > 0 ? 1e-16 * std::pow(growth, i) : 0};
    w.deviations.push_back(here);
    if (here.distance > 0) w.largest = here;
    if (here.distance > tolerance && !w.first) w.first = here;
  }
  if (growth > 0) w.other_bits = w.first_step + 1;
  w.verdict = w.first ? MotionVerdict::changed : w.largest ? MotionVerdict::within_tolerance : MotionVerdict::same_bits;
  return w;
}

SceneResult scene(const std::string& name, SceneVerdict verdict, const std::vector<int>& changes, double growth) {
  SceneResult s;
  s.name = name;
  s.file = "scenes/homework/" + name + ".toml";
  s.golden = "scenes/homework/" + name + ".golden";
  s.verdict = verdict;
  s.size = size;
  s.seconds = 1.3;
  s.rerun_command = "drape check scenes/homework/" + name + ".toml";
  if (verdict == SceneVerdict::changed) s.candidate = "0123456789abcdef";
  s.accept_command =
      s.has_candidate() ? "drape accept out/check " + name : "drape bless scenes/homework/" + name + ".toml";
  s.settings.ignore = {{10, 10, 60, 30}};
  s.ignored = 60 * 30 / (320. * 240);
  if (verdict == SceneVerdict::missing) {
    s.findings = {{FindingKind::first_golden}};
    return s;
  }
  Camera camera(name);
  int number = 0;
  for (const int how : changes) {
    const Image image = camera.next();
    s.windows.frames.push_back(compared(number, image, changed(image, how)));
    s.windows.frames.back().why = number == 0 ? "the start" : "first contact with the sphere";
    if (how > 1) s.windows.frames.back().kind = "one place only: 6x6 pixels at column 140, row 100";
    s.windows.windows.push_back(window(number / 40, how > 1 ? growth : 0, s.settings.motion_tolerance));
    s.windows.picture = std::max(s.windows.picture, s.windows.frames.back().difference.verdict);
    s.windows.motion = std::max(s.windows.motion, s.windows.windows.back().verdict);
    if (how > 1 && !s.windows.first_bad_frame) s.windows.first_bad_frame = number;
    number += 40;
  }
  s.recorded_at = "2026-01-31T12:00:00Z";
  s.recorded_on = {
      "0.1.0", "GNU 12.2.0", "Linux 6.1.0 x86_64", "AMD EPYC", "sse2 avx2 fma", "avx2", "llvmpipe",
  };
  return s;
}

}  // namespace

CheckReport sample_check(bool failing) {
  CheckReport report;
  report.command = "drape check scenes/homework/*.toml --report out/check";
  report.date = "2026-02-01T09:30:00Z";
  report.seconds = 4.2;
  report.machine = {"0.1.0",
                    "GNU 12.2.0",
                    "Linux 6.1.0 x86_64",
                    "Intel(R) Xeon(R) <Platinum> & \"more\"",
                    "sse2 avx2 fma avx512f",
                    "avx512",
                    "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"};
  report.scenes.push_back(scene("4", SceneVerdict::passed, {0, 1}, 0));
  report.scenes.push_back(failing ? scene("new", SceneVerdict::missing, {}, 0)
                                  : scene("3", SceneVerdict::passed, {0, 0}, 0));
  report.scenes.push_back(failing ? scene("5", SceneVerdict::changed, {1, 2, 4, 0}, 6)
                                  : scene("5", SceneVerdict::passed, {0, 0, 1, 0}, 0));
  if (failing) {
    report.accept_command = "drape accept out/check";
    SceneResult& changed = report.scenes.back();
    changed.checked_on = changed.recorded_on;
    changed.checked_on.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    changed.film = {{Property::speed, {1}, {0.5}}};
    changed.findings = {{FindingKind::motion}, {FindingKind::pictures}, {FindingKind::film}, {FindingKind::elsewhere}};
  }
  return report;
}

}  // namespace drape::test
