#include <fmt/format.h>

#include <algorithm>

#include "import/mesh_frame.hpp"
#include "import/npy.hpp"
#include "import/sources.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

void require_shape(const NpyStream& array, std::vector<std::size_t> expected, const char* text) {
  bool good = array.shape().size() == expected.size();
  for (std::size_t i = 0; good && i < expected.size(); ++i) good = expected[i] == 0 || expected[i] == array.shape()[i];
  if (!good) array.fail(fmt::format("expected the shape {}, found ({})", text, fmt::join(array.shape(), ", ")));
}

/// Positions and faces of a cloth or a body.
class NpzMotion final : public MotionSource {
 public:
  NpzMotion(std::shared_ptr<const ZipReader> zip, std::unique_ptr<NpyStream> positions,
            std::unique_ptr<NpyStream> faces)
      : zip_(std::move(zip)), name_(zip_->file().string()), positions_(std::move(positions)) {
    require_shape(*positions_, {0, 0, 3}, "(frames, vertices, 3)");
    count_ = positions_->rows();
    if (count_ == 0 || positions_->shape()[1] == 0) positions_->fail("it has no frames or no vertices");
    mesh_.positions = next();
    if (faces->shape().size() != 2) faces->fail("expected the shape (faces, corners)");
    const std::vector<double> corners = faces->rest();
    add_faces(faces->name(), std::vector<std::size_t>(faces->rows(), faces->row_size()), corners, mesh_);
  }

  /// Reads the archive's other arrays for a cloth.
  void read_more() {
    velocities_ = array_named(*zip_, {"velocities"});
    if (velocities_ && velocities_->shape() != positions_->shape()) velocities_ = nullptr;
    energies_ = array_named(*zip_, {"energies"});
    if (energies_ && (energies_->rows() != count_ || energies_->fields().size() != 4)) energies_ = nullptr;
    if (const auto uvs = array_named(*zip_, {"uvs"});
        uvs && uvs->rows() == mesh_.triangles.size() && uvs->row_size() == 6) {
      const std::vector<double> all = uvs->rest();
      for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
        mesh_.uvs.push_back({static_cast<float>(all[i]), static_cast<float>(all[i + 1])});
      }
    }
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return count_; }

  [[nodiscard]] std::vector<double> times() override {
    const auto array = array_named(*zip_, {"times", "time", "t"});
    if (!array) return {};
    require_shape(*array, {count_}, "(frames,)");
    return array->rest();
  }

  [[nodiscard]] std::optional<Vertices> rest() override {
    const auto array = array_named(*zip_, {"rest"});
    if (!array) return std::nullopt;
    require_shape(*array, {static_cast<std::size_t>(mesh_.positions.rows()), 3}, "(vertices, 3)");
    Vertices x = vertices_of(array->name(), array->rest());
    require_finite(array->name(), x);
    return x;
  }

  [[nodiscard]] std::optional<double> fps() override {
    const auto array = array_named(*zip_, {"fps"});
    if (!array || array->rows() < 1) return std::nullopt;
    return array->row().front();
  }

  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    ImportedMoment moment{.x = i == 0 ? mesh_.positions : next()};
    if (velocities_) moment.v = vertices_of(velocities_->name(), velocities_->row());
    if (energies_) {
      const std::vector<double> all = energies_->row();  // total, kinetic, gravity, elastic
      moment.energies = Energies{.kinetic = all[1], .gravity = all[2], .elastic = all[3]};
    }
    return moment;
  }

  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders found;
    for (const auto& [name, shapes] : {std::pair("spheres", &found.spheres), std::pair("grounds", &found.grounds)}) {
      const auto array = array_named(*zip_, {name});
      if (!array || array->shape().size() != 3 || array->shape()[1] == 0) continue;
      require_shape(*array, {count_, 0, 4}, "(frames, shapes, 4)");
      for (std::size_t i = 0; i < count_; ++i) {
        const std::vector<double> all = array->row();
        std::vector<Eigen::Vector4d> row;
        for (std::size_t k = 0; k + 4 <= all.size(); k += 4) row.emplace_back(&all[k]);
        shapes->by_moment.push_back(std::move(row));
      }
    }
    for (int k = 1;; ++k) {
      auto positions = array_named(*zip_, {fmt::format("body{}_positions", k)});
      auto faces = array_named(*zip_, {fmt::format("body{}_faces", k)});
      if (!positions || !faces) break;
      found.bodies.push_back(std::make_shared<NpzMotion>(zip_, std::move(positions), std::move(faces)));
    }
    return found;
  }

 private:
  Vertices next() {
    Vertices x = vertices_of(positions_->name(), positions_->row());
    require_finite(fmt::format("{}: frame {}", positions_->name(), read_++), x);
    return x;
  }

  std::shared_ptr<const ZipReader> zip_;
  std::string name_;
  std::unique_ptr<NpyStream> positions_, velocities_, energies_;
  std::size_t count_ = 0, read_ = 0;
  Mesh mesh_;
};

}  // namespace

std::unique_ptr<MotionSource> open_npz(const fs::path& file) {
  const auto zip = std::make_shared<const ZipReader>(file);
  auto positions = array_named(*zip, {"positions", "vertices", "verts", "x"});
  auto faces = array_named(*zip, {"faces", "triangles", "f"});
  if (!positions || !faces) {
    std::string names;
    for (const ZipReader::Member& member : zip->members()) names += (names.empty() ? "" : ", ") + member.name;
    fail_import(file.string(),
                fmt::format("expected the arrays positions and faces, found {}", names.empty() ? "none" : names));
  }
  auto motion = std::make_unique<NpzMotion>(zip, std::move(positions), std::move(faces));
  motion->read_more();
  return motion;
}

}  // namespace drape
