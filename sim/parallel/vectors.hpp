#pragma once

// Vector arithmetic of a step on several threads, for n×3 numbers stored as 3n consecutive ones.

#include <span>

#include "sim/parallel/loops.hpp"

namespace drape {

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
