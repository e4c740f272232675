#include "tests/random/random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "scene/tables.hpp"
#include "tests/support/random.hpp"
#include "tests/support/visit_target.hpp"

namespace drape::test {
namespace {

class Writer {
 public:
  explicit Writer(std::uint64_t seed) : random_(seed * 7919 + 17), wild_(random_.number() < 0.25 ? 0.12 : 0.0) {
    for (int i = 0; i < 10; ++i) random_.number();  // generators of nearby seeds begin alike
    stiff_ = random_.number() < 0.2;
  }

  std::string scene() {
    columns_ = 1 + random_.below(stiff_ ? 8 : 18);
    rows_ = 1 + random_.below(stiff_ ? 8 : 18);
    for (int pin = 0; pin < random_.below(4); ++pin) pins_.push_back(random_.below((columns_ + 1) * (rows_ + 1)));
    cloth();
    step_ = random_.number() < wild_ ? std::pow(10, random_.between(-8, 2))
                                     : std::pow(10, random_.between(-3.5, stiff_ ? 0 : -1.5));
    text_ += fmt::format("[time]\nstep = {}\nduration = {}\n", number(step_), number(step_ * random_.below(51)));
    Scene scene;
    ClothTable cloth_table;
    SeamTable seam;
    for (const TableType& table : scene_tables(cloth_table, seam, scene)) {
      if (!table.name.starts_with("cloth") && table.name != "seam" && table.name != "time")
        add(table, "[" + table.name);
    }
    for (const EffectType& type : effect_types()) {
      // Cloth finer than its own thickness is in contact everywhere, which takes an implicit method minutes.
      if (!explicit_ && type.name == "self_collision") continue;
      if (type.name == "pressure") continue;  // a grid encloses nothing
      const double often = !stiff_ ? 0.3 : type.name == "gravity" ? 0.8 : 0.05;
      if (random_.number() > often || (!wild() && type.name == "moving_pins" && pins_.empty())) continue;
      // Pins can be moved by one table only.
      const bool alone = type.name == "bending" || type.name == "strain_limit";  // a second acts on the same cloth
      const int count = type.repeatable && !alone && (wild() || type.name != "moving_pins") ? 1 + random_.below(2) : 1;
      for (int i = 0; i < count; ++i) {
        Effect effect = type.make();
        add(effect_table(type, effect),
            type.repeatable ? fmt::format("[[effects.{}]", type.name) : fmt::format("[effects.{}", type.name));
      }
    }
    return text_;
  }

 private:
  void cloth() {
    text_ += fmt::format("[cloth]\nmesh = {{ grid = [{}, {}] }}\n", columns_, rows_);
    if (random_.number() < 0.3) text_ += fmt::format("rest = {{ grid = [{}, {}] }}\n", columns_, rows_);
    text_ += fmt::format("mass = {}\nstiffness = {}\n", positive(stiff_ ? 0.1 : 1),
                         positive(stiff_ ? std::pow(10, random_.between(3, 9)) : 200));
    text_ += pins_.empty() ? "" : fmt::format("pins = [{}]\n", fmt::join(pins_, ", "));
    if (random_.number() < (stiff_ ? 0.6 : 0.3)) text_ += "velocity = " + vector(3) + "\n";
    if (stiff_) {
      const double scale = 1 + 0.3 * random_.number();
      text_ += fmt::format("[cloth.transform]\nscale = [{}, 1, 1]\nrotate = {}\n", number(scale), vector(90));
    } else if (random_.number() < 0.4) {
      text_ += fmt::format("[cloth.transform]\nscale = {}\nrotate = {}\ntranslate = {}\n", positive(1), vector(90),
                           vector(1));
    }
  }

  void add(const TableType& table, const std::string& heading) {
    text_ += heading + "]\n";
    const auto motion = static_cast<std::size_t>(random_.below(8));
    for (const Key& key : table.keys.all()) {
      if (key.name == "cloth" || key.name == "contact") continue;  // names of several cloths
      if (wild() ? !key.required && random_.number() > 0.35 : !wanted(table.name, key, motion)) continue;
      const std::string text = visit_target<std::string>(key, [&](const auto& target) { return value(key, target); });
      if (key.name == "method") explicit_ = text == "\"semi-implicit\"" || text == "\"verlet\"";
      if (!text.empty()) text_ += fmt::format("{} = {}\n", key.name, text);
    }
  }

