#include "check/motion_file.hpp"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace drape {
namespace {

constexpr std::string_view magic = "drape motion 1\n";

using Words = std::vector<std::uint64_t>;

/// Small numbers of either sign as small ones without: 0, −1, 1, −2, …
std::uint64_t zigzag(std::int64_t n) {
  return (static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63);
}
std::int64_t unzigzag(std::uint64_t n) { return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1); }

// Positions in quanta. Differences of them are taken modulo 2⁶⁴, where nothing can overflow and every one can be
// undone.
using Whole = Eigen::Matrix<std::uint64_t, Eigen::Dynamic, 3>;

constexpr double most_quanta = 9e18;  // what a signed word holds, and a little less

bool can_be_stored(const Vertices& x, double quantum) { return ((x / quantum).array().abs() < most_quanta).all(); }

Whole rounded(const Vertices& x, double quantum) {
  const auto nearest = [](double quanta) { return static_cast<std::uint64_t>(std::llrint(quanta)); };
  return (x / quantum).unaryExpr(nearest);
}

Vertices places_of(const Whole& quanta, double quantum) {
  return quanta.unaryExpr([](std::uint64_t n) { return static_cast<double>(static_cast<std::int64_t>(n)); }) * quantum;
}

/// Foretells the rounded positions of a step from those of the two before it, as if no force acted.
class Prediction {
 public:
  Prediction(const State& start, double quantum) : last_(rounded(start.x, quantum)), before_(last_) {}

  [[nodiscard]] Whole next() const { return std::uint64_t{2} * last_ - before_; }
  void add(const Whole& actual) {
    before_ = last_;
    last_ = actual;
  }

 private:
  Whole last_, before_;
};

class Writer {
 public:
  void whole(std::int64_t n) { words_.push_back(zigzag(n)); }
  void bits(std::uint64_t n) { words_.push_back(n); }
  void number(double value) { words_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void numbers(const Vertices& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) number(values.data()[i]);
  }
  void wholes(const Whole& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) whole(static_cast<std::int64_t>(values.data()[i]));
  }
  [[nodiscard]] const Words& words() const { return words_; }

 private:
  Words words_;
};

class Reader {
 public:
  explicit Reader(Words words) : words_(std::move(words)) {}

  std::uint64_t bits() {
    if (next_ == words_.size()) throw std::invalid_argument("it is cut off");
    return words_[next_++];
  }
  std::int64_t whole() { return unzigzag(bits()); }
  std::int64_t whole(std::int64_t least, std::int64_t most) {
    const std::int64_t n = whole();
    if (n < least || n > most) throw std::invalid_argument("it holds a number that makes no sense");
    return n;
  }
  double number() {
    const auto value = std::bit_cast<double>(bits());
    if (!std::isfinite(value)) throw std::invalid_argument("it holds a number that is not finite");
    return value;
  }
  /// A number of things that take at least `words` words each.
  std::int64_t count(std::int64_t words) {
    const std::int64_t n = whole();
    if (n < 0 || n > static_cast<std::int64_t>(words_.size() - next_) / words) {
      throw std::invalid_argument("it is cut off");
    }
    return n;
  }
  Vertices numbers(Eigen::Index vertices) {
    Vertices values(vertices, 3);
    for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = number();
    return values;
  }
  Vertices places(Eigen::Index vertices, double quantum) {
    Vertices x = numbers(vertices);
    if (!can_be_stored(x, quantum)) throw std::invalid_argument("it holds a position that is too far away");
    return x;
  }
  Whole wholes(Eigen::Index vertices) {
    Whole values(vertices, 3);
    for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = static_cast<std::uint64_t>(whole());
    return values;
  }
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  Words words_;
  std::size_t next_ = 0;
};

/// Byte 7 of every word, then byte 6 of every word, …
std::string in_planes(const Words& words) {
  std::string bytes;
  bytes.reserve(8 * words.size());
  for (int shift = 56; shift >= 0; shift -= 8) {
    for (const std::uint64_t word : words) bytes += static_cast<char>(word >> shift & 255);
  }
  return bytes;
}

