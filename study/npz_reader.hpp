#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace drape {

/// An array of numpy, its last index fastest.
struct NpyNumbers {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// Reads the arrays of floating-point numbers in an NPZ file, as numpy.savez and savez_compressed write them; arrays of
/// other types are left out.
/// @returns arrays by name
/// @throws UsageError "file: message" if it is no such file, or damaged
std::map<std::string, NpyNumbers> read_npz(const std::filesystem::path& file);

}  // namespace drape
