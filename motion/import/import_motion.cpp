#include "motion/import/import_motion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/tracks.hpp"
#include "motion/import/motion_source.hpp"
#include "motion/reader.hpp"
#include "motion/writer.hpp"
#include "scene/mesh/source.hpp"
#include "sim/system.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 5> mesh_endings{".obj", ".ply", ".vtp", ".vtu", ".vtk"};
constexpr std::array<std::string_view, 5> film_endings{".npz", ".pc2", ".pvd", ".usda", ".usd"};

/// A motion converted to other coordinates.
class TransformedMotion final : public MotionSource {
 public:
  TransformedMotion(std::shared_ptr<MotionSource> source, const ImportAxes& axes)
      : source_(std::move(source)), axes_(axes) {
    mesh_ = source_->mesh();
    turn(mesh_.positions, axes_.scale);
  }

  [[nodiscard]] const std::string& name() const override { return source_->name(); }
  [[nodiscard]] std::vector<fs::path> files() const override { return source_->files(); }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return source_->count(); }
  [[nodiscard]] std::vector<double> times() override { return source_->times(); }
  [[nodiscard]] std::optional<double> fps() override { return source_->fps(); }
  [[nodiscard]] std::optional<Vertices> rest() override {
    std::optional<Vertices> x = source_->rest();
    if (x) turn(*x, axes_.scale);
    return x;
  }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    ImportedMoment moment = source_->moment(i);
    turn(moment.x, axes_.scale);
    turn(moment.v, axes_.scale);
    return moment;
  }
  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders found = source_->colliders();
    for (auto* const shapes : {&found.spheres, &found.grounds}) {
      for (auto& row : shapes->by_moment) {
        for (Eigen::Vector4d& four : row) {
          Vertices place = four.head<3>().transpose();
          turn(place, shapes == &found.spheres ? axes_.scale : 1);
          four.head<3>() = place.transpose();
          four[3] *= axes_.scale;
        }
      }
    }
    for (auto& body : found.bodies) body = std::make_shared<TransformedMotion>(body, axes_);
    return found;
  }

 private:
  void turn(Vertices& x, double scale) const {
    if (axes_.y_up) {
      x.col(1).swap(x.col(2));
      x.col(1) *= -1;
    }
    if (scale != 1) x *= scale;
  }

  std::shared_ptr<MotionSource> source_;
  ImportAxes axes_;
  Mesh mesh_;
};

Vertices stacked(const Vertices& above, const Vertices& below) {
  Vertices all(above.rows() + below.rows(), 3);
  all << above, below;
  return all;
}

/// Two motions with their meshes joined into one.
class JoinedMotion final : public MotionSource {
 public:
  JoinedMotion(std::unique_ptr<MotionSource> first, std::unique_ptr<MotionSource> second)
      : first_(std::move(first)), second_(std::move(second)) {
    if (first_->count() != second_->count()) {
      fail_import(second_->name(),
                  fmt::format("it has {} frames, and {} has {}: cloths that are imported together need "
                              "as many",
                              second_->count(), first_->name(), first_->count()));
    }
    const Mesh &a = first_->mesh(), &b = second_->mesh();
    mesh_.positions = stacked(a.positions, b.positions);
    mesh_.triangles = a.triangles;
    const int shift = static_cast<int>(a.positions.rows());
    for (const Triangle& t : b.triangles) mesh_.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    if (a.uvs.empty() && b.uvs.empty()) return;
    mesh_.uvs = a.uvs;
    mesh_.uvs.resize(3 * a.triangles.size());
    mesh_.uvs.insert(mesh_.uvs.end(), b.uvs.begin(), b.uvs.end());
    mesh_.uvs.resize(3 * mesh_.triangles.size());
  }

