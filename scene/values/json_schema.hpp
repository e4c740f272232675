#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/keys.hpp"

/// Parts of a JSON schema (draft 7).
namespace drape::json_schema {

using Json = nlohmann::ordered_json;

Json of_type(const char* type);
/// Returns a reference to a definition of the schema.
Json reference(const std::string& definition);
/// Returns an array of `count` items.
Json tuple(Json item, int count);
Json list(Json item);
/// Returns a list that is not empty.
Json filled_list(Json item);
/// Returns a table with only these keys.
Json closed(Json properties, std::vector<std::string> required = {});
Json any_of(std::vector<Json> forms);
/// Returns the schema with a description.
Json described(const std::string& text, Json schema);
/// Returns a number above 0.
Json positive();

/// Returns a number or an integer within the key's limits.
Json number_of(const Key& key, const char* type);

/// Returns the schema of a table with these keys.
Json table(const Keys& keys);

/// Returns a JSON schema of scene files: every table and key with its form, limits, choices, default, unit and meaning.
/// The reader and the reference page use the same descriptions. Rules between keys are not included.
std::string scene();

}  // namespace drape::json_schema
