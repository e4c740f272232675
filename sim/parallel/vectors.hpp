#pragma once

// Vector arithmetic of a step on several threads, for n×3 numbers stored as 3n consecutive ones.

#include <cmath>
#include <span>

#include "drape/sim/mesh.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {

/// Returns the columns of n×3 numbers from a row on, as arguments of kernels.
inline Columns<const double> columns(const Vertices& v, Eigen::Index row = 0) {
  return {v.col(0).data() + row, v.col(1).data() + row, v.col(2).data() + row};
}
inline Columns<double> columns(Vertices& v, Eigen::Index row = 0) {
  return {v.col(0).data() + row, v.col(1).data() + row, v.col(2).data() + row};
}

/// Returns Σ a·b over all numbers, with the same bits on every processor.
inline double dot(const Vertices& a, const Vertices& b) {
  const double* vector = a.data();
  double result = 0;
  kernels().dots(static_cast<std::size_t>(a.size()), 1, &vector, b.data(), &result);
  return result;
}

/// Returns the 2-norm over all numbers.
inline double norm(const Vertices& v) { return std::sqrt(dot(v, v)); }

/// Returns Σ a·b over all numbers.
double dot(const Threads& threads, const Vertices& a, const Vertices& b);

/// Returns the 2-norm over all numbers.
double norm(const Threads& threads, const Vertices& v);

/// Computes results[k] = Σ vectors[k]·with, for at most eight vectors of n×3 numbers.
void dots(const Threads& threads, std::span<const double* const> vectors, const Vertices& with, double* results);

/// Sets to = from.
void copy(const Threads& threads, const Vertices& from, Vertices& to);

/// Returns true if all numbers are equal.
bool equal(const Threads& threads, const Vertices& a, const Vertices& b);

/// Sets to = a − b.
void subtract(const Threads& threads, const Vertices& a, const Vertices& b, Vertices& to);

/// Sets to = factor·from.
void scale(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// Sets to = 0.
void set_zero(const Threads& threads, Vertices& to);

/// Sets to = weights·from, with one weight per vertex.
void weigh(const Threads& threads, const Eigen::VectorXd& weights, const Vertices& from, Vertices& to);

/// Adds factor·from to `to`.
void add_multiple(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// Moves positions x with decaying velocities v.
void drift(const Threads& threads, const Drift& drift, Vertices& v, Vertices& x);

/// Sets to = from + factor·to.
void multiply_and_add(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// Sets to = from + factor·other.
void sum(const Threads& threads, const Vertices& from, double factor, const Vertices& other, Vertices& to);

/// Sets to = factor·(from + Σ factors[k]·vectors[k]).
void combine(const Threads& threads, double factor, const Vertices& from, std::span<const double* const> vectors,
             const double* factors, Vertices& to);

/// Sets to = (a − b)/divisor.
void divided_difference(const Threads& threads, const Vertices& a, const Vertices& b, double divisor, Vertices& to);

}  // namespace drape