  [[nodiscard]] bool wild() const { return wild_ > 0; }

  /// Returns true if a valid scene may have the key: there are rules between keys.
  /// @param motion kind of motion of a sphere or body, if any
  bool wanted(const std::string& table, const Key& key, std::size_t motion) {
    if (table == "effects.sphere" && (key.name == "scale" || key.name == "thickness")) {
      return motion % 3 == (key.name == "scale" ? 0 : 1);
    }
    if (key.name == "box") return true;
    if (key.name == "prim") return false;
    // A sphere may have it only as contact, and then needs it.
    if (key.name == "allow_overlap") return table != "effects.sphere" || motion % 3 == 1;
    if (table == "effects.sphere" && motion % 3 != 1 && (key.name == "friction" || key.name == "restitution"))
      return false;
    if (table == "effects.sphere" || table == "effects.body") {
      constexpr std::array<std::string_view, 4> motions{"velocity", "orbit_period", "keyframes", "track"};
      const auto found = std::ranges::find(motions, key.name);
      if (found != motions.end()) return motion == static_cast<std::size_t>(found - motions.begin()) && motion < 3;
      if (key.name == "center") return motion != 2;
      if (key.name == "rotations" && motion == 1) return false;
    }
    if (key.name == "rigidity" || key.name == "stiffness_bound" ||
        (table == "effects.moving_pins" && key.name == "keyframes"))
      return true;
    if (key.name == "scheme" && explicit_) return false;
    if (table == "effects.sphere" && key.name == "stiffness") return false;
    if (key.name == "samples" || key.name == "frames" || key.name == "ignore_frames") return false;
    return key.required || random_.number() < 0.35;
  }

