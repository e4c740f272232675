#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "scene/document.hpp"

namespace drape::python {

/// Converts a dictionary, list, number, string, truth value or path to the value in a scene file; numpy's numbers and
/// arrays become plain ones, tuples arrays.
/// @throws pybind11::type_error naming the key of any other value, or of one nested deeper than any scene
TomlValue to_toml(const pybind11::handle& value, const std::string& name = "", int depth = 0);

/// Converts {"cloth.stiffness": 300} to overrides of the command line, "cloth.stiffness=300".
std::vector<std::string> to_overrides(const pybind11::dict& set);

}  // namespace drape::python
