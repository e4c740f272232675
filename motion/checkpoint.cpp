#include "motion/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "motion/block_writer.hpp"
#include "motion/packing.hpp"
#include "motion/writer.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

// Blocks as in a motion file: valid length of the growing file and the state; optionally the strain limits' restraint
// (HELD, PULL), the stability guard's energies (BOOK) and rows in no block yet; last the times.
constexpr const char* checkpoint_magic = "drape checkpoint 1\n";
constexpr const char* length_tag = "SIZE";
constexpr const char* books_tag = "BOOK";
constexpr const char* held_tag = "HELD";
constexpr const char* tensions_tag = "PULL";
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

EnergyMemory unpack_books(std::string_view payload, Eigen::Index vertices) {
  const std::string bytes = unpack(payload);
  ByteReader reader(bytes);
  EnergyMemory books;
  books.explained = reader.number();
  books.work = reader.number();
  books.looked_at = vertices_of(reader.rest(), vertices);
  return books;
}

/// Returns all packed numbers.
template <class Numbers>
Numbers unpack_numbers(std::string_view payload) {
  const std::string bytes = unpack(payload);
  Numbers numbers(bytes.size() / sizeof(typename Numbers::value_type));
  std::memcpy(numbers.data(), bytes.data(), bytes_of(numbers).size());
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
  const std::optional<EnergyMemory>& books = found.checkpoint.books;
  const bool known =
      !books || (std::isfinite(books->explained) && std::isfinite(books->work) && books->looked_at.allFinite());
  return known && restraint.acceleration.allFinite() && restraint.tensions.allFinite() &&
         std::ranges::all_of(found.microseconds, [](float time) { return std::isfinite(time); });
}

/// Reads the blocks after the first.
void read_blocks(const BlockReader& blocks, std::uint64_t begin, ResumePoint& found) {
  const MotionHeader& header = found.partial->header();
  Restraint restraint;
  while (begin < blocks.size()) {
    const Block block = blocks.block(begin);
    if (block.tag == state_tag) {
      found.checkpoint.state = StateCodec(header.vertices, header.step).decode(block.payload);
    } else if (block.tag == books_tag) {
      found.checkpoint.books = unpack_books(block.payload, header.vertices);
    } else if (block.tag == held_tag) {
      restraint.acceleration = vertices_of(unpack(block.payload), header.vertices);
    } else if (block.tag == tensions_tag) {
      restraint.tensions = unpack_numbers<Eigen::VectorXd>(block.payload);
    } else if (block.tag == rows_tag) {
      found.rows = unpack_rows(block.payload, header);
    } else if (block.tag == times_tag) {
      found.microseconds = unpack_numbers<std::vector<float>>(block.payload);
    }
    begin = block.end;
  }
  found.checkpoint.state.restraint = std::move(restraint);
  // Rows must cover all steps from 0 on, in the growing file's blocks and in the checkpoint.
  const std::int64_t step = found.checkpoint.state.step, in_blocks = found.partial->rows();
  const bool whole = found.checkpoint.state.x.rows() == header.vertices &&
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
  if (const auto& books = checkpoint.books) {
    bytes +=
        block(books_tag,
              pack(ByteWriter().number(books->explained).number(books->work).bytes(bytes_of(books->looked_at)).text()));
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
