#include "import/sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/nearest.hpp"
#include "import/mesh_sequence.hpp"
#include "scene/mesh/sequence.hpp"

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

}  // namespace drape
