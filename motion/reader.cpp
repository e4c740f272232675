#include "motion/reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "motion/blocks.hpp"
#include "motion/writer.hpp"

namespace drape {
namespace {

constexpr std::uint64_t end_size = 16;
/// Largest accepted coordinate or velocity [m, m/s]. Scenes allow 1e90, see scene/values.hpp; motion may go beyond.
constexpr double largest = 1e100;
const std::string magic = motion_magic;

}  // namespace

template <class Work>
auto MotionReader::understood(const char* tag, std::uint64_t begin, const Work& work) const {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    blocks_.fail(fmt::format("the file {} (block {} at byte {})", error.what(), tag, begin));
  }
}

MotionReader::MotionReader(const std::filesystem::path& file) : MotionReader(file, UINT64_MAX) {}

MotionReader::MotionReader(const std::filesystem::path& file, std::uint64_t length)
    : blocks_(file, magic, "motion", length) {
  const Block head = blocks_.block(magic.size());
  if (head.tag != header_tag) blocks_.fail("the file has no head");
  header_ = understood(header_tag, magic.size(), [&] { return unpack_header(head.payload); });
  name_in_folder(header_.name, file, "block HEAD: name");
  for (const std::string& name : header_.files) name_in_folder(name, file, "block HEAD: files");
  first_ = head.end;
  for (std::size_t k = 0; k <= header_.files.size(); ++k) {
    const bool named = k < header_.files.size();  // scene files: checksum verified on use
    const Block block = named ? blocks_.first_bytes(first_, 0) : blocks_.block(first_);
    if (block.tag != (named ? file_tag : mesh_tag)) blocks_.fail("the file has not all its parts");
    if (named) files_.push_back(first_);
    first_ = block.end;
  }
  codec_.emplace(header_.vertices, header_.step);
  if (length == UINT64_MAX) {
    read_index();
  } else {
    scan(first_);
  }
}

std::string MotionReader::payload(std::uint64_t begin, const char* tag) const {
  Block block = blocks_.block(begin);
  if (block.tag != tag) blocks_.fail(fmt::format("the file lacks {} where it is expected", tag));
  return std::move(block.payload);
}

void MotionReader::read_index() {
  const std::string end = blocks_.size() < end_size ? "" : blocks_.bytes(blocks_.size() - end_size, end_size);
  if (!end.ends_with(motion_end)) blocks_.fail("the file is cut short: it has no end");
  const std::uint64_t begin = ByteReader(end).whole();
  const std::string packed = payload(begin, index_tag);
  if (blocks_.first_bytes(begin, 0).end != blocks_.size() - end_size) blocks_.fail("the file goes on after its index");
  understood(index_tag, begin, [&] {
    const std::string index = unpack(packed);
    ByteReader reader(index);
    const std::uint64_t state_count = reader.whole(), rows_count = reader.whole();
    if (state_count > index.size() || rows_count > index.size() ||
        reader.rest().size() != 16 * (state_count + rows_count)) {
      throw std::invalid_argument("has an invalid index");
    }
    for (std::uint64_t i = 0; i < 2 * state_count; ++i) state_index_.push_back(reader.whole());
    for (std::uint64_t i = 0; i < 2 * rows_count; ++i) rows_index_.push_back(reader.whole());
    check_index();
    if (states() == 0 || last_step() != header_.steps || row_count_ != header_.steps + 1) {
      throw std::invalid_argument("does not hold all steps that it should");
    }
  });
}

void MotionReader::scan(std::uint64_t begin) {
  while (begin < blocks_.size()) {
    const Block block = blocks_.first_bytes(begin, 8);
    const bool state = block.tag == state_tag;
    if (!state && block.tag != rows_tag) blocks_.fail("the file has a part that does not belong there");
    understood(state ? state_tag : rows_tag, begin, [&] {
      auto& index = state ? state_index_ : rows_index_;
      index.insert(index.end(), {ByteReader(block.payload).whole(), begin});
    });
    begin = block.end;
  }
  understood(state_tag, first_, [&] { check_index(); });
}

void MotionReader::verify() {
  for (std::uint64_t begin = magic.size(); begin < blocks_.size();) begin = blocks_.block(begin).end;
  for (std::size_t i = 0; i < states(); ++i) state(i);
  for (std::int64_t step = 0; step < rows(); ++step) row(step);
}

