#pragma once
// An array that either varies along the record or holds throughout.

#include <Eigen/Core>

namespace probation {

struct Sampled {
  const double* data = nullptr;
  Eigen::Index stride = 0;
  double otherwise = 0.0;

  Sampled(const Eigen::ArrayXd& samples, double empty)
      : data(samples.size() > 0 ? samples.data() : nullptr),
        stride(samples.size() > 1 ? 1 : 0),
        otherwise(empty) {}

  double operator[](Eigen::Index i) const { return data ? data[i * stride] : otherwise; }
  bool constant() const { return stride == 0; }
};

}  // namespace probation
