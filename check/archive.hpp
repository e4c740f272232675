#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/report.hpp"

namespace drape {

/// A part of a check: the report of some of its scenes, and their positions among all.
struct CheckShard {
  CheckReport report;
  std::vector<std::size_t> places;  ///< positions of the report's scenes among all, ascending
  std::size_t scenes = 0;           ///< total number of scenes
  bool whole = true;                ///< false: one of several shards, with its own scenes only

  /// Returns the number of scenes that are missing from the report.
  [[nodiscard]] std::size_t missing() const { return whole ? scenes - places.size() : 0; }
};

/// Serialises a shard with its pictures and a checksum (CBOR, RFC 8949).
std::string pack_shard(const CheckShard& shard);

/// Appends the checksum that unpack_shard() expects to CBOR bytes (16 hexadecimal digits of Hash).
std::string seal_shard(std::string cbor);

/// Reads a shard from the bytes of `file`.
/// @throws UsageError if the bytes are damaged, or name anything outside the report's folder
CheckShard unpack_shard(std::string_view bytes, const std::filesystem::path& file);

/// Merges shards of one check, with the scenes in order; duplicate scenes come from the first shard.
/// @param files of the shards, for messages
/// @throws UsageError if they belong to different checks
CheckShard merge_shards(std::vector<CheckShard> shards, const std::vector<std::filesystem::path>& files);

}  // namespace drape
