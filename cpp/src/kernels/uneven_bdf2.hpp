#pragma once
// bE2 on uneven steps: 1 / (a + x) of every mode in every step. A division takes five times a product's time,
// so that the reciprocals of a block are shares of the reciprocal of its product.

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

/// The coefficients of some steps but for 1 / (next + x).
struct Bdf2Steps {
  static constexpr int most = 256;
  double next[most], here[most], before[most];
  double highest = 0.0;  ///< scale

  explicit Bdf2Steps(const Steps& steps) {
    for (int n = 0; n < steps.count; ++n) {
      const Bdf2Difference a(steps.ratio[n]);
      next[n] = a.next;
      here[n] = -a.here;
      before[n] = -a.before;
    }
    for (int n = 0; n < steps.count; ++n) highest = steps.scale[n] > highest ? steps.scale[n] : highest;
  }
  /// Whether the product of four denominators is a number.
  bool in_range(const Modes& modes, int from, int to) const {
    double largest = 0.0;
    for (int j = from; j < to; ++j)
      largest = modes.inverse_ratio[j] > largest ? modes.inverse_ratio[j] : largest;
    return largest * highest < 1e70;
  }
};

template <int K>
PROBATION_INLINE Vector product(const Vector* factors) {
  if constexpr (K == 1)
    return factors[0];
  else
    return product<K / 2>(factors) * product<K - K / 2>(factors + K / 2);
}

/// Each factor becomes its own reciprocal, given that of their product.
template <int K>
PROBATION_INLINE void share_reciprocal(Vector whole, Vector* factors) {
  if constexpr (K == 1) {
    factors[0] = whole;
  } else {
    const Vector left = product<K / 2>(factors), right = product<K - K / 2>(factors + K / 2);
    share_reciprocal<K / 2>(whole * right, factors);
    share_reciprocal<K - K / 2>(whole * left, factors + K / 2);
  }
}

template <int K>
PROBATION_INLINE void invert(Vector (&factors)[K]) {
  share_reciprocal<K>(1.0 / product<K>(factors), factors);
}

}  // namespace probation::kernels::PROBATION_ISA
