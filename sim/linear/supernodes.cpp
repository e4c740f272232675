#include "sim/linear/supernodes.hpp"

#include <cholmod.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace drape {
namespace {

/// CHOLMOD's settings and workspace.
struct Analysis {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  Analysis() { cholmod_start(&common); }
  ~Analysis() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
};

}  // namespace

Supernodes find_supernodes(const LowerPattern& pattern, const std::vector<int>& order) {
  Analysis analysis;
  cholmod_common& common = analysis.common;
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  // A tenth of CHOLMOD's limit for zeros in merged supernodes, as a factor is solved a hundred times as often as it is
  // computed. For a million vertices this saves 12 % of the entries and a quarter of the time of a solve.
  for (double& share : common.zrelax) share *= 0.1;
  if (!order.empty()) {
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = static_cast<std::size_t>(pattern.size());
  matrix.nzmax = static_cast<std::size_t>(pattern.entries());
  matrix.p = const_cast<int*>(pattern.starts.data());  // CHOLMOD only reads it
  matrix.i = const_cast<int*>(pattern.rows.data());
  matrix.stype = -1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  analysis.factor =
      cholmod_analyze_p(&matrix, order.empty() ? nullptr : const_cast<int*>(order.data()), nullptr, 0, &common);
  if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (common.status == CHOLMOD_TOO_LARGE) throw UsageError("a sparse factor of this cloth has more than 2³¹ entries");
  if (analysis.factor == nullptr)
    throw std::runtime_error("CHOLMOD failed with status " + std::to_string(common.status));

  const cholmod_factor& f = *analysis.factor;
  const auto* perm = static_cast<const int*>(f.Perm);
  const auto *first = static_cast<const int*>(f.super), *starts = static_cast<const int*>(f.pi);
  const auto* rows = static_cast<const int*>(f.s);
  Supernodes result{.order = {perm, perm + f.n},
                    .first = {first, first + f.nsuper + 1},
                    .starts = {0},
                    .rows = {},
                    .operations = common.fl};
  result.starts.reserve(f.nsuper + 1);
  result.rows.reserve(static_cast<std::size_t>(starts[f.nsuper] - static_cast<int>(f.n)));
  for (std::size_t s = 0; s < f.nsuper; ++s) {
    const int width = first[s + 1] - first[s];  // its rows begin with its own columns
    result.rows.insert(result.rows.end(), rows + starts[s] + width, rows + starts[s + 1]);
    result.starts.push_back(result.rows.size());
  }
  return result;
}

}  // namespace drape
