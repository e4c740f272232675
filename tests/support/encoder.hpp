#pragma once

#include <memory>
#include <string>
#include <variant>

#include "output/make_sink.hpp"

namespace drape::test {

/// The sink of an output that must be drawn.
inline std::unique_ptr<Encoder> make_encoder(const std::string& path, const FilmInfo& film) {
  return std::get<std::unique_ptr<Encoder>>(make_sink(path, film));
}

}  // namespace drape::test
