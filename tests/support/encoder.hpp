#pragma once

#include <memory>
#include <string>
#include <variant>

#include "output/registry.hpp"

namespace drape::test {

/// Makes the sink of a drawn output.
inline std::unique_ptr<Encoder> make_encoder(const std::string& path, const FilmInfo& film) {
  return std::get<std::unique_ptr<Encoder>>(make_sink(path, film));
}

}  // namespace drape::test
