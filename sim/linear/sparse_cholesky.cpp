#include "sim/linear/sparse_cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/machine.hpp"

namespace drape {

struct SparseCholesky::Implementation {
  cholmod_common common{};
  LowerPattern pattern;
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;

  explicit Implementation(const LowerPattern& p) : pattern(p) {
    cholmod_start(&common);
    common.print = 0;
    const auto n = static_cast<std::size_t>(pattern.size());
    matrix.nrow = matrix.ncol = n;
    matrix.nzmax = static_cast<std::size_t>(pattern.entries());
    matrix.p = pattern.starts.data();
    matrix.i = pattern.rows.data();
    matrix.stype = -1;
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = 1;
    matrix.packed = 1;
  }
  ~Implementation() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void require(bool done) const {
    if (done) return;
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("CHOLMOD failed with status " + std::to_string(common.status));
  }
};

void require_surface(double rows, double operations, double always) {
  // A surface's factor takes about 20 n^1.5 operations (George 1973), with bending 200.
  constexpr double per_row = 2000;
  if (operations <= std::max(always, per_row * rows * std::sqrt(rows))) return;
  throw FactorTooExpensive(
      fmt::format("a sparse factor of {} rows takes {:.1e} operations, because the mesh is unlike a surface: too many "
                  "vertices are joined across it; use a coarser cloth or method = \"semi-implicit\"",
                  rows, operations));
}

SparseCholesky::SparseCholesky(const LowerPattern& pattern, double caller_bytes)
    : implementation_(std::make_unique<Implementation>(pattern)) {
  auto& i = *implementation_;
  i.common.supernodal = CHOLMOD_SIMPLICIAL;
  i.common.final_ll = 1;
  i.matrix.xtype = CHOLMOD_PATTERN;
  i.factor = cholmod_analyze(&i.matrix, &i.common);
  // CHOLMOD's int version numbers up to 2³¹ entries. A larger factor counts with the memory of at least that many.
  constexpr double largest = 2147483647.0;
  constexpr double entry = sizeof(double) + sizeof(int);
  const bool too_large = i.common.status == CHOLMOD_TOO_LARGE || i.common.lnz > largest;
  require_memory("a sparse factor of " + std::to_string(pattern.size()) + " rows",
                 too_large ? std::max(i.common.lnz, largest) * entry : i.common.lnz * (entry + caller_bytes),
                 "use a coarser cloth or another method");
  if (too_large) throw UsageError("a sparse factor of this cloth has more than 2³¹ entries: use conjugate gradients");
  i.require(i.factor != nullptr);
  // Takes a minute or two.
  require_surface(pattern.size(), i.common.fl, 5e10);
  i.matrix.xtype = CHOLMOD_REAL;
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorize(const double* values) {
  auto& i = *implementation_;
  i.matrix.x = const_cast<double*>(values);  // CHOLMOD only reads it
  i.require(cholmod_factorize(&i.matrix, i.factor, &i.common) != 0);
  return i.common.status != CHOLMOD_NOT_POSDEF && i.factor->minor == i.factor->n;
}

const int* SparseCholesky::permutation() const { return static_cast<const int*>(implementation_->factor->Perm); }

SparseCholesky::Columns SparseCholesky::columns() const {
  const cholmod_factor& f = *implementation_->factor;
  return {static_cast<const int*>(f.p), static_cast<const int*>(f.nz), static_cast<const int*>(f.i),
          static_cast<const double*>(f.x)};
}

FreeVertices::FreeVertices(const Cloth& cloth) : numbers_(static_cast<std::size_t>(cloth.vertex_count()), 0) {
  for (const int pin : cloth.pins) numbers_[static_cast<std::size_t>(pin)] = -1;
  for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) {
    int& number = numbers_[static_cast<std::size_t>(vertex)];
    if (number < 0) continue;
    number = count();
    vertices_.push_back(vertex);
  }
}

Vertices FreeVertices::rest_places(const Cloth& cloth) const {
  const Vertices& shape = cloth.rest.rows() == cloth.vertex_count() ? cloth.rest : cloth.positions;
  Vertices places(count(), 3);
  for (int f = 0; f < count(); ++f) places.row(f) = shape.row(vertex(f));
  return places;
}

LowerPattern spring_pattern(const StiffnessBound& bound, const FreeVertices& free) {
  using Index = std::size_t;
  const auto n = static_cast<Index>(free.count());
  const auto each = [&](const auto& visit) {
    bound.for_each_pair([&](const Spring& spring) {
      const auto [low, high] = std::minmax({free.number(spring.i), free.number(spring.j)});
      if (low >= 0) visit(static_cast<Index>(low), high);
    });
  };
  std::vector<int> next(n + 1, 0);  // next free index of each column, after its diagonal
  each([&](Index low, int) { ++next[low + 1]; });
  for (Index c = 0; c < n; ++c) next[c + 1] += next[c] + 1;
  std::vector<int> rows(static_cast<Index>(next[n]));
  const std::vector<int> begins = next;
  for (Index c = 0; c < n; ++c) rows[static_cast<Index>(next[c]++)] = static_cast<int>(c);
  each([&](Index low, int high) { rows[static_cast<Index>(next[low]++)] = high; });

  LowerPattern pattern{.starts = {0}, .rows = {}};
  pattern.starts.reserve(n + 1);
  pattern.rows.reserve(rows.size());
  for (Index c = 0; c < n; ++c) {
    const auto begin = rows.begin() + begins[c], end = rows.begin() + begins[c + 1];
    std::sort(begin, end);
    pattern.rows.insert(pattern.rows.end(), begin, std::unique(begin, end));
    pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
  }
  return pattern;
}

}  // namespace drape