void MotionReader::check_index() {
  const auto in_order = [&](const std::vector<std::uint64_t>& index) {
    for (std::size_t i = 0; i < index.size(); i += 2) {
      const bool later = i == 0 ? index[0] == 0 : index[i] > index[i - 2] && index[i + 1] > index[i - 1];
      if (!later || index[i] > static_cast<std::uint64_t>(header_.steps) || index[i + 1] < first_) return false;
    }
    return true;
  };
  if (!in_order(state_index_) || !in_order(rows_index_)) {
    throw std::invalid_argument("has steps that are not in order");
  }
  if (rows_index_.empty()) return;
  for (std::size_t i = 0; i < rows_index_.size(); i += 2) {
    if (rows_index_[i] != i / 2 * rows_in_block) throw std::invalid_argument("does not have the rows of all steps");
  }
  const std::uint64_t first = rows_index_[rows_index_.size() - 2], begin = rows_index_.back();
  const auto last = understood(rows_tag, begin, [&] { return unpack_rows(payload(begin, rows_tag), header_); });
  row_count_ = static_cast<std::int64_t>(first + last.size());
}

std::string MotionReader::scene_file(std::size_t k) const {
  return understood(file_tag, files_[k], [&] { return unpack(payload(files_[k], file_tag)); });
}

const State& MotionReader::state(std::size_t i) {
  if (decoded_ > 0 && decoded_ - 1 == i) return state_;
  const std::size_t group = i - i % states_in_group;
  if (decoded_ <= group || decoded_ > i) decoded_ = group;
  for (; decoded_ <= i; ++decoded_) {
    const std::uint64_t begin = state_index_[2 * decoded_ + 1];
    const std::string bytes = payload(begin, state_tag);
    understood(state_tag, begin, [&] {
      if (decoded_ % states_in_group == 0) codec_->begin_group();
      state_ = codec_->decode(bytes);
      if (!(state_.x.cwiseAbs().maxCoeff() <= largest && state_.v.cwiseAbs().maxCoeff() <= largest)) {
        throw std::invalid_argument("holds a place or velocity that cannot be");
      }
      if (state_.step != step(decoded_)) throw std::invalid_argument("has a state of another step than its index says");
    });
  }
  return state_;
}

const StepRow& MotionReader::row(std::int64_t step) {
  if (rows_index_.empty()) blocks_.fail("the file has no rows");
  if (rows_.empty() || step < rows_.front().step || step > rows_.back().step) {
    std::size_t block = rows_index_.size() / 2 - 1;
    while (block > 0 && rows_index_[2 * block] > static_cast<std::uint64_t>(step)) --block;
    const std::uint64_t begin = rows_index_[2 * block + 1];
    rows_ = understood(rows_tag, begin, [&] { return unpack_rows(payload(begin, rows_tag), header_); });
  }
  const bool there = !rows_.empty() && step >= rows_.front().step && step <= rows_.back().step;
  if (!there) blocks_.fail(fmt::format("the file has no row for step {}", step));
  return rows_[static_cast<std::size_t>(step - rows_.front().step)];
}

const StateCodec& MotionReader::codec() {
  if (states() > 0) state(states() - 1);
  return *codec_;
}

namespace fs = std::filesystem;
namespace {

/// Loads the scene of a motion; problems name the motion's file.
LoadedScene load_scene_of(const MotionReader& motion, const fs::path& file) {
  try {
    return load_scene(file);
  } catch (const UsageError& error) {
    const std::string folder = file.parent_path().string() + "/";
    std::string text = error.what();
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
    throw UsageError(fmt::format("{}: the file's scene cannot be read: {}", shown(motion.file()), text));
  }
}

/// Checks that the motion contains all input files of its scene. @throws UsageError if the scene names a file elsewhere
void require_own_inputs(const MotionReader& motion, const LoadedScene& scene, const fs::path& folder) {
  for (const fs::path& input : scene.source.inputs) {
    if (input.lexically_normal().parent_path() == folder.lexically_normal()) continue;
    throw UsageError(
        fmt::format("{}: the file's scene names a file that is not in it: {}", shown(motion.file()), shown(input)));
  }
}

}  // namespace

MotionScene::MotionScene(const MotionReader& motion) : folder_("drape-scene") {
  const MotionHeader& header = motion.header();
  for (std::size_t k = 0; k < header.files.size(); ++k) {
    write_file_atomically(folder_.path() / header.files[k], motion.scene_file(k));
  }
  file_ = folder_.path() / (header.name + ".toml");
  write_file_atomically(file_, header.scene);
  scene_ = load_scene_of(motion, file_);
  require_own_inputs(motion, scene_, folder_.path());
  const Cloth& cloth = scene_.simulation.cloth;
  if (cloth.vertex_count() != header.vertices || static_cast<int>(cloth.triangles.size()) != header.triangles) {
    throw UsageError(shown(motion.file()) + ": the file's scene has another cloth than its motion");
  }
  if (scene_.simulation.step != header.step) {
    throw UsageError(shown(motion.file()) + ": the file's scene has another time step than its motion");
  }
  if (physics_hash(physics_values(scene_)) != header.physics) {
    throw UsageError(
        fmt::format("{}: this drape interprets its scene differently from drape {}, which computed the motion",
                    shown(motion.file()), shown(header.program)));
  }
}

