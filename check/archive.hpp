#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/report.hpp"

namespace drape {

/// A part of a check: the report of some of its scenes, and which those are.
struct CheckShard {
  CheckReport report;
  std::vector<std::size_t> places;  ///< of the report's scenes among all, ascending
  std::size_t scenes = 0;           ///< how many there are in all
  bool whole = true;                ///< or one of several shards, which has only its own

  /// How many of the scenes should be there and are not.
  [[nodiscard]] std::size_t missing() const { return whole ? scenes - places.size() : 0; }
};

/// All of it, with the pictures, as bytes (CBOR, RFC 8949) with their checksum.
std::string pack_shard(const CheckShard& shard);

/// Bytes of CBOR with their checksum after them (16 hexadecimal digits of Hash), as unpack_shard() expects them.
std::string seal_shard(std::string cbor);

/// @param file that they are from
/// @throws UsageError if they are damaged, or name something that is not in a folder
CheckShard unpack_shard(std::string_view bytes, const std::filesystem::path& file);

/// The check that shards are of, with the scenes in their order; of one that several have, the first.
/// @param files that they are from
/// @throws UsageError if they are not of one check
CheckShard merge_shards(std::vector<CheckShard> shards, const std::vector<std::filesystem::path>& files);

}  // namespace drape