  static std::string number(double value) {
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  /// Returns a number of this size, or a wild one.
  double any(double size) {
    if (random_.number() >= wild_) return size * random_.between(-1, 1);
    constexpr double extremes[] = {0, -1, 1e-300, 1e300, -1e300, 1e-12, 1e12, 5e-324};
    if (random_.number() < 0.4) return extremes[random_.below(8)];
    return std::pow(10, random_.between(-12, 12)) * (random_.number() < 0.5 ? -1 : 1);
  }
  std::string positive(double size) {
    if (random_.number() < 0.1 * wild_) return random_.number() < 0.5 ? "nan" : "-inf";
    const double value = random_.number() < wild_ ? any(size) : size * std::pow(10, random_.between(-1, 1));
    return number(random_.number() < 0.8 ? std::abs(value) : value > 0 ? value : -value * (1 - 2 * wild_));
  }
  std::string vector(double size) {
    return fmt::format("[{}, {}, {}]", number(any(size)), number(any(size)), number(any(size)));
  }

  double within(const Key& key, double initial) {
    const bool below = std::isfinite(key.minimum), above = std::isfinite(key.maximum);
    const double size = initial != 0 ? std::abs(initial) : 1;
    if (random_.number() < wild_) return any(size);
    if (below && above) return key.minimum + (key.maximum - key.minimum) * random_.between(0.01, 1);
    if (below) return key.minimum + (key.minimum == 0 ? size : 0.5) * std::pow(10, random_.between(-1, 1));
    return any(size);
  }
  int whole(const Key& key, int initial) {
    if (random_.number() < wild_ && key.name.find("iterations") == std::string::npos) {
      constexpr int extremes[] = {0, -1, 2147483647, -2147483647 - 1, 65536};
      return extremes[random_.below(5)];
    }
    const int low = std::isfinite(key.minimum) ? static_cast<int>(key.minimum) : -100;
    const int high =
        std::isfinite(key.maximum) ? static_cast<int>(key.maximum) : low + 2 * std::max(50, std::min(initial, 100));
    return low + random_.below(high - low + 1);
  }

  std::string value(const Key& key, const bool*) {
    if (key.name == "allow_overlap" && !wild()) return "true";
    return random_.number() < 0.5 ? "true" : "false";
  }
  std::string value(const Key& key, const int* v) { return fmt::format("{}", whole(key, *v)); }
  std::string value(const Key& key, const std::optional<int>*) { return fmt::format("{}", whole(key, 50)); }
  std::string value(const Key& key, const double* v) { return number(within(key, *v)); }
  std::string value(const Key& key, const std::optional<double>* v) {
    if (key.name == "stiffness_bound" && !wild()) return "2.0";  // of the steepest three formulas
    // A cloth's bending energy is far below a joule; a sphere's radius is a fraction of the cloth.
    return number(within(key, v->value_or(0.3)));
  }
  std::string value(const Key& key, const std::optional<WarpWeft>*) {
    return number(within(key, key.name == "rigidity" ? 1e-4 : 0.3));
  }
  std::string value(const Key&, const std::string*) { return random_.number() < wild_ ? "\"\\u0000\"" : "\"a\""; }
  std::string value(const Key&, const std::filesystem::path*) {
    return random_.number() < wild_ ? "\"nowhere.png\"" : "\"plaid.png\"";
  }
  std::string value(const Key&, const Rgb*) { return random_.number() < wild_ ? "\"#12345\"" : "\"teal\""; }
  std::string value(const Key&, const std::optional<Rgb>*) { return "\"#123456\""; }
  std::string value(const Key&, const Choice& choice) {
    if (random_.number() < 0.3 * wild_) return "\"nothing\"";
    // Solved contact is compatible with few other keys.
    const bool contact = !choice.names.empty() && choice.names.back() == "solved";
    const int count = static_cast<int>(choice.names.size()) - (contact ? 1 : 0);
    return '"' + choice.names[static_cast<std::size_t>(random_.below(count))] + '"';
  }
  std::string value(const Key&, const std::shared_ptr<const SphereTrack>*) {
    return random_.number() < wild_ ? "\"nowhere.usda\"" : "";
  }
  std::string value(const Key&, const KeyframeList& list) {
    std::string text;
    double time = 0;
    for (int i = 0; i < 1 + random_.below(4); ++i) {
      time += random_.number() < wild_ ? any(1) : 10 * step_ * random_.number() + 1e-9;
      text +=
          fmt::format("{}{{ time = {}, {} = {} }}", i == 0 ? "" : ", ", number(time), list.names.front(), vector(0.3));
    }
    return "[" + text + "]";
  }
  std::string value(const Key&, const FormulaList&) {
    constexpr const char* formulas[] = {"0", "-x", "sin(3*t)", "-0.5*vy", "abs(y)", "1/(1 + z^2)"};
    const auto any_formula = [&] { return random_.number() < 0.2 * wild_ ? "x +* y" : formulas[random_.below(6)]; };
    return fmt::format("[\"{}\", \"{}\", \"{}\"]", any_formula(), any_formula(), any_formula());
  }
  std::string value(const Key&, const VertexSelection&) {
    if (pins_.empty() || random_.number() < wild_) return "[0]";
    return fmt::format("[{}]", pins_[static_cast<std::size_t>(random_.below(static_cast<int>(pins_.size())))]);
  }
  std::string value(const Key& key, const Eigen::Vector2i*) {
    return fmt::format("[{}, {}]", whole(key, 64), whole(key, 64));
  }
  std::string value(const Key& key, const std::optional<Eigen::Vector2i>*) {
    return fmt::format("[{}, {}]", whole(key, 64), whole(key, 64));
  }
  std::string value(const Key&, const Eigen::Vector3d* v) {
    return vector(v->isZero(0) ? 1 : v->cwiseAbs().maxCoeff());
  }
  std::string value(const Key& key, const std::optional<Eigen::Vector3d>*) {
    if (!std::isfinite(key.minimum)) return vector(1);
    return fmt::format("[{}, {}, {}]", positive(0.3), positive(0.3), positive(0.3));
  }
  std::string value(const Key& key, const std::vector<int>*) { return fmt::format("[{}]", whole(key, 10)); }

  Random random_;
  double wild_;  // fraction of values far from their defaults
  int columns_ = 1, rows_ = 1;
  bool explicit_ = false;  // true for an explicit method
  bool stiff_ = false;     // few vertices, stretched and thrown, whose springs dominate inertia
  std::vector<int> pins_;
  double step_ = 0.01;
  std::string text_;
};

}  // namespace

std::string random_scene(std::uint64_t seed) { return Writer(seed).scene(); }

}  // namespace drape::test
