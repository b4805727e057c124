#pragma once
// A group of modes that share a time scale and a forcing, laid out for the kernels.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"
#include "probation/law.hpp"

namespace probation {

/// The memory of a ScaleTable, allocated when it is first needed. A copy starts empty.
class OwnScaleTable {
 public:
  OwnScaleTable() = default;
  OwnScaleTable(const OwnScaleTable&) {}
  OwnScaleTable& operator=(const OwnScaleTable&) {
    forget();
    return *this;
  }

  void forget() { table_.rows = nullptr; }

  /// Null for so many modes that a table would not stay in the cache.
  kernels::ScaleTable* get(Eigen::Index padded) {
    constexpr Eigen::Index most_modes = 512, line = 8;  // a line of the cache holds eight numbers
    if (padded > most_modes) return nullptr;
    if (!table_.rows) {
      memory_.resize(Eigen::Index{kernels::ScaleTable::slots} * kernels::ScaleTable::terms * padded + line);
      const auto beyond = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(double) % line;
      table_.rows = memory_.data() + (line - static_cast<Eigen::Index>(beyond));
      std::fill(std::begin(table_.cell), std::end(table_.cell), -1);
    }
    return &table_;
  }

 private:
  kernels::ScaleTable table_{};
  Eigen::ArrayXd memory_;
};

/// Arrays padded to a multiple of four with modes of weight zero, which stay at zero.
struct ModalGroup {
  Eigen::ArrayXd inverse_ratio, weight, state, before;
  OwnScaleTable table;

  /// Sets the modes, with states of zero.
  void set(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& weights) {
    const Eigen::Index modes = ratio.size(), padded = (modes + 3) / 4 * 4;
    if (!same(ratio_, ratio)) {
      ratio_ = ratio;
      inverse_ratio.setOnes(padded);
      inverse_ratio.head(modes) = ratio.inverse();
      table.forget();
    }
    weight.setZero(padded);
    state.setZero(padded);
    before.setZero(padded);
    weight.head(modes) = weights;
  }
  /// Whether it has these modes already.
  bool holds(const Spectrum& spectrum) const {
    const Eigen::Index modes = ratio_.size();
    return modes > 0 && modes == spectrum.modal_weight.size() && same(ratio_, spectrum.relaxation_ratio) &&
           same(weight.head(modes), spectrum.modal_weight);
  }
  Eigen::Index padded() const { return weight.size(); }
  bool empty() const { return weight.size() == 0; }
  /// From z_j = p_j y_j at the start to the unit-weight states y_j of the tangents; a mode of weight 0 has
  /// `weightless`.
  void to_unit_weight(double weightless) {
    for (Eigen::Index j = 0; j < padded(); ++j) {
      if (weight[j] == 0.0 && state[j] != 0.0) throw_weightless(j);
      state[j] = weight[j] == 0.0 ? weightless : state[j] / weight[j];
    }
  }
  /// Derivatives of the unit-weight states at the start: y_j = sigma_j(0) / p_j - sigma^r(0), or zero if
  /// relaxed.
  void start_slope(const LawChange& change, const Direction& direction, double relaxed, double d_relaxed,
                   Eigen::ArrayXd& slope) const {
    slope.setZero(padded());
    const bool given = change.initial_modal_stress.size() > 0,
               moved = direction.initial_modal_stress.size() > 0;
    if (!given && !moved) return;
    const Eigen::Index modes =
        given ? change.initial_modal_stress.size() : direction.initial_modal_stress.size();
    for (Eigen::Index j = 0; j < modes; ++j) {
      const double start = moved ? direction.initial_modal_stress[j] : 0.0;
      if (weight[j] == 0.0 && start != 0.0) throw_weightless(j);
      if (weight[j] != 0.0) slope[j] = start / weight[j];
      if (!given) continue;  // the relaxed part follows weights and relaxed stress by itself
      if (weight[j] != 0.0 && direction.modal_weight.size() > 0)
        slope[j] -= (state[j] + relaxed) * direction.modal_weight[j] / weight[j];
      slope[j] -= d_relaxed;
    }
  }
  /// One number per mode (or none) at the length of the kernels' arrays.
  Eigen::ArrayXd pad(const Eigen::ArrayXd& per_mode) const {
    if (per_mode.size() == 0) return {};
    Eigen::ArrayXd full = Eigen::ArrayXd::Zero(padded());
    full.head(per_mode.size()) = per_mode;
    return full;
  }
  kernels::Modes view() {
    return {static_cast<int>(padded()), inverse_ratio.data(), weight.data(), state.data(), before.data()};
  }
  /// The same for uneven steps by the exponential rule.
  kernels::Modes view_with_table() {
    kernels::Modes modes = view();
    modes.table = table.get(padded());
    return modes;
  }

 private:
  Eigen::ArrayXd ratio_;  ///< tau_j / tau_max, not padded

  /// To the last bit.
  static bool same(const Eigen::Ref<const Eigen::ArrayXd>& one, const Eigen::ArrayXd& other) {
    if (one.size() != other.size()) return false;
    const auto bytes = static_cast<std::size_t>(one.size()) * sizeof(double);
    return bytes == 0 || std::memcmp(one.data(), other.data(), bytes) == 0;
  }
  [[noreturn]] static void throw_weightless(Eigen::Index j) {
    throw InputError("initial_modal_stress[" + std::to_string(j) +
                     "] is not relaxed in a mode of weight 0; no tangent there");
  }
};

}  // namespace probation
