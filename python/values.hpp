#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "scene/document.hpp"

namespace drape::python {

/// A dictionary, list, number, string, truth value or path as what a scene file would say: numpy's numbers and arrays
/// as Python's own, tuples as arrays.
/// @throws pybind11::type_error naming the key of what is none of these, or is nested deeper than any scene
TomlValue to_toml(const pybind11::handle& value, const std::string& name = "", int depth = 0);

/// {"cloth.stiffness": 300} as overrides of the command line, "cloth.stiffness=300".
std::vector<std::string> to_overrides(const pybind11::dict& set);

}  // namespace drape::python