  [[nodiscard]] const std::string& name() const override { return first_->name(); }
  [[nodiscard]] std::vector<fs::path> files() const override {
    std::vector<fs::path> all = first_->files();
    std::ranges::move(second_->files(), std::back_inserter(all));
    return all;
  }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return first_->count(); }
  [[nodiscard]] std::vector<double> times() override { return first_->times(); }
  [[nodiscard]] std::optional<double> fps() override { return first_->fps(); }
  [[nodiscard]] std::optional<Vertices> rest() override {
    const std::optional<Vertices> a = first_->rest(), b = second_->rest();
    if (!a && !b) return std::nullopt;
    return stacked(a.value_or(first_->mesh().positions), b.value_or(second_->mesh().positions));
  }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    const ImportedMoment a = first_->moment(i), b = second_->moment(i);
    ImportedMoment moment{.x = stacked(a.x, b.x)};
    if (a.v.rows() > 0 && b.v.rows() > 0) moment.v = stacked(a.v, b.v);
    return moment;
  }
  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders all = first_->colliders();
    const ImportedColliders more = second_->colliders();
    all.bodies.insert(all.bodies.end(), more.bodies.begin(), more.bodies.end());
    if (all.spheres.by_moment.empty()) all.spheres = more.spheres;
    if (all.grounds.by_moment.empty()) all.grounds = more.grounds;
    return all;
  }

 private:
  std::unique_ptr<MotionSource> first_, second_;
  Mesh mesh_;
};

}  // namespace

bool is_importable(const fs::path& file) {
  const std::string ending = lower_ending(file);
  return std::ranges::find(mesh_endings, ending) != mesh_endings.end() ||
         std::ranges::find(film_endings, ending) != film_endings.end();
}

std::unique_ptr<MotionSource> open_motion_source(const fs::path& file, const fs::path& mesh, const std::string& prim) {
  const std::string ending = lower_ending(file);
  if (!mesh.empty() && ending != ".pc2") fail_import(file.string(), "only a .pc2 needs a mesh of its own: omit --mesh");
  const bool usd = ending == ".usda" || ending == ".usd";
  if (!prim.empty() && !usd) fail_import(file.string(), "only a USD file has prims: omit --prim");
  if (ending == ".npz") return open_npz(file);
  if (ending == ".pvd") return open_pvd(file);
  if (ending == ".pc2") return open_pc2(file, mesh);
  if (usd) return open_usd(file, prim);
  if (std::ranges::find(mesh_endings, ending) != mesh_endings.end()) return open_mesh_sequence(file);
  std::vector<std::string> known(film_endings.begin(), film_endings.end());
  known.insert(known.end(), mesh_endings.begin(), mesh_endings.end());
  fail_import(file.string(), "expected a motion: " + fmt::format("{}", fmt::join(known, ", ")));
}

std::unique_ptr<MotionSource> with_axes(std::unique_ptr<MotionSource> source, const ImportAxes& axes) {
  if (!axes.y_up && axes.scale == 1) return source;
  return std::make_unique<TransformedMotion>(std::move(source), axes);
}

std::unique_ptr<MotionSource> joined(std::vector<std::unique_ptr<MotionSource>> sources) {
  std::unique_ptr<MotionSource> all = std::move(sources.front());
  for (std::size_t i = 1; i < sources.size(); ++i)
    all = std::make_unique<JoinedMotion>(std::move(all), std::move(sources[i]));
  return all;
}

namespace fs = std::filesystem;
namespace {

/// Formats an OBJ with numbers that can be read back exactly.
std::string exact_obj(const Mesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const auto& x : mesh.positions.rowwise()) fmt::format_to(out, "v {} {} {}\n", x[0], x[1], x[2]);
  for (const auto& uv : mesh.uvs) fmt::format_to(out, "vt {} {}\n", uv[0], uv[1]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += 'f';
    for (std::size_t c = 0; c < 3; ++c) {
      fmt::format_to(out, " {}", mesh.triangles[t][c] + 1);
      if (!mesh.uvs.empty()) fmt::format_to(out, "/{}", 3 * t + c + 1);
    }
    text += '\n';
  }
  return text;
}

/// A USD file of a moving sphere, from samples of its radius and its centre.
constexpr const char* moving_sphere = R"(#usda 1.0
(
    metersPerUnit = 1
    startTimeCode = 0
    timeCodesPerSecond = 1
    upAxis = "Z"
)

