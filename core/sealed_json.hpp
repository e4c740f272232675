#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/bytes.hpp"

namespace drape {

/// Returns the text of a JSON file, with a final newline. Replaces bytes that are not UTF-8.
/// @param indent spaces per level
inline std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Returns the checksum of an object's text without its member "checksum": 16 hexadecimal digits.
inline std::string json_checksum(nlohmann::ordered_json json, int indent) {
  json.erase("checksum");
  return checksum_of(json_text(json, indent));
}

/// Returns the text of an object with json_checksum() as its last member.
inline std::string sealed_json(nlohmann::ordered_json json, int indent) {
  const std::string checksum = json_checksum(json, indent);
  json.erase("checksum");
  json["checksum"] = checksum;
  return json_text(json, indent);
}

}  // namespace drape
