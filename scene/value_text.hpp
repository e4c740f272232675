#pragma once

#include <string>

#include "core/keys.hpp"

namespace drape {

/// What a key's target holds, as a scene would say it; empty where it holds nothing, or what is of a form of its own.
/// Different values have different texts.
std::string value_text(const Key::Target& target);

struct TomlValue;

/// A value of a document as TOML writes it, on one line.
std::string toml_literal(const TomlValue& value);

/// A string in TOML's quotes.
std::string toml_quoted(const std::string& text);

}  // namespace drape