LoadedScene MotionScene::load(const std::vector<std::string>& overrides, const fs::path& folder) const {
  return load_scene(file_, overrides, cells_of(scene_), folder);
}

void require_same_physics(const std::string& motion, const LoadedScene& scene, const LoadedScene& other,
                          const std::string& name) {
  const std::string difference = physics_difference(physics_values(scene), physics_values(other), name);
  if (difference.empty()) return;
  throw UsageError(
      fmt::format("{} is a different motion from what {} gives: simulate again, or leave these values unchanged\n{}",
                  motion, name, difference));
}

namespace fs = std::filesystem;
namespace {

// Blocks as in a motion file: valid length of the growing file and the state; optionally the strain limits' restraint
// (HELD, PULL), the forces of contacts (BEAR), the number of substeps to begin with (CUTS), the stability guard's
// energies (BOOK) and rows in no block yet; last the times.
constexpr const char* checkpoint_magic = "drape checkpoint 1\n";
constexpr const char* length_tag = "SIZE";
constexpr const char* memory_tag = "BOOK";
constexpr const char* held_tag = "HELD";
constexpr const char* tensions_tag = "PULL";
constexpr const char* contacts_tag = "BEAR";
constexpr const char* substeps_tag = "CUTS";
constexpr const char* times_tag = "TIME";

std::string block(std::string_view tag, const std::string& payload) { return block_head(tag, payload) + payload; }

template <class Numbers>
std::string_view bytes_of(const Numbers& v) {
  return {reinterpret_cast<const char*>(v.data()), static_cast<std::size_t>(v.size()) * sizeof(*v.data())};
}

Vertices vertices_of(std::string_view bytes, Eigen::Index count) {
  Vertices v(count, 3);
  if (bytes.size() != bytes_of(v).size()) throw std::invalid_argument("is of another cloth");
  std::memcpy(v.data(), bytes.data(), bytes.size());
  return v;
}

EnergyMemory unpack_memory(std::string_view payload, Eigen::Index vertices) {
  const std::string bytes = unpack(payload);
  ByteReader reader(bytes);
  EnergyMemory memory;
  memory.explained = reader.number();
  memory.work = reader.number();
  const bool has_energy = reader.rest().size() > 3 * static_cast<std::size_t>(vertices) * sizeof(double);
  if (has_energy) memory.energy = reader.number();
  memory.checked_at = vertices_of(reader.rest(), vertices);
  return memory;
}

/// Returns all packed numbers.
template <class Numbers>
Numbers unpack_numbers(std::string_view payload) {
  const std::string bytes = unpack(payload);
  Numbers numbers(bytes.size() / sizeof(typename Numbers::value_type));
  std::memcpy(static_cast<void*>(numbers.data()), bytes.data(), bytes_of(numbers).size());
  return numbers;
}

/// Returns true if a growing file has every state that a run has written until a step.
bool has_states_until(const MotionReader& partial, std::int64_t step) {
  if (partial.states() == 0 || partial.last_step() > step) return false;
  const std::optional<std::int64_t> every = partial.header().recorded.every;
  return !every || static_cast<std::int64_t>(partial.states()) == step / *every + 1;
}

bool is_finite(const ResumePoint& found) {
  const Restraint& restraint = found.checkpoint.state.restraint;
  const std::optional<EnergyMemory>& memory = found.checkpoint.energy_memory;
  const bool known = !memory || (std::isfinite(memory->explained) && std::isfinite(memory->work) &&
                                 std::isfinite(memory->energy.value_or(0)) && memory->checked_at.allFinite());
  const auto is_force = [](const ContactForce& contact) { return contact.force.allFinite(); };
  return known && std::ranges::all_of(found.checkpoint.state.contact_forces, is_force) &&
         restraint.acceleration.allFinite() && restraint.tensions.allFinite() &&
         std::ranges::all_of(found.microseconds, [](float time) { return std::isfinite(time); });
}

/// Reads the blocks after the first.
void read_blocks(const BlockReader& blocks, std::uint64_t begin, ResumePoint& found) {
  const MotionHeader& header = found.partial->header();
  Restraint restraint;
  std::vector<ContactForce> contacts;
  std::int64_t substeps = 0;
  while (begin < blocks.size()) {
    const Block block = blocks.block(begin);
    if (block.tag == state_tag) {
      found.checkpoint.state = StateCodec(header.vertices, header.step).decode(block.payload);
    } else if (block.tag == memory_tag) {
      found.checkpoint.energy_memory = unpack_memory(block.payload, header.vertices);
    } else if (block.tag == held_tag) {
      restraint.acceleration = vertices_of(unpack(block.payload), header.vertices);
    } else if (block.tag == tensions_tag) {
      restraint.tensions = unpack_numbers<Eigen::VectorXd>(block.payload);
    } else if (block.tag == contacts_tag) {
      contacts = unpack_numbers<std::vector<ContactForce>>(block.payload);
    } else if (block.tag == substeps_tag) {
      substeps = static_cast<std::int64_t>(ByteReader(unpack(block.payload)).whole());
    } else if (block.tag == rows_tag) {
      found.rows = unpack_rows(block.payload, header);
    } else if (block.tag == times_tag) {
      found.microseconds = unpack_numbers<std::vector<float>>(block.payload);
    }
    begin = block.end;
  }
  found.checkpoint.state.restraint = std::move(restraint);
  found.checkpoint.state.contact_forces = std::move(contacts);
  found.checkpoint.state.substeps = substeps;
  // Rows must cover all steps from 0 on, in the growing file's blocks and in the checkpoint.
  const std::int64_t step = found.checkpoint.state.step, in_blocks = found.partial->rows();
  const bool whole = found.checkpoint.state.x.rows() == header.vertices && substeps >= 0 &&
                     (found.rows.empty() || found.rows.front().step == in_blocks) &&
                     in_blocks + static_cast<std::int64_t>(found.rows.size()) == step + 1 &&
                     found.microseconds.size() == static_cast<std::size_t>(step) && step < header.steps;
  if (!whole || !has_states_until(*found.partial, step) || !is_finite(found)) {
    throw std::invalid_argument("does not go with the file that grows");
  }
}

}  // namespace

