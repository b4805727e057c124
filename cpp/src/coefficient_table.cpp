#include "coefficient_table.hpp"

#include <algorithm>
#include <cmath>

namespace probation {
namespace {

using Eigen::Index;
using std::int64_t;

constexpr int terms = kernels::CoefficientRows::terms;
constexpr double widest_cell = 6e-3;     // in ln scale
constexpr double span_of_scales = 12.0;  // in ln scale: what a block of a log-spaced spectrum serves at least
constexpr double same_spacing = 1e-14;   // relative
constexpr int64_t most_blocks = 512, cells_kept = 1024;
constexpr double most_spare = 4096.0;  // entries beside the modes
constexpr double most_numbers = 1e6;   // in all blocks
constexpr double usable = 1e100;
constexpr double forgotten = 37.0;  // e^-x is below rounding

int64_t floor_of_quotient(int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

void CoefficientTable::set(const ModalGroup& modes, bool curved) {
  const bool same = curved == curved_ && modes.padded() == modes_.padded() &&
                    (modes.inverse_ratio == modes_.inverse_ratio).all() &&
                    (modes.weight == modes_.weight).all();
  if (same && !cells_.empty()) return;
  curved_ = curved;
  modes_ = modes;
  find_spacing();
  cells_.assign(static_cast<std::size_t>(cells_kept), {});
  last_ = nullptr;
}

void CoefficientTable::find_spacing() {
  // Modes that only pad the rows do not count.
  const Eigen::ArrayXd& inverse = modes_.inverse_ratio;
  Index modes = modes_.padded();
  while (modes > 1 && modes_.weight[modes - 1] == 0.0) --modes;
  const double spacing =
      modes > 1 ? std::log(inverse[modes - 1] / inverse[0]) / static_cast<double>(modes - 1) : 0.0;
  const auto blocks = static_cast<int64_t>(std::ceil(std::abs(spacing) / widest_cell));
  const auto grown = [&](Index entry) { return inverse[0] * std::exp(static_cast<double>(entry) * spacing); };
  spaced_ = blocks > 0 && blocks <= most_blocks && span_of_scales <= most_spare * std::abs(spacing);
  for (Index j = 0; j < modes && spaced_; ++j)
    spaced_ = std::abs(grown(j) / inverse[j] - 1.0) <= same_spacing;

  entries_ = modes_.padded();
  if (spaced_) entries_ += static_cast<Index>(std::ceil(span_of_scales / std::abs(spacing) / 4.0)) * 4;
  inverse_ratio_ = inverse;
  if (spaced_) {
    inverse_ratio_.resize(entries_);
    for (Index entry = 0; entry < entries_; ++entry) inverse_ratio_[entry] = grown(entry);
  }
  width_ = spaced_ ? std::abs(spacing) / static_cast<double>(blocks) : widest_cell;
  step_ = spacing < 0.0 ? -1 : 1;
  const double room = most_numbers / (2.0 * terms * static_cast<double>(entries_));
  blocks_.assign(static_cast<std::size_t>(
                     spaced_ ? blocks : std::clamp(static_cast<int64_t>(room), int64_t{1}, most_blocks)),
                 {});
}

const CoefficientCell* CoefficientTable::near(double scale) {
  if (last_ && std::abs(last_->distance(scale)) <= 0.5 * width_) return last_;
  const bool of_use = scale > 1.0 / usable && scale < usable;
  if (!of_use) return nullptr;
  const auto index = static_cast<int64_t>(std::floor(std::log(scale) / width_ + 0.5));
  CoefficientCell& cell = cells_[static_cast<std::size_t>(index) % static_cast<std::size_t>(cells_kept)];
  if (cell.index != index) {
    cell.index = index;
    enter(cell);
  }
  last_ = &cell;
  return last_;
}

void CoefficientTable::enter(CoefficientCell& cell) {
  const auto count = static_cast<int64_t>(blocks_.size());
  const int64_t turns = floor_of_quotient(cell.index, count), phase = cell.index - turns * count;
  const auto block = static_cast<std::size_t>(phase);
  cell.block = phase;
  cell.centre = std::exp(static_cast<double>(cell.index) * width_);
  cell.inverse_centre = 1.0 / cell.centre;

  // Mode j has entry j + step * turns of an endless row; the block holds it from `first` on.
  const int64_t wanted = spaced_ ? step_ * turns : cell.index;
  const int64_t first = blocks_[block].first, spare = entries_ - modes_.padded();
  int64_t skipped = spare / 2;
  if (first != CoefficientCell::none && first <= wanted && wanted <= first + spare) {
    skipped = wanted - first;
  } else {
    const int64_t shift = wanted - skipped;
    const int64_t turned = spaced_ ? phase + step_ * shift * count : cell.index;
    fill(block, shift, std::exp(static_cast<double>(turned) * width_));
    if (first != CoefficientCell::none) forget_others_of(phase, cell.index);
  }
  const double* rows = blocks_[block].rows.data() + skipped;
  cell.rows = {rows, curved_ ? rows + terms * entries_ : nullptr, static_cast<long>(entries_)};
  cell.quasi_steady = 0;
  const double least = forgotten / (cell.centre * (1.0 - kernels::CoefficientRows::reach));
  while (exponential_ && cell.quasi_steady < modes_.padded() &&
         (modes_.inverse_ratio.segment<4>(cell.quasi_steady) >= least).all())
    cell.quasi_steady += 4;
  kernels::best().weigh_rows(modes_.view(), cell.rows, cell.by_forcing, cell.by_curvature);
}

void CoefficientTable::forget_others_of(int64_t block, int64_t index) {
  for (CoefficientCell& other : cells_)
    if (other.block == block && other.index != index) other.index = CoefficientCell::none;
}

void CoefficientTable::fill(std::size_t block, int64_t first, double scale) {
  Block& one = blocks_[block];
  one.first = first;
  one.rows.swap(before_);
  one.rows.resize(static_cast<std::size_t>(entries_ * terms * (curved_ ? 2 : 1)));
  scaled_ = inverse_ratio_ * scale;
  double* rows = one.rows.data();
  kernels::best().fill_rows(exponential_, static_cast<long>(entries_), scaled_.data(), rows,
                            curved_ ? rows + terms * entries_ : nullptr, static_cast<long>(entries_));
}

}  // namespace probation