Words from_planes(std::string_view bytes) {
  Words words(bytes.size() / 8, 0);
  for (std::size_t i = 0; i < 8 * words.size(); ++i) {
    std::uint64_t& word = words[i % words.size()];
    word = word << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return words;
}

void write_window(Writer& writer, const GoldenWindow& window, double quantum) {
  writer.whole(window.frame.value_or(-1));
  writer.number(window.time);
  writer.whole(window.start.step);
  writer.whole(window.start.x.rows());
  writer.numbers(window.start.x);
  writer.numbers(window.start.v);
  writer.whole(window.shown ? 1 : 0);
  if (window.shown) writer.numbers(*window.shown);
  writer.whole(static_cast<std::int64_t>(window.steps.size()));
  if (!can_be_stored(window.start.x, quantum)) throw std::domain_error("a position is too far away to be stored");
  Prediction prediction(window.start, quantum);
  for (const GoldenStep& step : window.steps) {
    writer.bits(step.bits);
    for (const double energy : {step.energies.kinetic, step.energies.gravity, step.energies.elastic}) {
      writer.number(energy);
    }
    if (!can_be_stored(step.x, quantum)) throw std::domain_error("a position is too far away to be stored");
    const Whole x = rounded(step.x, quantum);
    writer.wholes(x - prediction.next());
    prediction.add(x);
  }
}

GoldenWindow read_window(Reader& reader, double quantum) {
  GoldenWindow window;
  const std::int64_t frame = reader.whole(-1, std::numeric_limits<int>::max());
  if (frame >= 0) window.frame = static_cast<int>(frame);
  window.time = reader.number();
  window.start.step = reader.whole(0, std::numeric_limits<std::int64_t>::max() / 2);
  const std::int64_t vertices = reader.count(6);
  window.start.x = reader.places(vertices, quantum);
  window.start.v = reader.numbers(vertices);
  if (reader.whole(0, 1) != 0) window.shown = reader.places(vertices, quantum);
  const std::int64_t steps = reader.count(3 * vertices + 4);
  Prediction prediction(window.start, quantum);
  for (std::int64_t i = 0; i < steps; ++i) {
    GoldenStep& step = window.steps.emplace_back();
    step.bits = reader.bits();
    step.energies = {.kinetic = reader.number(), .gravity = reader.number(), .elastic = reader.number()};
    const Whole x = prediction.next() + reader.wholes(vertices);
    prediction.add(x);
    step.x = places_of(x, quantum);
    if (!can_be_stored(step.x, quantum)) throw std::invalid_argument("it holds a position that is too far away");
  }
  return window;
}

}  // namespace

std::string pack_motion(const std::vector<GoldenWindow>& windows, double quantum) {
  Writer writer;
  writer.whole(static_cast<std::int64_t>(windows.size()));
  for (const GoldenWindow& window : windows) write_window(writer, window, quantum);

  const std::string planes = in_planes(writer.words());
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                planes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return std::string(magic) + std::to_string(planes.size()) + "\n" + packed;
}

std::uint64_t most_motion_words(std::uint64_t windows, std::uint64_t vertices, std::uint64_t steps) {
  return 1 + windows * (6 + 9 * vertices) + steps * (4 + 3 * vertices);
}

std::vector<GoldenWindow> unpack_motion(std::string_view bytes, double quantum, std::uint64_t most_words) {
  if (!bytes.starts_with(magic)) throw std::invalid_argument("it is no golden motion of this version of drape");
  bytes.remove_prefix(magic.size());
  const std::size_t line = bytes.find('\n');
  std::size_t size = 0;
  for (const char c : bytes.substr(0, line)) {
    if (c < '0' || c > '9' || size > (std::size_t{1} << 40)) throw std::invalid_argument("its size cannot be read");
    size = 10 * size + static_cast<std::size_t>(c - '0');
  }
  // zlib packs a byte into no less than a thousandth of one: nothing larger is reserved for a damaged file.
  if (line == std::string_view::npos || size % 8 != 0 || size / 1100 > bytes.size()) {
    throw std::invalid_argument("it is cut off");
  }
  if (size / 8 > most_words) throw std::invalid_argument("it holds more than belongs to the manifest beside it");
  bytes.remove_prefix(line + 1);
  std::string planes(size, '\0');
  uLongf unpacked = size;
  uLong used = bytes.size();
  if (uncompress2(reinterpret_cast<Bytef*>(planes.data()), &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                  &used) != Z_OK ||
      unpacked != size || used != bytes.size()) {
    throw std::invalid_argument("it is damaged");
  }
  Reader reader(from_planes(planes));
  std::vector<GoldenWindow> windows;
  for (std::int64_t count = reader.count(8); count > 0; --count) windows.push_back(read_window(reader, quantum));
  if (!reader.at_end()) throw std::invalid_argument("there is something after its end");
  return windows;
}

}  // namespace drape
