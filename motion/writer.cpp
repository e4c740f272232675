#include "motion/writer.hpp"

#include <fmt/format.h>
#include <cstring>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "motion/blocks.hpp"
#include "motion/reader.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 31;  // limit of a scene's file

MotionHeader complete(MotionHeader header, const LoadedScene& scene) {
  const Cloth& cloth = scene.simulation.cloth;
  header.program = this_program();
  header.name = as_name_in_folder(scene.name);
  header.scene = scene.source.portable.text;
  for (const PortableScene::File& file : scene.source.portable.files) header.files.push_back(file.name);
  header.physics = physics_hash(physics_values(scene));
  header.step = scene.simulation.step;
  header.vertices = cloth.vertex_count();
  header.triangles = static_cast<int>(cloth.triangles.size());
  header.textured = !scene.uvs.empty();
  if (cloth.pieces.size() > 1 && !header.imported) {
    for (const ClothPiece& piece : cloth.pieces) header.cloths.push_back(piece.name);
  }
  return header;
}

/// Frees and returns the growing name. @throws UsageError also for a scene's file whose name a motion cannot hold
fs::path free_growing_name(const fs::path& file, const PortableScene& scene) {
  require_not_growing(file);
  for (const PortableScene::File& input : scene.files) name_in_folder(input.name, input.place, "a scene's file");
  fs::path growing = growing_name(file);
  if (growing.has_parent_path()) fs::create_directories(growing.parent_path());
  // A run was killed before its first checkpoint, or right after the file was complete.
  if (fs::exists(growing)) remove_unless_written(growing);
  fs::remove(checkpoint_name(file));
  return growing;
}

/// Returns a link's target, which may be on another file system; any other file, and a link without end, as it is.
fs::path without_links(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(file, error)) return file;
  try {
    return link_target(file);
  } catch (const fs::filesystem_error&) {
    return file;
  }
}

}  // namespace

fs::path growing_name(const fs::path& file) { return without_links(file).string() + ".partial"; }
fs::path checkpoint_name(const fs::path& file) { return without_links(file).string() + ".checkpoint"; }

void require_not_growing(const fs::path& file) {
  const fs::path growing = growing_name(file);
  if (!fs::exists(growing) || !fs::exists(checkpoint_name(file))) return;
  throw UsageError(fmt::format(
      "{} exists, from a run in progress or ended early: drape simulate --resume {} completes it; to start over, "
      "remove it",
      shown(growing), shown(file)));
}

MotionFileWriter::MotionFileWriter(fs::path file, MotionHeader header, const LoadedScene& scene)
    : file_(std::move(file)),
      blocks_(free_growing_name(file_, scene.source.portable), motion_magic),
      header_(complete(std::move(header), scene)),
      codec_(header_.vertices, header_.step) {
  blocks_.add(header_tag, pack_header(header_));
  for (const PortableScene::File& input : scene.source.portable.files) {
    blocks_.add(file_tag, pack(read_file(input.place, most_bytes)));
  }
  blocks_.add(mesh_tag, pack_surface(scene.simulation.cloth.triangles, scene.uvs));
}

MotionFileWriter::MotionFileWriter(fs::path file, const ResumePoint& from)
    : file_(std::move(file)),
      blocks_(growing_name(file_), from.length),
      header_(from.partial->header()),
      codec_(from.partial->codec()),
      rows_(from.rows),
      state_index_(from.partial->state_index()),
      rows_index_(from.partial->rows_index()) {}

void MotionFileWriter::add(const StepRow& row) {
  rows_.push_back(row);
  if (header_.cloths.empty()) rows_.back().cloths.clear();  // a growing file of an older version has no such columns
  if (rows_.size() == rows_in_block) write_rows();
}

void MotionFileWriter::add(const State& state) {
  if (state_index_.size() / 2 % states_in_group == 0) codec_.begin_group();
  const std::uint64_t begin = blocks_.add(state_tag, codec_.encode(state));
  state_index_.insert(state_index_.end(), {static_cast<std::uint64_t>(state.step), begin});
}

void MotionFileWriter::write_rows() {
  if (rows_.empty()) return;
  const std::uint64_t begin = blocks_.add(rows_tag, pack_rows(rows_));
  rows_index_.insert(rows_index_.end(), {static_cast<std::uint64_t>(rows_.front().step), begin});
  rows_.clear();
}

void MotionFileWriter::keep(const Simulation::Checkpoint& checkpoint, std::span<const float> microseconds) {
  blocks_.sync();
  write_file_atomically(checkpoint_name(file_),
                        pack_checkpoint(checkpoint, header_.step, blocks_.size(), rows_, microseconds));
}

void MotionFileWriter::discard() {
  std::error_code ignored;
  fs::remove(growing_name(file_), ignored);
  fs::remove(checkpoint_name(file_), ignored);
}

std::uint64_t MotionFileWriter::finish() {
  write_rows();
  ByteWriter index;
  index.whole(state_index_.size() / 2).whole(rows_index_.size() / 2);
  for (const auto* part : {&state_index_, &rows_index_}) {
    for (const std::uint64_t number : *part) index.whole(number);
  }
  const std::uint64_t begin = blocks_.add(index_tag, pack(index.text()));
  blocks_.write(ByteWriter().whole(begin).bytes(motion_end).text());
  blocks_.complete_as(link_target(file_));
  std::error_code ignored;
  fs::remove(checkpoint_name(file_), ignored);
  return blocks_.size();
}

}  // namespace drape
