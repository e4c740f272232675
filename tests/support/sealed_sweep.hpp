#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/hash.hpp"

namespace drape::test {

/// The text of a sweep.json that was changed, with the checksum that it then has to have.
inline std::string sealed_sweep(const std::string& text) {
  const auto text_of = [](const nlohmann::ordered_json& json) { return json.dump(1) + "\n"; };
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
  json.erase("checksum");
  Hash hash;
  hash.add(text_of(json));
  json["checksum"] = hash.text();
  return text_of(json);
}

}  // namespace drape::test