def Sphere "Sphere"
{{
    double radius.timeSamples = {{
{}    }}
    double3 xformOp:translate.timeSamples = {{
{}    }}
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
)";

/// Writer of the scene that an imported motion needs for drawing.
class ImportedScene {
 public:
  ImportedScene(const fs::path& folder, const TimeGrid& grid) : folder_(folder), grid_(grid) {}

  void add_cloth(MotionSource& cloth) {
    write_file_atomically(folder_ / "cloth.obj", exact_obj(cloth.mesh()));
    text_ += "[cloth]\nmesh = { file = \"cloth.obj\", up = \"z\" }\n";  // without a hint about the axis
    if (const std::optional<Vertices> rest = cloth.rest()) {
      write_file_atomically(folder_ / "rest.obj", exact_obj({.positions = *rest, .triangles = cloth.mesh().triangles}));
      text_ += "rest = \"rest.obj\"\n";
    }
    text_ += fmt::format(
        "stiffness = 1\n\n[integrator]\nmethod = \"quasi-newton\"\nallow_unstable = true\n\n[time]\nstep = "
        "{}\nduration = {}\n\n[video]\nfps = "
        "{}\n"
        "speed = {}\n",
        grid_.step, static_cast<double>(grid_.steps.back()) * grid_.step, grid_.fps, grid_.speed);
  }

  void add(const ImportedColliders& colliders) {
    const auto& grounds = colliders.grounds.by_moment;
    for (std::size_t k = 0; !grounds.empty() && k < grounds.front().size(); ++k) {
      const Eigen::Vector4d& g = grounds.front()[k];
      text_ +=
          fmt::format("\n[[effects.ground]]\nnormal = [{}, {}, {}]\nheight = {}\nthickness = 0\nallow_overlap = true\n",
                      g[0], g[1], g[2], g[3]);
    }
    const auto& spheres = colliders.spheres.by_moment;
    for (std::size_t k = 0; !spheres.empty() && k < spheres.front().size(); ++k) add_sphere(spheres, k);
    for (const auto& body : colliders.bodies) add_body(*body);
  }

  /// Adds a body that moves with the frames of the cloth, or rests.
  void add_body(MotionSource& body) {
    if (body.count() != 1 && body.count() != grid_.steps.size()) {
      fail_import(body.name(), fmt::format("it has {} frames; a body has one, or as many as the cloth, {}",
                                           body.count(), grid_.steps.size()));
    }
    ++bodies_;
    std::ranges::move(body.files(), std::back_inserter(body_files_));
    Mesh mesh{.positions = body.moment(0).x, .triangles = body.mesh().triangles};
    const std::string name = fmt::format("body{}", bodies_), first = exact_obj(mesh);
    bool moves = false;
    write_file_atomically(folder_ / (name + "-000000.obj"), first);
    for (std::size_t i = 1; i < body.count(); ++i) {
      mesh.positions = body.moment(i).x;
      const std::string text = exact_obj(mesh);
      moves = moves || text != first;
      write_file_atomically(folder_ / fmt::format("{}-{:06}.obj", name, i), text);
    }
    if (moves && grid_.steps.back() != static_cast<std::int64_t>(grid_.steps.size()) - 1) {
      fail_import(body.name(), "a body that moves needs frames that are evenly spaced: give --fps");
    }
    const std::string file = moves ? fmt::format("{{ file = \"{}-{{frame:06}}.obj\", fps = {} }}", name, 1 / grid_.step)
                                   : fmt::format("\"{}-000000.obj\"", name);
    text_ += fmt::format("\n[[effects.body]]\nfile = {}\nthickness = 1e-9\nallow_overlap = true\n", file);
  }

  [[nodiscard]] int bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<fs::path>& body_files() const { return body_files_; }
  [[nodiscard]] LoadedScene load() const {
    const fs::path file = folder_ / "imported.toml";
    write_file_atomically(file, text_);
    return load_scene(file);
  }

 private:
  /// Adds a sphere that rests, or whose centre and radius follow the frames of the cloth.
  void add_sphere(const std::vector<std::vector<Eigen::Vector4d>>& spheres, std::size_t k) {
    const Eigen::Vector4d& first = spheres.front()[k];
    text_ += "\n[[effects.sphere]]\nscale = 1\nstiffness = 0\n";
    if (std::ranges::all_of(spheres, [&](const auto& moment) { return moment.at(k) == first; })) {
      text_ += fmt::format("center = [{}, {}, {}]\nradius = {}\n", first[0], first[1], first[2], first[3]);
      return;
    }
    std::string centers, radii;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Eigen::Vector4d& s = spheres[i].at(k);
      const double time = static_cast<double>(grid_.steps[i]) * grid_.step;
      centers += fmt::format("        {}: ({}, {}, {}),\n", time, s[0], s[1], s[2]);
      radii += fmt::format("        {}: {},\n", time, s[3]);
    }
    const std::string name = fmt::format("sphere{}.usda", k + 1);
    write_file_atomically(folder_ / name, fmt::format(moving_sphere, radii, centers));
    text_ += fmt::format("track = \"{}\"\n", name);
  }

  const fs::path& folder_;
  const TimeGrid& grid_;
  std::string text_;
  int bodies_ = 0;
  std::vector<fs::path> body_files_;
};

