#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/read_file.hpp"
#include "import/mesh_sequence.hpp"
#include "import/sources.hpp"
#include "import/vtk_xml.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_bytes_of_list = 200'000'000;

/// The files of one part of a collection.
class PvdPart final : public MotionSource {
 public:
  PvdPart(std::string name, std::vector<double> times, std::vector<fs::path> files,
          std::vector<std::shared_ptr<MotionSource>> bodies)
      : name_(std::move(name)), times_(std::move(times)), files_(std::move(files)), bodies_(std::move(bodies)) {
    first_ = read_mesh_frame(files_.front());
    require_finite(files_.front().string(), first_.mesh.positions);
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] const Mesh& mesh() const override { return first_.mesh; }
  [[nodiscard]] std::size_t count() const override { return files_.size(); }
  [[nodiscard]] std::vector<double> times() override { return times_; }

  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    MeshFrame frame = i == 0 ? first_ : read_mesh_frame(files_[i]);
    require_same_mesh(files_[i].string(), first_.mesh, frame.mesh);
    return {.x = std::move(frame.mesh.positions), .v = std::move(frame.velocities), .energies = frame.energies};
  }

  [[nodiscard]] ImportedColliders colliders() override {
    ImportedColliders found;
    if (first_.spheres.empty() && first_.grounds.empty()) {
      found.bodies = bodies_;
      return found;
    }
    for (const fs::path& file : files_) {
      const MeshFrame frame = &file == &files_.front() ? first_ : read_mesh_frame(file);
      found.spheres.by_moment.push_back(frame.spheres);
      found.grounds.by_moment.push_back(frame.grounds);
    }
    return found;
  }

 private:
  std::string name_;
  std::vector<double> times_;
  std::vector<fs::path> files_;
  std::vector<std::shared_ptr<MotionSource>> bodies_;
  MeshFrame first_;
};

}  // namespace

std::unique_ptr<MotionSource> open_pvd(const fs::path& file) {
  const std::string name = file.string();
  struct Part {
    std::vector<double> times;
    std::vector<fs::path> files;
  };
  std::map<int, Part> parts;
  for (const PvdEntry& entry : read_pvd(name, read_file(file, most_bytes_of_list))) {
    Part& part = parts[entry.part];
    if (!part.times.empty() && !(entry.time > part.times.back())) {
      fail_import(name, fmt::format("the timestep {} of part {} does not come after {}", entry.time, entry.part,
                                    part.times.back()));
    }
    part.times.push_back(entry.time);
    part.files.push_back(file.parent_path() / entry.file);
  }
  std::vector<std::shared_ptr<MotionSource>> bodies;
  const int cloth = parts.begin()->first;
  for (const auto& [number, part] : parts) {
    if (number == cloth) continue;
    bodies.push_back(
        std::make_shared<PvdPart>(name, part.times, part.files, std::vector<std::shared_ptr<MotionSource>>{}));
  }
  Part& own = parts.begin()->second;
  return std::make_unique<PvdPart>(name, std::move(own.times), std::move(own.files), std::move(bodies));
}

}  // namespace drape
