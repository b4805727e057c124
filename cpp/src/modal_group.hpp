#pragma once
// A group of modes that share a time scale and a forcing, laid out for the kernels.

#include <Eigen/Core>
#include <vector>

#include "kernels/kernels.hpp"

namespace probation {

/// Arrays padded to a multiple of four with modes of weight zero, which stay at zero.
struct ModalGroup {
  Eigen::ArrayXd inverse_ratio, weight, state, before;

  void set(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& weights) {
    const Eigen::Index modes = ratio.size(), padded = (modes + 3) / 4 * 4;
    inverse_ratio.setOnes(padded);
    weight.setZero(padded);
    state.setZero(padded);
    before.setZero(padded);
    inverse_ratio.head(modes) = ratio.inverse();
    weight.head(modes) = weights;
  }
  Eigen::Index padded() const { return weight.size(); }
  bool empty() const { return weight.size() == 0; }
  kernels::Modes view() {
    return {static_cast<int>(padded()), inverse_ratio.data(), weight.data(), state.data(), before.data()};
  }
};

}  // namespace probation
