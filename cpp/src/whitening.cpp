#include "probation/whitening.hpp"

#include <string>
#include <utility>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation {
namespace {

Eigen::Index padded(Eigen::Index count, Eigen::Index block) { return (count + block - 1) / block * block; }

}  // namespace

Whitening::Whitening(const Samples& scale, double phi, double theta, Eigen::ArrayXd variance,
                     const Columns& directions, const Samples& shrink)
    : size_(scale.inverse()), variance_(std::move(variance)), phi_(phi), theta_(theta) {
  if (directions.rows() != scale.size() || directions.cols() != shrink.size() || variance_.size() < 1)
    throw InputError("directions has the shape (" + std::to_string(directions.rows()) + ", " +
                     std::to_string(directions.cols()) + "), shrink " + std::to_string(shrink.size()) +
                     " entries and variance " + std::to_string(variance_.size()) + "; expected (" +
                     std::to_string(scale.size()) + ", k), k and at least 1");
  const Eigen::Index count = padded(directions.cols(), kernels::direction_block);
  basis_ = Columns::Zero(directions.rows(), count);
  basis_.leftCols(directions.cols()) = directions;
  shrink_ = Eigen::ArrayXd::Zero(count);
  shrink_.head(shrink.size()) = shrink;
}

Whitening::Columns Whitening::of(const Eigen::Ref<const Columns>& values) const {
  if (values.rows() != size_.size())
    throw InputError("values has " + std::to_string(values.rows()) + " rows; expected " +
                     std::to_string(size_.size()));
  const kernels::ColouredNoise noise{size_.size(),  size_.data(),     phi_,
                                     theta_,        variance_.data(), variance_.size(),
                                     basis_.cols(), basis_.data(),    shrink_.data()};
  const Eigen::Index columns = values.cols();
  const Eigen::Index width = columns == 1 ? 1 : padded(columns, kernels::column_block);
  Eigen::ArrayXd along(width * basis_.cols());
  Columns white(values.rows(), width);
  white.leftCols(columns) = values;
  white.rightCols(width - columns).setZero();
  kernels::best().whiten(noise, white.data(), width, along.data());
  if (width == columns) return white;
  return white.leftCols(columns);
}

}  // namespace probation
