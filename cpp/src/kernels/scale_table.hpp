#pragma once
// The exponential rule on uneven steps without an exponential per step. One function holds its coefficients
// without cancellation,
//
//   chi(x) = (1 - phi(x)) / x,    phi = 1 - x chi,    e^-x = 1 - x phi,    psi = 2 chi - phi,
//
// and all modes have the same scale, x_j = scale q_j. The scales are cut into cells, 32 in each octave;
// within a cell the chi of each mode is a polynomial of degree 6 in t, the place in the cell from -1 to 1,
// through Chebyshev's points: chi is entire, its n-th term is below (1 / 64)^n, and the interpolation's error
// some 1e-15 (measured: see tests/cpp/test_scale_table.cpp). Where x is small, terms fall faster still, and
// slow modes need fewer of them. The modes may be spaced in any way. A cell is formed when the first step
// falls into it, and kept.
//
// The other table is coefficient_table.hpp, for steps whose scale is unknown until their stress is known.
// Here one function serves phi and psi, and the terms of the modes of a vector lie together in memory, in
// the order in which a sweep with time innermost reads them.

#include <cstring>

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

/// A cell of scales, lower <= scale < upper: those whose numbers begin with the same bits.
struct ScaleCell {
  static constexpr unsigned cell_bits = 5;  // cells in an octave, as a power of two

  std::int64_t index = -1;  ///< the leading bits; negative: out of range
  double lower = 0.0, upper = 0.0, centre = 0.0, inverse_half_width = 0.0;

  ScaleCell() = default;
  PROBATION_INLINE explicit ScaleCell(std::int64_t its_index)
      : index(its_index),
        lower(from_index(its_index)),
        upper(from_index(its_index + 1)),
        centre(0.5 * (lower + upper)),
        inverse_half_width(1.0 / (centre - lower)) {}
  PROBATION_INLINE static std::int64_t index_of(double scale) {
    std::uint64_t bits;
    std::memcpy(&bits, &scale, sizeof bits);
    const std::uint64_t exponent = bits >> 52U;  // of a negative scale beyond all
    return exponent < 64 || exponent > 1982 ? -1 : static_cast<std::int64_t>(bits >> (52U - cell_bits));
  }
  PROBATION_INLINE bool holds(double scale) const { return lower <= scale && scale < upper; }
  /// t
  PROBATION_INLINE double offset(double scale) const { return (scale - centre) * inverse_half_width; }

