#pragma once

// Example:
//   drape::Effects effects{drape::Gravity{}, drape::Damping{.factor = 0.2}};
//   effects.add(drape::Sphere{.center = Eigen::Vector3d(0, 0, -1), .radius = 0.4});
//   if (const auto* damping = effects[2].as<drape::Damping>()) std::printf("%g", damping->factor);

#include <concepts>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drape {

class Keys;
struct SimulationSettings;
struct System;

/// Receiver of the problems of an effect, one per call: the key at fault (empty: the whole table) and a sentence.
using ProblemSink = std::function<void(std::string_view key, const std::string& sentence)>;

/// Estimated time for an effect per vertex and step on a processor of 2022 [s]. Includes the iterations that it adds to
/// a step.
struct EffectCost {
  double evaluated = 0;  ///< in methods that evaluate forces once
  double solved = 0;     ///< in methods that solve for a step
};

/// A type of effect: a struct whose public members are its parameters, with defaults and units. A scene sets them in
/// the table [effects.NAME]; code writes a value, Damping{.factor = 0.2}. It has
///   static constexpr std::string_view name            the NAME of its table
///   static constexpr bool repeatable = true           if [[effects.NAME]] may occur several times
///   static constexpr EffectCost cost                  if its time is worth counting
///   static constexpr bool touches = true              if the cloth can touch it
///   void describe(Keys&)                              lists the table's keys; their values are written to the members
///   void check(const SimulationSettings&, const ProblemSink&) const
///                                                     optional: reports values that conflict with each other or with
///                                                     other settings
///   void install(System&) const                       adds its forces, springs, energies, filters, corrections and
///                                                     colliders to the system
template <class T>
concept EffectValue = requires(T value, const T& constant, Keys& keys, System& system) {
  { T::name } -> std::convertible_to<std::string_view>;
  value.describe(keys);
  constant.install(system);
};

/// An effect of any type, copied by value.
class Effect {
 public:
  // Implicit, so that any effect value converts to an Effect.
  template <EffectValue T>
  Effect(T value) : held_(std::make_unique<Held<T>>(std::move(value))) {}
  Effect(const Effect& other) : held_(other.held_->copy()) {}
  Effect(Effect&&) noexcept = default;
  Effect& operator=(Effect other) noexcept { return std::swap(held_, other.held_), *this; }
  ~Effect() = default;

  [[nodiscard]] std::string_view name() const { return held_->name(); }
  [[nodiscard]] EffectCost cost() const { return held_->cost(); }
  /// Returns true if the cloth can touch it.
  [[nodiscard]] bool touches() const { return held_->touches(); }
  /// Lists the keys, whose targets are members of this object.
  void describe(Keys& keys) { held_->describe(keys); }
  void check(const SimulationSettings& settings, const ProblemSink& problem) const { held_->check(settings, problem); }
  void install(System& system) const { held_->install(system); }

  /// Returns the effect as this type, or null if it has another.
  template <EffectValue T>
  [[nodiscard]] const T* as() const {
    const auto* held = dynamic_cast<const Held<T>*>(held_.get());
    return held == nullptr ? nullptr : &held->value;
  }

 private:
  struct Any {
    virtual ~Any() = default;
    [[nodiscard]] virtual std::unique_ptr<Any> copy() const = 0;
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual EffectCost cost() const = 0;
    [[nodiscard]] virtual bool touches() const = 0;
    virtual void describe(Keys& keys) = 0;
    virtual void check(const SimulationSettings& settings, const ProblemSink& problem) const = 0;
    virtual void install(System& system) const = 0;
  };

  template <class T>
  struct Held final : Any {
    T value;

    explicit Held(T v) : value(std::move(v)) {}
    [[nodiscard]] std::unique_ptr<Any> copy() const override { return std::make_unique<Held>(value); }
    [[nodiscard]] std::string_view name() const override { return T::name; }
    [[nodiscard]] EffectCost cost() const override {
      if constexpr (requires { T::cost; }) return T::cost;
      return {};
    }
    [[nodiscard]] bool touches() const override {
      if constexpr (requires { T::touches; }) return T::touches;
      return false;
    }
    void describe(Keys& keys) override { value.describe(keys); }
    void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
      if constexpr (requires { &T::check; }) value.check(settings, problem);
    }
    void install(System& system) const override { value.install(system); }
  };

  std::unique_ptr<Any> held_;
};

/// A row of the registry.
struct EffectType {
  std::string_view name;
  bool repeatable;   ///< true if [[effects.NAME]] may occur several times
  Effect (*make)();  ///< creates the effect with its defaults
};

/// Returns the only list of all effects, in order of evaluation.
std::span<const EffectType> effect_types();

/// Effects of a simulation in order of evaluation. This is the registry's order, independent of the order of add(). An
/// effect of an unregistered type keeps the position where it was added; no other effect moves past it.
class Effects {
 public:
  Effects() = default;
  Effects(std::initializer_list<Effect> effects) {
    for (const Effect& effect : effects) add(effect);
  }

  void add(Effect effect);

  [[nodiscard]] bool empty() const { return effects_.empty(); }
  [[nodiscard]] std::size_t size() const { return effects_.size(); }
  const Effect& operator[](std::size_t i) const { return effects_[i]; }
  [[nodiscard]] auto begin() const { return effects_.begin(); }
  [[nodiscard]] auto end() const { return effects_.end(); }

 private:
  std::vector<Effect> effects_;
};

}  // namespace drape
