#pragma once
// Step coefficients as functions of the scale: polynomials, exact to rounding, in narrow cells of the scale.
// A cell is filled when it is first used, and kept from solve to solve.
//
// The other table is kernels/scale_table.hpp, for steps whose scale is known before the sweep over the modes.
// Here the scale is still unknown, and the stress at the end of a step must be a polynomial in it. Therefore
// phi and psi themselves are tabled (formed from chi they would cancel for modes with a large x), for bE2's
// rule too, with one row across all modes per power, in cells that reach from a guess to the solution.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "kernels/kernels.hpp"
#include "modal_group.hpp"

namespace probation {

/// Coefficients of all modes for scales near `centre`, and their sums over the modal weights.
struct CoefficientCell {
  static constexpr std::int64_t none = INT64_MIN;

  std::int64_t index = none;
  std::int64_t block = none;  ///< which block of rows it looks into
  double centre = 0.0, inverse_centre = 0.0;
  kernels::CoefficientRows rows{};
  int quasi_steady = 0;  ///< as in kernels::NearStep
  double by_forcing[kernels::CoefficientRows::terms], by_curvature[kernels::CoefficientRows::terms];

  double distance(double scale) const { return scale * inverse_centre - 1.0; }
};

/// The cells of one rule. In a log-spaced spectrum one row of coefficients serves all scales that differ by
/// the spacing: there they belong to the next mode. Other spectra have rows for each cell.
class CoefficientTable {
 public:
  explicit CoefficientTable(bool exponential) : exponential_(exponential) {}

  /// Discards the rows of other modes.
  void set(const ModalGroup& modes, bool curved);
  /// The cell around a scale; null where the scale is not a positive, finite number. Its rows stay valid
  /// until the call after the next one, which may discard them.
  const CoefficientCell* near(double scale);

 private:
  struct Block {
    std::int64_t first = CoefficientCell::none;  // which entry, or which cell, its rows begin with
    std::vector<double> rows;
  };
  void find_spacing();
  void enter(CoefficientCell& cell);
  void forget_others_of(std::int64_t block, std::int64_t index);
  void fill(std::size_t block, std::int64_t first, double scale);

  bool exponential_, curved_ = false, spaced_ = false;
  ModalGroup modes_;                       // of which the rows are
  double width_ = 0.0;                     // of a cell, in ln scale
  std::int64_t step_ = 1;                  // to the entry that follows as the scale grows by the spacing
  Eigen::Index entries_ = 0;               // in a row
  Eigen::ArrayXd inverse_ratio_, scaled_;  // of the entries; times the scale of the block being filled
  std::vector<Block> blocks_;
  std::vector<double> before_;  // the rows that were discarded last
  std::vector<CoefficientCell> cells_;
  CoefficientCell* last_ = nullptr;
};

}  // namespace probation