 private:
  PROBATION_INLINE static double from_index(std::int64_t index) {
    const std::uint64_t bits = static_cast<std::uint64_t>(index) << (52U - cell_bits);
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

/// The rows of a cell, for all modes: the coefficients of the modes of a vector lie together.
inline void form_cell(const Modes& modes, const ScaleCell& cell, double* rows) {
  static constexpr PowersFromPoints transform;
  constexpr int terms = ScaleTable::terms;
  const double half_width = cell.centre - cell.lower;
  for (int at = 0; at < modes.padded; at += lanes) {
    const Vector q = load(modes.inverse_ratio + at);
    Vector power[terms] = {};
    for (int i = 0; i < terms; ++i) {
      const auto c =
          ExponentialStep::coefficients<Vector>(q * (cell.centre + half_width * transform.point[i]), 1.0);
      const Vector chi = 0.5 * (c.forcing + c.curvature);
      for (int p = 0; p < terms; ++p) power[p] += chi * transform.power[p][i];
    }
    for (int p = 0; p < terms; ++p)
      store(rows + static_cast<std::ptrdiff_t>(at) * terms + std::ptrdiff_t{p} * lanes, power[p]);
  }
}

/// Whether there is a table, and its cells between the lowest and the highest of these scales need no more
/// exponentials than the steps themselves.
inline bool table_pays(const Modes& modes, const double* scale, int count) {
  if (!modes.table || count == 0) return false;
  double lowest = scale[0], highest = scale[0];
  const auto take = [&](double low, double high) {
    lowest = low < lowest ? low : lowest;
    highest = high > highest ? high : highest;
  };
  int n = 0;
  if (count >= lanes) {
    Vector low = load(scale), high = low;
    for (; n + lanes <= count; n += lanes) {
      const Vector here = load(scale + n);
      low = choose(here < low, here, low);
      high = choose(here > high, here, high);
    }
    double lows[lanes], highs[lanes];
    store(lows, low);
    store(highs, high);
    for (int lane = 0; lane < lanes; ++lane) take(lows[lane], highs[lane]);
  }
  for (; n < count; ++n) take(scale[n], scale[n]);
  const std::int64_t first = ScaleCell::index_of(lowest), last = ScaleCell::index_of(highest);
  return first >= 0 && last >= 0 && (last - first + 1) * ScaleTable::terms <= count;
}

/// Consecutive steps and their places in the table, as many as its slots hold together.
struct TabledSteps {
  static constexpr int most = 256;

  int count = 0;                       ///< 0: the table does not pay here
  double lowest = 0.0, highest = 0.0;  ///< scale
  double offset[most];
  const double* rows[most];

  /// The table pays where a cell has as many steps as terms, on average: among these steps, or in the record
  /// (`pays_for_all`). Cells that are already filled do not count: the two ways differ in the last digits,
  /// and an answer must depend on its input alone.
  TabledSteps(const Modes& modes, const double* scale, int available, bool pays_for_all) {
    ScaleTable& kept = *modes.table;
    const auto stride = static_cast<std::ptrdiff_t>(modes.padded) * ScaleTable::terms;
    std::int64_t wanted[ScaleTable::slots];
    for (std::int64_t& cell : wanted) cell = -1;
    int cells = 0, missing = 0;
    lowest = highest = scale[0];
    ScaleCell cell;  // of the step before: mostly of this one, too
    const double* rows_of_cell = nullptr;
    for (; count < available && count < most; ++count) {
      const double here = scale[count];
      if (!cell.holds(here)) {
        const std::int64_t index = ScaleCell::index_of(here);
        if (index < 0) break;
        const int slot = static_cast<int>(index % ScaleTable::slots);
        if (wanted[slot] != index) {
          if (wanted[slot] >= 0) break;
          wanted[slot] = index;
          ++cells;
          if (kept.cell[slot] != index) ++missing;
        }
        cell = ScaleCell(index);
        rows_of_cell = kept.rows + slot * stride;
      }
      offset[count] = cell.offset(here);
      rows[count] = rows_of_cell;
      lowest = here < lowest ? here : lowest;
      highest = here > highest ? here : highest;
    }
    if (!pays_for_all && cells * ScaleTable::terms > count) {
      count = 0;
      return;
    }
    for (int slot = 0; missing > 0 && slot < ScaleTable::slots; ++slot) {
      if (wanted[slot] < 0 || kept.cell[slot] == wanted[slot]) continue;
      form_cell(modes, ScaleCell(wanted[slot]), kept.rows + slot * stride);
      kept.cell[slot] = wanted[slot];
      --missing;
    }
  }
};

/// chi of the modes whose coefficients these are, by the first `terms` of them.
template <int terms = ScaleTable::terms>
PROBATION_INLINE Vector tabled_chi(const double* row, double offset) {
  Vector chi = load(row + std::ptrdiff_t{terms - 1} * lanes);
#pragma GCC unroll 8
  for (int i = terms - 2; i >= 0; --i) chi = chi * offset + load(row + std::ptrdiff_t{i} * lanes);
  return chi;
}

/// How many terms keep the digits of chi for modes up to x: term n is below 2 (x / 64)^n / (n + 2)! of it.
PROBATION_INLINE int terms_of_chi(double x) { return x < 0.3 ? 5 : x < 1.0 ? 6 : ScaleTable::terms; }

}  // namespace probation::kernels::PROBATION_ISA