const StepRow& ResumePoint::row(std::int64_t step) const {
  const std::int64_t in_blocks = partial->rows();
  return step < in_blocks ? partial->row(step) : rows[static_cast<std::size_t>(step - in_blocks)];
}

std::string pack_checkpoint(const Simulation::Checkpoint& checkpoint, double step, std::uint64_t length,
                            const std::vector<StepRow>& rows, std::span<const float> microseconds) {
  std::string bytes = checkpoint_magic;
  bytes += block(length_tag, ByteWriter().whole(length).text());
  bytes += block(state_tag, StateCodec(checkpoint.state.x.rows(), step).encode(checkpoint.state));
  if (const Restraint& restraint = checkpoint.state.restraint; restraint.tensions.size() > 0) {
    bytes += block(held_tag, pack(bytes_of(restraint.acceleration)));
    bytes += block(tensions_tag, pack(bytes_of(restraint.tensions)));
  }
  if (const auto& contacts = checkpoint.state.contact_forces; !contacts.empty()) {
    bytes += block(contacts_tag, pack(bytes_of(contacts)));
  }
  if (const std::int64_t substeps = checkpoint.state.substeps; substeps > 0) {
    bytes += block(substeps_tag, pack(ByteWriter().whole(static_cast<std::uint64_t>(substeps)).text()));
  }
  if (const auto& memory = checkpoint.energy_memory) {
    ByteWriter writer;
    writer.number(memory->explained).number(memory->work);
    if (memory->energy) writer.number(*memory->energy);
    bytes += block(memory_tag, pack(writer.bytes(bytes_of(memory->checked_at)).text()));
  }
  if (!rows.empty()) bytes += block(rows_tag, pack_rows(rows));
  return bytes + block(times_tag, pack(bytes_of(microseconds)));
}

ResumePoint read_resumption(const fs::path& file) {
  const fs::path growing = growing_name(file), checkpoint = checkpoint_name(file);
  if (!fs::exists(growing)) {
    throw UsageError(fmt::format("{}: nothing to resume: no {}", shown(file), shown(growing)));
  }
  if (!fs::exists(checkpoint)) {
    throw UsageError(fmt::format("{}: cannot be resumed, because there is no {}: simulate again", shown(growing),
                                 shown(checkpoint)));
  }
  const BlockReader blocks(checkpoint, checkpoint_magic, "checkpoint");
  try {
    const Block size = blocks.block(std::string_view(checkpoint_magic).size());
    if (size.tag != length_tag) throw std::invalid_argument("does not begin as it should");
    ResumePoint found;
    found.length = ByteReader(size.payload).whole();
    found.partial = std::make_shared<MotionReader>(growing, found.length);
    if (found.partial->size() != found.length) throw std::invalid_argument("is of a longer file than there is");
    found.partial->verify();  // a damaged growing file could never be completed
    read_blocks(blocks, size.end, found);
    return found;
  } catch (const std::invalid_argument& error) {
    blocks.fail(std::string("the checkpoint ") + error.what());
  }
}

}  // namespace drape
