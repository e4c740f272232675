#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "import/mesh_sequence.hpp"
#include "import/number_bytes.hpp"
#include "import/sources.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t header_bytes = 32;

class Pc2 final : public MotionSource {
 public:
  Pc2(const fs::path& file, const fs::path& mesh) : name_(file.string()), stream_(file, std::ios::binary) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || !stream_)
      fail_import(name_, "the file cannot be read: " + (error ? error.message() : "no permission"));
    std::string header(header_bytes, '\0');
    if (!stream_.read(header.data(), header_bytes) || std::memcmp(header.data(), "POINTCACHE2", 12) != 0) {
      fail_import(name_, "it is no point cache: it does not begin with POINTCACHE2");
    }
    const auto whole = [&](std::size_t at) {
      return number_at(header.data() + at, {NumberType::Kind::integer, 4, false});
    };
    const double points = whole(16), samples = whole(28);
    mesh_ = read_mesh_frame(mesh).mesh;
    if (points != static_cast<double>(mesh_.positions.rows())) {
      fail_import(name_, fmt::format("it has {} points, and {} has {} vertices", points, mesh.string(),
                                     mesh_.positions.rows()));
    }
    if (samples < 1) fail_import(name_, fmt::format("it has {} samples; expected at least one", samples));
    const double expected = header_bytes + 12.0 * points * samples;
    if (static_cast<double>(size) < expected) {
      fail_import(name_, fmt::format("it is cut short: {} samples of {} points take {} bytes, found {}", samples,
                                     points, expected, size));
    }
    count_ = static_cast<std::size_t>(samples);
    mesh_.positions = read();
    require_finite(name_, mesh_.positions);
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] const Mesh& mesh() const override { return mesh_; }
  [[nodiscard]] std::size_t count() const override { return count_; }
  [[nodiscard]] ImportedMoment moment(std::size_t i) override {
    if (i == 0) return {.x = mesh_.positions};
    ImportedMoment moment{.x = read()};
    require_finite(fmt::format("{}: sample {}", name_, i), moment.x);
    return moment;
  }

 private:
  Vertices read() {
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> rows(mesh_.positions.rows(), 3);
    stream_.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(float)));
    if (!stream_) fail_import(name_, "it is cut short");
    return rows.cast<double>();
  }

  std::string name_;
  std::ifstream stream_;
  Mesh mesh_;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<MotionSource> open_pc2(const fs::path& file, const fs::path& mesh) {
  return std::make_unique<Pc2>(file, mesh.empty() ? fs::path(file).replace_extension(".obj") : mesh);
}

}  // namespace drape
