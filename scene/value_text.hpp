#pragma once

#include <string>

#include "core/keys.hpp"

namespace drape {

/// Returns the value of a key's target as scene text; empty for no value and for custom forms. Different values have
/// different texts.
std::string value_text(const Key::Target& target);

struct TomlValue;

/// Returns a value of a document as TOML, on one line.
std::string toml_literal(const TomlValue& value);

/// Returns a string in TOML's quotes.
std::string toml_quoted(const std::string& text);

}  // namespace drape
