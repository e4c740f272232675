#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/files.hpp"
#include "output/registry.hpp"

namespace drape {

/// Writes a zip archive from front to back: entries stored without compression, with 64-bit sizes for large ones
/// (APPNOTE.TXT 6.3, 4.3.14 and 4.5.3), and without time stamps, so that the same entries give the same bytes.
class ZipWriter {
 public:
  /// @param file must be empty
  explicit ZipWriter(PartialFile& file) : file_(file) {}

  /// Begins an entry; write its bytes to the file next.
  /// @param crc32 checksum of those bytes
  void begin(const std::string& name, std::uint64_t size, std::uint32_t crc32);

  /// Writes the directory after the last entry.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t size, offset;
    std::uint32_t crc32;
  };
  void write(std::string_view bytes);

  PartialFile& file_;
  std::vector<Entry> entries_;
  std::uint64_t written_ = 0;  // includes the bytes of the entries
};

/// A numpy array that grows by rows. Its bytes wait on disk until they are copied into the archive.
class NpyArray {
 public:
  /// @param type    numpy's descr, with its quotes or brackets: "'<f8'"
  /// @param row     shape of a row: {n, 3} for an array of the shape (rows, n, 3)
  NpyArray(const PartialFile& output, std::string name, std::string type, std::vector<std::size_t> row);

  void append(std::string_view row);
  void append_rows(std::size_t count, std::string_view bytes);

  [[nodiscard]] std::string file_name() const { return name_ + ".npy"; }
  /// Returns the bytes before the numbers (NEP 1, version 1.0).
  [[nodiscard]] std::string header() const;
  [[nodiscard]] std::uint64_t data_size() const { return data_.size(); }
  /// Returns the checksum of header and numbers.
  [[nodiscard]] std::uint32_t crc32() const;
  void copy_to(PartialFile& file);

 private:
  std::string name_, type_;
  std::vector<std::size_t> row_;
  Spool data_;
  std::size_t rows_ = 0;
  std::uint32_t crc32_ = 0;  // of the numbers
};

/// Writes the motion as an archive of numpy arrays, listed in docs/reference/outputs.md. Its memory does not grow with
/// the motion: arrays wait on disk, because an archive stores them one after the other.
class NpzWriter final : public MotionWriter {
 public:
  NpzWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  NpyArray& make(std::string name, std::string type, std::vector<std::size_t> row);
  void make_colliders(const Frame& first);
  /// Makes the names of several cloths, and the number of each vertex's cloth.
  void make_cloths(const std::vector<ClothPiece>& pieces);

  FilmInfo film_;
  PartialFile file_;
  std::vector<std::unique_ptr<NpyArray>> arrays_;
  struct {
    NpyArray *positions, *velocities, *times, *frames, *energies, *spheres, *grounds;
  } of_ = {};  // arrays of the motion; pointers into arrays_
  /// Positions of a body; a static one is written once.
  struct Body {
    NpyArray* positions;
    std::shared_ptr<const std::vector<Triangle>> triangles;
    std::string first;  // positions in the first frame
    bool moves = false;
  };
  void add_bodies(const Frame& frame);
  std::vector<Body> bodies_;
  std::size_t frames_ = 0;
  std::size_t vertices_ = 0;
};

OutputFormat npz_format();

}  // namespace drape
