#pragma once
// Feedbacks: the relaxation times or the hardening depend on the current stress or the plastic work. Forms
// live in feedback/.

#include <array>
#include <cstddef>
#include <string>

#include "probation/dual.hpp"
#include "probation/errors.hpp"

namespace probation {

/// Factors of a feedback at one instant: of 1 / tau_max (fluidity) and of sigma^r (hardening).
template <class Real>
struct FeedbackFactor {
  Real fluidity{1.0};
  Real hardening{1.0};
};

/// A law coefficient that follows the current stress and one memory, the plastic work w per volume:
///
///   w' = sigma (e' - sigma' / E_u) - loss_rate w.
///
/// With loss_rate 0 it is the plastic work [MPa]; with a positive one, the heat that is left of it.
class Feedback {
 public:
  virtual ~Feedback() = default;

  virtual std::size_t parameters() const noexcept = 0;
  /// Factors at a stress [MPa] and memory [MPa]; slopes are along `parameter` if it is below
  /// parameters().
  virtual FeedbackFactor<Dual> factor(Dual stress, Dual memory, std::size_t parameter) const = 0;
  /// Loss rate of the memory [1/s].
  virtual Dual loss_rate(std::size_t parameter) const = 0;

  static constexpr std::size_t no_parameter = static_cast<std::size_t>(-1);
};

/// A feedback from one formula. `Form` defines, with Values = std::array<Real, parameters> and Real = double
/// or Dual,
///   static constexpr std::size_t parameters;
///   template <class Real> static FeedbackFactor<Real> factor(const Values&, Real stress, Real memory);
///   template <class Real> static Real loss_rate(const Values&);
template <class Form>
class FormulaFeedback : public Feedback {
 public:
  using Values = std::array<double, Form::parameters>;

  explicit FormulaFeedback(const Values& values) : values_(values) {}

  std::size_t parameters() const noexcept override { return Form::parameters; }
  FeedbackFactor<Dual> factor(Dual stress, Dual memory, std::size_t parameter) const override {
    return Form::factor(seeded(parameter), stress, memory);
  }
  Dual loss_rate(std::size_t parameter) const override { return Form::loss_rate(seeded(parameter)); }
  const Values& values() const noexcept { return values_; }

 private:
  std::array<Dual, Form::parameters> seeded(std::size_t parameter) const {
    std::array<Dual, Form::parameters> seeds;
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = {values_[i], i == parameter ? 1.0 : 0.0};
    return seeds;
  }

  Values values_;
};

}  // namespace probation
