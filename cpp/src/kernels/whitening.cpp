// Whitening: a recursion from sample to sample, then two products with a tall matrix. The columns of a record
// are few and its directions some dozens: libraries for large matrices spend half of their time on copies of
// them.

#include "whitening.hpp"

#include <cmath>

#include "sweeps.hpp"
#include "vector.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// Innovations of unit variance of some columns; T is a number or a vector of them.
template <class T, int some, class Load, class Store>
PROBATION_INLINE void innovations(const ColouredNoise& noise, Load at, Store to) {
  T sample[some] = {}, innovation[some] = {};
  double kept = 0.0;
  std::int64_t i = 0;
  const auto step = [&](double unit) {
    for (int c = 0; c < some; ++c) {
      const T here = at(i, c) * noise.size[i];
      innovation[c] = (here - sample[c] * noise.phi) - innovation[c] * kept;
      sample[c] = here;
      to(i, c, innovation[c] * unit);
    }
  };
  for (; i < noise.settling && i < noise.count; ++i) {
    step(1.0 / std::sqrt(noise.variance[i]));
    kept = noise.theta / noise.variance[i];
  }
  kept = noise.theta;
  for (; i < noise.count; ++i) step(1.0);
}

constexpr std::int64_t wide = column_block / lanes, vectors = direction_block / lanes;

/// Where the entries of a vector begin.
PROBATION_INLINE std::int64_t of_vector(std::int64_t index) { return index * lanes; }

/// The same of one column, or of a block of them.
void innovations_of_one(const ColouredNoise& noise, double* values) {
  innovations<double, 1>(
      noise, [=](std::int64_t i, int) { return values[i]; },
      [=](std::int64_t i, int, double value) { values[i] = value; });
}
void innovations_of_block(const ColouredNoise& noise, double* values, std::int64_t columns) {
  innovations<Vector, wide>(
      noise, [=](std::int64_t i, int c) { return load(values + i * columns + of_vector(c)); },
      [=](std::int64_t i, int c, Vector value) { store(values + i * columns + of_vector(c), value); });
}

/// along = shrink basis^T values, of some columns and a block of directions.
template <int some>
PROBATION_INLINE void project(const ColouredNoise& noise, std::int64_t direction, const double* values,
                              std::int64_t columns, double* along) {
  Vector sums[vectors][some] = {};
  const double* basis = noise.basis + direction;
  for (std::int64_t i = 0; i < noise.count; ++i, basis += noise.directions, values += columns) {
    Vector part[vectors];
    for (int v = 0; v < vectors; ++v) part[v] = load(basis + of_vector(v));
    for (int c = 0; c < some; ++c) {
      const double value = values[c];
      for (int v = 0; v < vectors; ++v) sums[v][c] += part[v] * value;
    }
  }
  for (int v = 0; v < vectors; ++v)
    for (int c = 0; c < some; ++c) {
      double sum[lanes];
      store(sum, sums[v][c]);
      for (int lane = 0; lane < lanes; ++lane) {
        const std::int64_t at = direction + of_vector(v) + lane;
        along[at * columns + c] = noise.shrink[at] * sum[lane];
      }
    }
}

/// values -= basis along, of one column.
void subtract_one(const ColouredNoise& noise, double* values, const double* along) {
  const double* basis = noise.basis;
  for (std::int64_t i = 0; i < noise.count; ++i, basis += noise.directions) {
    Vector sums[vectors] = {};
    for (std::int64_t q = 0; q < noise.directions; q += direction_block)
      for (int v = 0; v < vectors; ++v)
        sums[v] += load(basis + q + of_vector(v)) * load(along + q + of_vector(v));
    for (int v = 1; v < vectors; ++v) sums[0] += sums[v];
    values[i] -= sum(sums[0]);
  }
}

/// The same of `blocks` blocks of columns and of `rows` samples.
template <int rows, int blocks>
PROBATION_INLINE void subtract(const ColouredNoise& noise, const double* basis, double* values,
                               std::int64_t columns, const double* along) {
  Vector sums[rows][blocks * wide] = {};
  for (std::int64_t q = 0; q < noise.directions; ++q, along += columns) {
    Vector part[blocks * wide];
    for (int b = 0; b < blocks * wide; ++b) part[b] = load(along + of_vector(b));
    for (int r = 0; r < rows; ++r)
      for (int b = 0; b < blocks * wide; ++b) sums[r][b] += part[b] * basis[r * noise.directions + q];
  }
  for (int r = 0; r < rows; ++r)
    for (int b = 0; b < blocks * wide; ++b) {
      double* const to = values + r * columns + of_vector(b);
      store(to, load(to) - sums[r][b]);
    }
}

template <int rows>
PROBATION_INLINE void subtract_rows(const ColouredNoise& noise, std::int64_t first, double* values,
                                    std::int64_t columns, const double* along) {
  const double* const basis = noise.basis + first * noise.directions;
  values += first * columns;
  std::int64_t c = 0;
  for (; c + 2 * column_block <= columns; c += 2 * column_block)
    subtract<rows, 2>(noise, basis, values + c, columns, along + c);
  if (c < columns) subtract<rows, 1>(noise, basis, values + c, columns, along + c);
}

}  // namespace

void whiten(const ColouredNoise& noise, double* values, std::int64_t columns, double* along) {
  constexpr int rows = 4;
  if (columns == 1)
    innovations_of_one(noise, values);
  else
    for (std::int64_t c = 0; c < columns; c += column_block) innovations_of_block(noise, values + c, columns);
  for (std::int64_t q = 0; q < noise.directions; q += direction_block) {
    if (columns == 1)
      project<1>(noise, q, values, columns, along);
    else
      for (std::int64_t c = 0; c < columns; c += column_block)
        project<column_block>(noise, q, values + c, columns, along + c);
  }
  if (noise.directions == 0) return;
  if (columns == 1) return subtract_one(noise, values, along);
  std::int64_t i = 0;
  for (; i + rows <= noise.count; i += rows) subtract_rows<rows>(noise, i, values, columns, along);
  for (; i < noise.count; ++i) subtract_rows<1>(noise, i, values, columns, along);
}

}  // namespace probation::kernels::PROBATION_ISA
