#include "check/motion_file.hpp"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
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

using Whole = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3>;

Whole rounded(const Vertices& x, double quantum) {
  const Vertices scaled = x / quantum;
  if (!(scaled.cwiseAbs().array() < 9e18).all()) throw std::domain_error("a position is too far away to be stored");
  return scaled.unaryExpr([](double value) { return std::nearbyint(value); }).cast<std::int64_t>();
}

/// Foretells the rounded positions of a step from those of the two before it, as if no force acted.
class Prediction {
 public:
  Prediction(const State& start, double quantum) : last_(rounded(start.x, quantum)), before_(last_) {}

  [[nodiscard]] Whole next() const { return 2 * last_ - before_; }
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
    for (Eigen::Index i = 0; i < values.size(); ++i) whole(values.data()[i]);
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
  double number() { return std::bit_cast<double>(bits()); }
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
  Whole wholes(Eigen::Index vertices) {
    Whole values(vertices, 3);
    for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = whole();
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
  Prediction prediction(window.start, quantum);
  for (const GoldenStep& step : window.steps) {
    writer.bits(step.bits);
    for (const double energy : {step.energies.kinetic, step.energies.gravity, step.energies.elastic}) {
      writer.number(energy);
    }
    const Whole x = rounded(step.x, quantum);
    writer.wholes(x - prediction.next());
    prediction.add(x);
  }
}

GoldenWindow read_window(Reader& reader, double quantum) {
  GoldenWindow window;
  if (const std::int64_t frame = reader.whole(); frame >= 0) window.frame = static_cast<int>(frame);
  window.time = reader.number();
  window.start.step = reader.whole();
  const std::int64_t vertices = reader.count(6);
  window.start.x = reader.numbers(vertices);
  window.start.v = reader.numbers(vertices);
  if (reader.whole() != 0) window.shown = reader.numbers(vertices);
  const std::int64_t steps = reader.count(3 * vertices + 4);
  Prediction prediction(window.start, quantum);
  for (std::int64_t i = 0; i < steps; ++i) {
    GoldenStep& step = window.steps.emplace_back();
    step.bits = reader.bits();
    step.energies = {.kinetic = reader.number(), .gravity = reader.number(), .elastic = reader.number()};
    const Whole x = prediction.next() + reader.wholes(vertices);
    prediction.add(x);
    step.x = x.cast<double>() * quantum;
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

std::vector<GoldenWindow> unpack_motion(std::string_view bytes, double quantum) {
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
  bytes.remove_prefix(line + 1);
  std::string planes(size, '\0');
  uLongf unpacked = size;
  if (uncompress(reinterpret_cast<Bytef*>(planes.data()), &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size()) != Z_OK ||
      unpacked != size) {
    throw std::invalid_argument("it is damaged");
  }
  Reader reader(from_planes(planes));
  std::vector<GoldenWindow> windows;
  for (std::int64_t count = reader.count(8); count > 0; --count) windows.push_back(read_window(reader, quantum));
  if (!reader.at_end()) throw std::invalid_argument("there is something after its end");
  return windows;
}

}  // namespace drape
