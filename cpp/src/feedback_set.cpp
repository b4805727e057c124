#include "feedback_set.hpp"

#include <cmath>

#include "probation/schemes/step.hpp"

namespace probation {
namespace {

/// (1 - e^-a) / a with its slope.
Dual mean_decay_of(Dual a) {
  const double mean = mean_decay(a.value, std::exp(-a.value));
  return {mean, 0.5 * (curvature_decay(a.value, mean) - mean) * a.slope};
}

void multiply(FeedbackFactor<Dual>& total, const FeedbackFactor<Dual>& factor) {
  total.fluidity = total.fluidity * factor.fluidity;
  total.hardening = total.hardening * factor.hardening;
}

FeedbackFactor<double> log_slopes(const FeedbackFactor<Dual>& factor) {
  return {factor.fluidity.slope / factor.fluidity.value, factor.hardening.slope / factor.hardening.value};
}

}  // namespace

FeedbackSet::FeedbackSet(const std::vector<std::shared_ptr<const Feedback>>& feedbacks) {
  for (const auto& feedback : feedbacks) {
    One& one = all_.emplace_back();
    one.feedback = feedback.get();
    one.loss_rate = feedback->loss_rate(Feedback::no_parameter).value;
  }
}

FeedbackFactor<Dual> FeedbackSet::at_start(Dual stress) const { return at_start(stress, Direction{}); }

FeedbackFactor<Dual> FeedbackSet::at_start(Dual stress, const Direction& direction) const {
  FeedbackFactor<Dual> total;
  for (std::size_t k = 0; k < all_.size(); ++k)
    multiply(total, all_[k].feedback->factor(stress, 0.0, moving_parameter(direction, k)));
  return total;
}

void FeedbackSet::enter(double h, double stress_here, double rise, double modulus) {
  stress_here_ = stress_here;
  rise_ = rise;
  compliance_ = modulus > 0.0 ? 1.0 / modulus : 0.0;
  if (h == h_) return;
  h_ = h;
  for (One& one : all_) {
    if (one.loss_rate == 0.0) continue;
    const double loss = one.loss_rate * h;
    one.kept = std::exp(-loss);
    one.taken = mean_decay(loss, one.kept);
  }
}

FeedbackFactor<Dual> FeedbackSet::at(double stress) {
  // plastic_work() with the modulus' inverse at hand
  const double mean_stress = 0.5 * (stress_here_ + stress),
               plastic = rise_ - (stress - stress_here_) * compliance_;
  const Dual work{mean_stress * plastic, 0.5 * plastic - mean_stress * compliance_};
  const auto of = [&](One& one) {
    one.next = {one.kept * one.memory + one.taken * work.value, one.taken * work.slope};
    return one.feedback->factor({stress, 1.0}, one.next, Feedback::no_parameter);
  };
  FeedbackFactor<Dual> total = of(all_[0]);
  for (std::size_t k = 1; k < all_.size(); ++k) multiply(total, of(all_[k]));
  return total;
}

void FeedbackSet::settle(double moved) {
  for (One& one : all_) one.next.value += one.next.slope * moved;
}

void FeedbackSet::leave() {
  for (One& one : all_) one.memory = one.next.value;
}

FeedbackSet::Slopes FeedbackSet::still() const {
  const std::vector<double> none(all_.size(), 0.0);
  return {none, none, {0.0, 0.0}};
}

void FeedbackSet::differentiate(double stress) {
  for (One& one : all_)
    one.by_memory = log_slopes(one.feedback->factor(stress, {one.next.value, 1.0}, Feedback::no_parameter));
}

void FeedbackSet::hold(double stress, Dual work, const Direction& direction, Slopes& slopes) const {
  slopes.log_factor = {0.0, 0.0};
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const One& one = all_[k];
    const std::size_t parameter = moving_parameter(direction, k);
    double& next = slopes.memory_next[k];
    next = one.kept * slopes.memory[k] + one.taken * work.slope;
    FeedbackFactor<double> moved{one.by_memory.fluidity * next, one.by_memory.hardening * next};
    if (parameter != Feedback::no_parameter) {
      const Dual loss = one.feedback->loss_rate(parameter) * h_;
      next += exp(-loss).slope * one.memory + mean_decay_of(loss).slope * work.value;
      moved = log_slopes(one.feedback->factor(stress, {one.next.value, next}, parameter));
    }
    slopes.log_factor.fluidity += moved.fluidity;
    slopes.log_factor.hardening += moved.hardening;
  }
}

void FeedbackSet::release(double moved, Slopes& slopes) const {
  for (std::size_t k = 0; k < all_.size(); ++k)
    slopes.memory[k] = slopes.memory_next[k] + all_[k].next.slope * moved;
}

}  // namespace probation
