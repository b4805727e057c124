#include "identify/record_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace probation {

using Eigen::Index;

void RecordFit::take_data(const Eigen::ArrayXd& true_stress, const Eigen::ArrayXd& noise, Index substeps) {
  const std::vector<Index>& instants = solves.instants();
  every_ = instants[1] < substeps ? substeps : 1;
  const Index n = (solves.size() - 1) / every_ + 1;
  data_.resize(n);
  weight_.resize(noise.size() > 0 ? n : 0);
  // Only ratios matter; a power of two leaves the digits alone.
  const double scale = noise.size() > 0 ? std::exp2(std::floor(std::log2(noise.minCoeff()))) : 1.0;
  for (Index i = 0; i < n; ++i) {
    const Index sample = instants[static_cast<std::size_t>(i * every_)] / substeps;
    data_[i] = true_stress[sample];
    if (weight_.size() > 0) weight_[i] = scale / noise[sample];
  }
  if (weight_.size() > 0) data_ *= weight_;
}

void RecordFit::solve(double log_time) {
  solves.solve(std::exp(log_time));
  u_ = sampled(&solves.u(), sampled_u_);
  v_ = sampled(&solves.v(), sampled_v_);
}

/// At the samples, in units of the noise; `kept` holds it where that is not `solved` itself.
const Eigen::ArrayXd* RecordFit::sampled(const Eigen::ArrayXd* solved, Eigen::ArrayXd& kept) const {
  if (every_ == 1 && weight_.size() == 0) return solved;
  kept = Eigen::Map<const Eigen::ArrayXd, 0, Eigen::InnerStride<>>(solved->data(), data_.size(),
                                                                   Eigen::InnerStride<>(every_));
  if (weight_.size() > 0) kept *= weight_;
  return &kept;
}

void RecordFit::form_residual(FitPoint& point) {
  residual_ = point.unrelaxed_modulus * *u_ + point.hardening_modulus * *v_ - data_;
  point.cost = cost();
}

FitPoint RecordFit::project(double log_time, const Bounds& modulus, const Bounds& hardening) {
  solve(log_time);
  const auto dot = [](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) { return (a * b).sum(); };
  const PairSums sums{dot(*u_, *u_), dot(*u_, *v_), dot(*v_, *v_), dot(*u_, data_), dot(*v_, data_)};
  const PairFit best = fit_pair(sums, modulus, hardening);
  FitPoint point;
  point.log_time = log_time;
  point.unrelaxed_modulus = best.u;
  point.hardening_modulus = best.v;
  point.modulus_free = best.u_free;
  point.hardening_free = best.v_free;
  form_residual(point);
  return point;
}

FitPoint RecordFit::evaluate(double unrelaxed_modulus, double log_time, double hardening_modulus) {
  solve(log_time);
  FitPoint point;
  point.log_time = log_time;
  point.unrelaxed_modulus = unrelaxed_modulus;
  point.hardening_modulus = hardening_modulus;
  form_residual(point);
  return point;
}

void RecordFit::differentiate(FitPoint& point) {
  const Eigen::ArrayXd& slope = solves.slope(point.unrelaxed_modulus, point.hardening_modulus);
  if (sampled(&slope, slope_) == &slope) slope_ = slope;
  const Eigen::ArrayXd* columns[3] = {u_, &slope_, v_};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) point.normal(i, j) = point.normal(j, i) = (*columns[i] * *columns[j]).sum();
    point.gradient[i] = (*columns[i] * residual_).sum();
  }
}

void RecordFit::move(const Eigen::Vector3d& step) {
  residual_ += step[0] * *u_ + step[1] * slope_ + step[2] * *v_;
}

double RecordFit::rms() const {
  const auto n = static_cast<double>(residual_.size());
  if (weight_.size() == 0) return std::sqrt(cost() / n);
  return std::sqrt((residual_ / weight_).square().sum() / n);
}

FreeInverse invert(const Eigen::Matrix3d& normal, const std::array<bool, 3>& free) {
  // What a column adds beyond the others, as a fraction of its square.
  constexpr double nothing_new = 1e-12;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  FreeInverse found;
  int index[3], count = 0;
  for (int i = 0; i < 3; ++i) {
    if (!free[static_cast<std::size_t>(i)]) continue;
    if (normal(i, i) > 0.0)
      index[count++] = i;
    else
      found.determined = false;
  }
  if (count == 0) return found;
  Small scaled(count, count);
  const auto size = [&](int k) { return std::sqrt(normal(index[k], index[k])); };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) scaled(i, j) = normal(index[i], index[j]) / (size(i) * size(j));
  const Eigen::LDLT<Small> factor(scaled);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > nothing_new)) {
    found.determined = false;
    scaled.diagonal().array() += nothing_new;  // a step that stays finite
  }
  const Small inverse = Eigen::LDLT<Small>(scaled).solve(Small::Identity(count, count));
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) found.matrix(index[i], index[j]) = inverse(i, j) / (size(i) * size(j));
  return found;
}

}  // namespace probation
