#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace drape {
using Json = nlohmann::ordered_json;

/// Parses JSON with limited nesting, since the library takes a stack frame per level.
/// @throws std::invalid_argument that describes the error in the bytes
Json parse_json(std::string_view bytes);

/// Typed access to the members of a JSON object; a missing member or wrong type is an error. Refers to the object.
/// @throws std::invalid_argument that names the member and the expected type
class Fields {
 public:
  /// @param name prefix for the names of members in messages: "camera."
  Fields(const Json& json, std::string name);

  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] bool is_null(const char* key) const { return at(key).is_null(); }
  [[nodiscard]] Fields object(const char* key) const { return {at(key), name_ + key + "."}; }
  [[nodiscard]] std::vector<Fields> objects(const char* key) const;
  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] double number(const char* key) const { return number(at(key), key); }
  [[nodiscard]] std::optional<double> number_or_nothing(const char* key) const {
    return is_null(key) ? std::nullopt : std::optional(number(key));
  }
  [[nodiscard]] bool flag(const char* key) const;
  [[nodiscard]] double positive(const char* key, double least = std::numeric_limits<double>::min()) const;

  template <class T>
  [[nodiscard]] T whole(const char* key, std::int64_t least, std::int64_t most) const {
    return static_cast<T>(whole(at(key), key, least, most));
  }

  [[nodiscard]] Eigen::Vector3d point(const char* key) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> point_or_nothing(const char* key) const {
    return is_null(key) ? std::nullopt : std::optional(point(key));
  }
  [[nodiscard]] Eigen::Vector2i pixels(const char* key) const;

  [[noreturn]] void fail(const char* key, std::string_view expected) const;

 private:
  [[nodiscard]] const Json& at(const char* key) const;
  void list(const char* key, std::size_t count) const;
  [[nodiscard]] double number(const Json& json, const char* key) const;
  [[nodiscard]] std::int64_t whole(const Json& json, const char* key, std::int64_t least, std::int64_t most) const;

  const Json& json_;
  std::string name_;
};

}  // namespace drape
