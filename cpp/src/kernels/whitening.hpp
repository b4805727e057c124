#pragma once
// How columns of a record are taken to coordinates in which its noise is white. Plain pointers, as in
// kernels.hpp.

#include <cstdint>

namespace probation::kernels {

/// Noise s_i n_i, n an ARMA(1,1) process of unit innovations e, and more of it in a few directions; see
/// probation/whitening.hpp.
struct ColouredNoise {
  std::int64_t count;       ///< of samples
  const double* size;       ///< 1 / s
  double phi, theta;        ///< n_t = phi n_{t-1} + e_t + theta e_{t-1}
  const double* variance;   ///< of the first innovations, until it has settled at one
  std::int64_t settling;    ///< how many
  std::int64_t directions;  ///< a multiple of `direction_block`; zero where there are fewer
  const double* basis;      ///< sample by sample; shape (count, directions)
  const double* shrink;     ///< of each direction
};

constexpr std::int64_t direction_block = 12, column_block = 4;

/// In place. Columns are one, or a multiple of `column_block`; values have the shape (count, columns),
/// `along` has that of (directions, columns).
using Whiten = void (*)(const ColouredNoise&, double* values, std::int64_t columns, double* along);

}  // namespace probation::kernels
