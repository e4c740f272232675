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

#include "check/golden.hpp"
#include "check/report.hpp"
#include "run/shard.hpp"

namespace drape {
using Json = nlohmann::ordered_json;

/// Parses JSON with limited nesting, since the library takes a stack frame per level.
/// @throws std::invalid_argument if the bytes are invalid
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

/// The file that marks the folder of a shard of a check, see parts_in().
inline constexpr const char* check_mark = "check.cbor";

/// A part of a check: the report of some of its scenes, and their positions among all.
struct CheckShard {
  CheckReport report;
  std::vector<std::size_t> places;  ///< positions of the report's scenes among all, ascending
  std::size_t scenes = 0;           ///< total number of scenes
  Shard shard;                      ///< one of several shards has its own scenes only
};

/// Serialises a shard with its pictures and a checksum (CBOR, RFC 8949).
std::string pack_shard(const CheckShard& shard);

/// Appends the checksum that unpack_shard() expects to CBOR bytes (16 hexadecimal digits of Hash).
std::string seal_shard(std::string cbor);

/// Reads a shard from the bytes of `file`.
/// @throws UsageError if the bytes are damaged, or name anything outside the report's folder
CheckShard unpack_shard(std::string_view bytes, const std::filesystem::path& file);

/// Merges shards of one check, with the scenes in order. Of several shards with the same number, only the first counts.
/// @param files of the shards, for messages
/// @throws UsageError if they belong to different checks or programs, or have different numbers of shards
CheckReport merge_shards(std::vector<CheckShard> shards, const std::vector<std::filesystem::path>& files);

/// The contents of manifest.json.
struct Manifest {
  Golden golden;            ///< all but the windows, and the positions in the frames
  std::string motion_hash;  ///< hash of the motion.bin recorded with it
};

/// Returns the text of manifest.json.
std::string manifest_text(const Golden& golden, const std::string& motion_hash);

/// Parses a manifest. A checksum detects modified text; every value must be present, with its type and a sensible
/// range.
/// @throws std::invalid_argument if the bytes are invalid
Manifest read_manifest(std::string_view bytes);

/// Adds a valid checksum to a manifest with any values.
/// @throws std::invalid_argument if the text is no JSON object
std::string sealed_manifest(std::string_view text);

}  // namespace drape
