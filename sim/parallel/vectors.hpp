#pragma once

// The vector arithmetic of a step, by several threads: on n×3 numbers, which are 3n in a row.

#include <span>

#include "sim/parallel/loops.hpp"

namespace drape {

/// Σ a·b over all numbers.
double dot(const Threads& threads, const Vertices& a, const Vertices& b);

/// The 2-norm over all numbers.
double norm(const Threads& threads, const Vertices& v);

/// results[k] = Σ vectors[k]·with, for as many as there are vectors of n×3 numbers; at most eight.
void dots(const Threads& threads, std::span<const double* const> vectors, const Vertices& with, double* results);

/// to = from.
void copy(const Threads& threads, const Vertices& from, Vertices& to);

/// Whether all numbers are equal.
bool equal(const Threads& threads, const Vertices& a, const Vertices& b);

/// to = a − b.
void subtract(const Threads& threads, const Vertices& a, const Vertices& b, Vertices& to);

/// to = factor·from.
void scale(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// to = 0.
void set_zero(const Threads& threads, Vertices& to);

/// to = weights·from, one weight for each vertex.
void weigh(const Threads& threads, const Eigen::VectorXd& weights, const Vertices& from, Vertices& to);

/// to += factor·from.
void add_multiple(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// to = from + factor·to.
void multiply_and_add(const Threads& threads, double factor, const Vertices& from, Vertices& to);

/// to = from + factor·other.
void sum(const Threads& threads, const Vertices& from, double factor, const Vertices& other, Vertices& to);

/// to = factor·(from + Σ factors[k]·vectors[k]).
void combine(const Threads& threads, double factor, const Vertices& from, std::span<const double* const> vectors,
             const double* factors, Vertices& to);

/// to = (a − b)/divisor.
void divided_difference(const Threads& threads, const Vertices& a, const Vertices& b, double divisor, Vertices& to);

}  // namespace drape
