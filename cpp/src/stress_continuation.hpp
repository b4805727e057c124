#pragma once
// Where the stress is thought to be at the end of a step, from the steps before: Newton's first value.

namespace probation {

/// The strain acts through the instantaneous modulus; what remains goes on as a parabola. Noise of the strain
/// is thus not continued.
class StressContinuation {
 public:
  /// Change of the stress over the next step, in which the strain rises by `rise`; ratio = h / h0.
  double change(bool fresh, double ratio, double rise) {
    if (fresh) steps_ = 0;
    const double last = stress_ - modulus_ * rise_, earlier = earlier_stress_ - modulus_ * earlier_rise_;
    double change = modulus_ * rise;
    if (steps_ > 0) change += ratio * last;
    if (steps_ > 1) change += ratio * ratio * (last - ratio_ * earlier);
    next_ratio_ = ratio;
    return change;
  }
  /// The same, as the last step alone has it.
  double straight(bool fresh, double ratio) const { return fresh ? 0.0 : ratio * stress_; }
  /// That step has been solved: its changes, and the instantaneous modulus in it.
  void add(double stress, double rise, double modulus) {
    earlier_stress_ = stress_;
    earlier_rise_ = rise_;
    stress_ = stress;
    rise_ = rise;
    modulus_ = modulus;
    ratio_ = next_ratio_;
    ++steps_;
  }

 private:
  double stress_ = 0.0, rise_ = 0.0, earlier_stress_ = 0.0, earlier_rise_ = 0.0;
  double modulus_ = 0.0, ratio_ = 1.0, next_ratio_ = 1.0;
  int steps_ = 0;  // since the last jump
};

}  // namespace probation