/// Iterator over a motion's moments with velocities: those of its files, or central differences.
class VelocityEstimator {
 public:
  VelocityEstimator(MotionSource& source, const TimeGrid& grid) : source_(source), grid_(grid) {
    after_ = source.moment(0);
  }

  /// Returns the next moment.
  ImportedMoment next() {
    before_ = std::move(now_.x);
    now_ = std::move(after_);
    const bool last = ++index_ == source_.count();
    if (!last) after_ = source_.moment(index_);
    ImportedMoment moment = now_;
    if (moment.v.rows() == moment.x.rows()) return moment;
    const std::size_t i = index_ - 1, from = i == 0 ? 0 : i - 1, to = last ? i : i + 1;
    const auto steps = static_cast<double>(grid_.steps[to] - grid_.steps[from]);
    if (steps == 0) {
      moment.v = Vertices::Zero(moment.x.rows(), 3);
    } else {
      moment.v = ((last ? now_.x : after_.x) - (i == 0 ? now_.x : before_)) / (steps * grid_.step);
    }
    return moment;
  }

 private:
  MotionSource& source_;
  const TimeGrid& grid_;
  Vertices before_;
  ImportedMoment now_, after_;
  std::size_t index_ = 0;  // of after_
};

std::uint64_t write(const fs::path& file, const LoadedScene& scene, MotionSource& cloth, const TimeGrid& grid,
                    const std::stop_token& stop, Progress& progress) {
  const System system = make_system(scene.simulation);
  const std::int64_t last = grid.steps.back();
  const bool whole = last + 1 == static_cast<std::int64_t>(grid.steps.size());
  MotionHeader header;
  header.steps = last;
  header.recorded.every = whole ? std::optional<std::int64_t>(1) : std::nullopt;
  header.colliders = collider_kinds(system.colliders_at(0));
  header.imported = true;
  VelocityEstimator moments(cloth, grid);
  std::optional<ImportedMoment> first = moments.next();
  header.energies = first->energies.has_value();
  MotionFileWriter writer(file, header, scene);
  try {
    std::int64_t step = 0;
    for (const std::int64_t own : grid.steps) {
      if (stop.stop_requested()) throw Interrupted();
      ImportedMoment moment = first ? *std::exchange(first, std::nullopt) : moments.next();
      for (; step <= own; ++step) {
        StepRow row;
        row.step = step;
        row.energies = moment.energies.value_or(Energies{});
        row.colliders = system.colliders_at(static_cast<double>(step) * grid.step);
        writer.add(row);
      }
      writer.add(State{.x = std::move(moment.x), .v = std::move(moment.v), .step = own});
      ++progress.done;
    }
    return writer.finish();
  } catch (...) {
    writer.discard();
    throw;
  }
}

/// Checks that cloths that are imported together have the same times, where their files have any.
void require_same_times(const std::vector<std::unique_ptr<MotionSource>>& cloths) {
  const std::vector<double> times = cloths.front()->times();
  constexpr double rounding = 0.02;  // of a step, as in make_time_grid()
  for (std::size_t k = 1; k < cloths.size(); ++k) {
    const std::vector<double> others = cloths[k]->times();
    if (times.size() < 2 || others.size() != times.size()) continue;  // unknown, or reported by joined()
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double step = i == 0 ? times[1] - times[0] : times[i] - times[i - 1];
      if (std::abs(others[i] - times[i]) <= rounding * std::abs(step)) continue;
      fail_import(cloths[k]->name(),
                  fmt::format("its frame {} is at {} s, and that of {} at {} s: cloths that are imported together need "
                              "the same times; --fps takes their frames as evenly spaced",
                              i, others[i], cloths.front()->name(), times[i]));
    }
  }
}

/// A body at the times of a cloth: linear between its own samples, at rest before and after them.
class SampledBody final : public MotionSource {
 public:
  SampledBody(std::shared_ptr<MotionSource> body, std::vector<double> times)
      : body_(std::move(body)), own_times_(body_->times()), times_(std::move(times)) {
    before_ = after_ = body_->moment(0).x;
  }

