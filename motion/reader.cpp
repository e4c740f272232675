#include "motion/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/names_in_folders.hpp"
#include "motion/packing.hpp"

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
  if (block.tag != tag) blocks_.fail(fmt::format("the file has something else where it should have {}", tag));
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
      throw std::invalid_argument("has an index that is not what it should be");
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

}  // namespace drape
