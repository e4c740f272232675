#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/hash.hpp"

namespace drape {

/// Text of a JSON file, with a newline at its end. Bytes that are not UTF-8 are replaced.
/// @param indent of each level, in spaces
inline std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Checksum of the text of an object without its member "checksum": 16 hexadecimal digits.
inline std::string json_checksum(nlohmann::ordered_json json, int indent) {
  json.erase("checksum");
  return checksum_of(json_text(json, indent));
}

/// Text of an object with that checksum as its last member.
inline std::string sealed_json(nlohmann::ordered_json json, int indent) {
  const std::string checksum = json_checksum(json, indent);
  json.erase("checksum");
  json["checksum"] = checksum;
  return json_text(json, indent);
}

}  // namespace drape
