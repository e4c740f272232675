#include "tests/audit/exact_roots.hpp"

#include <algorithm>

namespace drape::audit {
namespace {

constexpr int most_halvings = 36;  // a cubic's value times 2¹⁰⁸ still fits

int sign(Integer value) { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }

Integer common_divisor(Integer a, Integer b) {
  while (b != 0) a %= b, std::swap(a, b);
  return a < 0 ? -a : a;
}

Integers trimmed(Integers p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

/// Divides by the common divisor of the coefficients, which keeps signs.
Integers primitive(Integers p) {
  Integer divisor = 0;
  for (const Integer c : p) divisor = common_divisor(divisor, c);
  for (Integer& c : p) c /= divisor;
  return p;
}

Integers derivative(const Integers& p) {
  Integers d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(static_cast<Integer>(i) * p[i]);
  return d;
}

struct Division {
  Integers quotient, remainder;  // both multiplied by the same positive number
};

Division divide(Integers a, const Integers& b) {
  Integers quotient(a.size() >= b.size() ? a.size() - b.size() + 1 : 0, 0);
  while (a.size() >= b.size()) {
    const Integer top = b.back() < 0 ? -a.back() : a.back(), factor = b.back() < 0 ? -b.back() : b.back();
    const std::size_t shift = a.size() - b.size();
    for (Integer& c : quotient) c *= factor;
    quotient[shift] += top;
    for (Integer& c : a) c *= factor;
    for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] -= top * b[i];
    a = trimmed(a);
  }
  return {quotient, primitive(a)};
}

Integers common_factor(Integers a, Integers b) {
  while (!b.empty()) {
    Integers remainder = divide(a, b).remainder;
    a = b;
    b = remainder;
  }
  return primitive(a);
}

/// Returns the sign of p(m / 2^halvings).
int sign_of(const Integers& p, Integer m, int halvings) {
  Integer value = 0, power = 1;
  for (std::size_t i = p.size(); i-- > 0;) {
    value = value * m + p[i] * power;
    power <<= halvings;
  }
  return sign(value);
}

std::vector<Integers> sturm_chain(const Integers& p) {
  std::vector<Integers> chain{p, primitive(derivative(p))};
  while (chain.back().size() > 1) {
    Integers next = divide(chain[chain.size() - 2], chain.back()).remainder;
    if (next.empty()) break;
    for (Integer& c : next) c = -c;
    chain.push_back(next);
  }
  return chain;
}

int variations(const std::vector<Integers>& chain, Integer m, int halvings) {
  int count = 0, last = 0;
  for (const Integers& p : chain) {
    const int now = sign_of(p, m, halvings);
    count += static_cast<int>(now * last < 0);
    if (now != 0) last = now;
  }
  return count;
}

/// Counts roots in (low, low + 1] / 2^halvings.
int count_roots(const std::vector<Integers>& chain, Integer low, int halvings) {
  return variations(chain, low, halvings) - variations(chain, low + 1, halvings);
}

void isolate(const std::vector<Integers>& chain, Integer low, int halvings, std::vector<Root>& found) {
  const bool at_end = sign_of(chain[0], low + 1, halvings) == 0;
  const int within = count_roots(chain, low, halvings) - static_cast<int>(at_end);
  if (within == 1) found.push_back({low, halvings, false});
  if (within > 1) {
    isolate(chain, 2 * low, halvings + 1, found);
    isolate(chain, 2 * low + 1, halvings + 1, found);
  } else if (at_end) {
    found.push_back({low + 1, halvings, true});
  }
}

Integers squarefree(const Integers& p) {
  if (p.size() < 2) return p;
  const Integers repeated = common_factor(p, derivative(p));
  return primitive(divide(p, repeated).quotient);
}

}  // namespace

Integers operator+(const Integers& a, const Integers& b) {
  Integers sum(std::max(a.size(), b.size()), 0);
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += b[i];
  return trimmed(sum);
}

Integers operator-(const Integers& a, const Integers& b) { return a + Integers{-1} * b; }

Integers operator*(const Integers& a, const Integers& b) {
  if (a.empty() || b.empty()) return {};
  Integers product(a.size() + b.size() - 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

std::vector<Root> roots_in_step(const Integers& p) {
  std::vector<Root> found;
  if (p.size() < 2) return found;
  const std::vector<Integers> chain = sturm_chain(squarefree(p));
  if (sign_of(p, 0, 0) == 0) found.push_back({0, 0, true});
  isolate(chain, 0, 0, found);
  return found;
}

std::optional<int> sign_at(const Integers& q, const Root& root, const Integers& p) {
  if (q.empty()) return 0;
  if (root.exact) return sign_of(q, root.low, root.halvings);
  if (q.size() == 1) return sign(q[0]);
  const Integers mine = squarefree(p), common = common_factor(mine, q);
  const auto inner_roots = [](const std::vector<Integers>& chain, Integer low, int halvings) {
    return count_roots(chain, low, halvings) - static_cast<int>(sign_of(chain[0], low + 1, halvings) == 0);
  };
  if (common.size() > 1 && inner_roots(sturm_chain(common), root.low, root.halvings) > 0) return 0;
  const std::vector<Integers> of_q = sturm_chain(squarefree(q)), of_p = sturm_chain(mine);
  Root r = root;
  while (inner_roots(of_q, r.low, r.halvings) > 0) {
    if (r.halvings == most_halvings) return std::nullopt;
    r = {2 * r.low, r.halvings + 1, false};
    if (sign_of(mine, r.low + 1, r.halvings) == 0) return sign_of(q, r.low + 1, r.halvings);
    if (inner_roots(of_p, r.low, r.halvings) == 0) ++r.low;
  }
  return sign_of(q, 2 * r.low + 1, r.halvings + 1);
}

}  // namespace drape::audit
