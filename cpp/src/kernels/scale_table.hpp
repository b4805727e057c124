#pragma once
// The exponential rule on uneven steps without an exponential per step. One function holds its coefficients
// without cancellation,
//
//   chi(x) = (1 - phi(x)) / x,    phi = 1 - x chi,    e^-x = 1 - x phi,    psi = 2 chi - phi,
//
// and all modes see the same scale, x_j = scale q_j. The scales are cut into cells, 32 in each octave; within
// a cell the chi of each mode is a polynomial of degree 6 in t, the place in the cell from -1 to 1, through
// Chebyshev's points: chi is entire, its n-th term is below (1 / 64)^n, and the interpolation's error some
// 1e-15 (measured: see tests/cpp/test_scale_table.cpp). Where x is small, terms fall faster still, and slow
// modes need fewer of them. No mode needs to be spaced like its neighbours for that. Cells are formed where
// steps fall into them, and kept.

#include <cstring>

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

/// A cell of scales and the place in it.
struct ScalePlace {
  static constexpr unsigned cell_bits = 5;  // cells in an octave, as a power of two

  std::int64_t cell;  ///< the leading bits of the scale; negative: out of range
  double offset;      ///< t

  PROBATION_INLINE explicit ScalePlace(double scale) {
    std::uint64_t bits;
    std::memcpy(&bits, &scale, sizeof bits);
    const std::uint64_t exponent = bits >> 52U;  // of a negative scale beyond all
    cell = exponent < 64 || exponent > 1982 ? -1 : static_cast<std::int64_t>(bits >> (52U - cell_bits));
    const std::uint64_t inverse_bits = (2046 + cell_bits + 1 - exponent) << 52U;
    double inverse_half_width;
    std::memcpy(&inverse_half_width, &inverse_bits, sizeof inverse_half_width);
    offset = (scale - centre(cell)) * inverse_half_width;
  }
  PROBATION_INLINE static double centre(std::int64_t cell) {
    return from_cell(cell, std::uint64_t{1} << 51U);
  }
  PROBATION_INLINE static double half_width(std::int64_t cell) { return centre(cell) - from_cell(cell, 0); }

 private:
  PROBATION_INLINE static double from_cell(std::int64_t cell, std::uint64_t half) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(cell) << (52U - cell_bits)) | (half >> cell_bits);
    double scale;
    std::memcpy(&scale, &bits, sizeof scale);
    return scale;
  }
};

/// From values at Chebyshev's points t_i to coefficients of powers of t.
struct PowersFromPoints {
  static constexpr int terms = ScaleTable::terms;
  double point[terms]{}, power[terms][terms]{};

  constexpr PowersFromPoints() {
    static_assert(terms == 7);
    // cos((2 i + 1) pi / 14)
    constexpr double positive[3] = {0.97492791218182360702, 0.78183148246802980871, 0.43388373911755812048};
    for (int i = 0; i < 3; ++i) {
      point[i] = positive[i];
      point[terms - 1 - i] = -positive[i];
    }
    // T_m(t_i) and the powers of t in T_m, from T_{m+1} = 2 t T_m - T_{m-1}.
    double value[terms][terms]{}, powers[terms][terms]{};
    powers[0][0] = 1.0;
    powers[1][1] = 1.0;
    for (int i = 0; i < terms; ++i) {
      value[0][i] = 1.0;
      value[1][i] = point[i];
    }
    for (int m = 2; m < terms; ++m)
      for (int i = 0; i < terms; ++i) {
        value[m][i] = 2.0 * point[i] * value[m - 1][i] - value[m - 2][i];
        powers[m][i] = (i > 0 ? 2.0 * powers[m - 1][i - 1] : 0.0) - powers[m - 2][i];
      }
    for (int m = 0; m < terms; ++m)
      for (int i = 0; i < terms; ++i)
        for (int p = 0; p < terms; ++p)
          power[p][i] += (m == 0 ? 1.0 : 2.0) / terms * powers[m][p] * value[m][i];
  }
};

/// The rows of a cell, for all modes: the coefficients of four modes lie together.
inline void form_cell(const Modes& modes, std::int64_t cell, double* rows) {
  static constexpr PowersFromPoints transform;
  constexpr int terms = ScaleTable::terms;
  const double centre = ScalePlace::centre(cell), half_width = ScalePlace::half_width(cell);
  for (int at = 0; at < modes.padded; at += lanes) {
    const Vector q = load(modes.inverse_ratio + at);
    Vector power[terms] = {};
    for (int i = 0; i < terms; ++i) {
      const auto c =
          ExponentialStep::coefficients<Vector>(q * (centre + half_width * transform.point[i]), 1.0);
      const Vector chi = 0.5 * (c.forcing + c.curvature);
      for (int p = 0; p < terms; ++p) power[p] += chi * transform.power[p][i];
    }
    for (int p = 0; p < terms; ++p)
      store(rows + static_cast<std::ptrdiff_t>(at) * terms + std::ptrdiff_t{p} * lanes, power[p]);
  }
}

/// Consecutive steps and their places in the table, as many as its slots hold together.
struct TabledSteps {
  static constexpr int most = 256;

  int count = 0;                       ///< none: the table is not worth while here
  double lowest = 0.0, highest = 0.0;  ///< scale
  double offset[most];
  const double* rows[most];

  /// Cells that are missing are formed where steps of a cell are as many as its terms, on average.
  TabledSteps(const Modes& modes, const double* scale, int available) {
    ScaleTable& kept = *modes.table;
    const auto stride = static_cast<std::ptrdiff_t>(modes.padded) * ScaleTable::terms;
    std::int64_t wanted[ScaleTable::slots];
    for (std::int64_t& cell : wanted) cell = -1;
    int missing = 0;
    lowest = highest = scale[0];
    for (; count < available && count < most; ++count) {
      const ScalePlace place(scale[count]);
      if (place.cell < 0) break;
      const int slot = static_cast<int>(place.cell % ScaleTable::slots);
      if (wanted[slot] != place.cell) {
        if (wanted[slot] >= 0) break;
        wanted[slot] = place.cell;
        if (kept.cell[slot] != place.cell) ++missing;
      }
      offset[count] = place.offset;
      rows[count] = kept.rows + slot * stride;
      lowest = scale[count] < lowest ? scale[count] : lowest;
      highest = scale[count] > highest ? scale[count] : highest;
    }
    if (missing * ScaleTable::terms > count) {
      count = 0;
      return;
    }
    for (int slot = 0; missing > 0 && slot < ScaleTable::slots; ++slot) {
      if (wanted[slot] < 0 || kept.cell[slot] == wanted[slot]) continue;
      form_cell(modes, wanted[slot], kept.rows + slot * stride);
      kept.cell[slot] = wanted[slot];
      --missing;
    }
  }
};

/// chi of the four modes whose coefficients these are, by the first `terms` of them.
template <int terms = ScaleTable::terms>
PROBATION_INLINE Vector tabled_chi(const double* row, double offset) {
  Vector chi = load(row + std::ptrdiff_t{terms - 1} * lanes);
#pragma GCC unroll 8
  for (int i = terms - 2; i >= 0; --i) chi = chi * offset + load(row + std::ptrdiff_t{i} * lanes);
  return chi;
}

/// How many terms keep the digits of chi for modes up to x; term n is
/// below 2 (x / 64)^n / (n + 2)! of it.
PROBATION_INLINE int terms_of_chi(double x) { return x < 0.3 ? 5 : x < 1.0 ? 6 : ScaleTable::terms; }

}  // namespace probation::kernels::PROBATION_ISA