  [[nodiscard]] const std::string& name() const override { return body_->name(); }
  [[nodiscard]] const Mesh& mesh() const override { return body_->mesh(); }
  [[nodiscard]] std::size_t count() const override { return times_.size(); }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    const Between at = between(own_times_, times_[i]);
    for (; read_ < at.after; after_ = body_->moment(++read_).x) before_ = after_;
    if (at.before == at.after) return {.x = after_};
    return {.x = before_ + at.share * (after_ - before_)};
  }

 private:
  std::shared_ptr<MotionSource> body_;
  std::vector<double> own_times_, times_;
  std::size_t read_ = 0;  // number of after_
  Vertices before_, after_;
};

/// Returns a body with a frame for each time of the cloth, if both have times that differ.
/// @param times of the cloth [s]; empty: unknown, or its frames are evenly spaced
std::shared_ptr<MotionSource> at_times(std::shared_ptr<MotionSource> body, const std::vector<double>& times) {
  if (times.size() < 2 || body->count() < 2) return body;
  const std::vector<double> own = body->times();
  const bool increasing = std::ranges::adjacent_find(own, std::greater_equal<>()) == own.end();
  if (own.size() < 2 || own == times || !increasing) return body;
  return std::make_shared<SampledBody>(std::move(body), times);
}

bool says_its_unit(const std::string& file) {
  const std::string ending = lower_ending(file);
  return ending == ".usda" || ending == ".usd";
}

/// Opens a motion or a body, converted to metres with z up.
std::unique_ptr<MotionSource> open_upright(const std::string& file, const std::string& mesh, const std::string& prim,
                                           const ImportAxes& axes) {
  if (axes.y_up && says_its_unit(file)) {
    fail_import(file, "a USD file says itself which axis is up: omit --up");
  }
  return with_axes(open_motion_source(file, mesh, prim), axes);
}

/// Loads the scene; problems name the cloth's file.
LoadedScene load_scene_of(const ImportedScene& text, const MotionSource& cloth, const fs::path& folder) {
  try {
    return text.load();
  } catch (const UsageError& error) {
    std::string message = error.what();
    const std::string before = folder.string() + "/";
    for (std::size_t at = 0; (at = message.find(before, at)) != std::string::npos;) message.erase(at, before.size());
    fail_import(cloth.name(), "it cannot be drawn: " + message.substr(0, message.find('\n')));
  }
}

}  // namespace

ImportedMotion import_motion(const ImportOptions& options, const fs::path& file, const std::stop_token& stop,
                             Progress& progress) {
  std::vector<std::unique_ptr<MotionSource>> parts;
  for (const std::string& cloth : options.cloths) {
    parts.push_back(open_upright(cloth, options.mesh, options.prim, options.axes));
  }
  if (!options.fps) require_same_times(parts);
  const std::unique_ptr<MotionSource> cloth = joined(std::move(parts));
  if (cloth->mesh().triangles.empty()) fail_import(cloth->name(), "there is no face in it");
  const TimeGrid grid = make_time_grid(cloth->name(), cloth->count(), cloth->times(), options.fps, cloth->fps());
  const TemporaryFolder folder("drape-import");
  ImportedScene text(folder.path(), grid);
  text.add_cloth(*cloth);
  const std::vector<double> times = options.fps ? std::vector<double>() : cloth->times();
  ImportedColliders colliders = cloth->colliders();
  for (auto& body : colliders.bodies) body = at_times(std::move(body), times);
  text.add(colliders);
  for (const std::string& body : options.bodies) {
    ImportAxes axes = options.axes;
    if (says_its_unit(body)) axes.scale = 1;
    text.add_body(*at_times(open_upright(body, {}, {}, axes), times));
  }
  LoadedScene scene = load_scene_of(text, *cloth, folder.path());
  scene.name = file.stem().string();
  progress.begin("importing", "frames", static_cast<std::int64_t>(cloth->count()));
  ImportedMotion result{.frames = static_cast<std::int64_t>(cloth->count()),
                        .step = grid.step,
                        .vertices = static_cast<int>(cloth->mesh().positions.rows()),
                        .triangles = static_cast<int>(cloth->mesh().triangles.size()),
                        .bodies = text.bodies(),
                        .files = cloth->files()};
  result.files.insert(result.files.end(), text.body_files().begin(), text.body_files().end());
  result.size = write(file, scene, *cloth, grid, stop, progress);
  return result;
}

}  // namespace drape
