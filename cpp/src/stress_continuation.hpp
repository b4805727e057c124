#pragma once
// Prediction of the stress at the end of a step from the steps before: the first value of Newton's iteration.

namespace probation {

/// The instantaneous modulus times the change of strain, and a cubic extrapolation of the rest: so noise of
/// the strain is not extrapolated.
class StressContinuation {
 public:
  /// Change of the stress over the next step of length h, in which the strain rises by `rise`.
  double change(bool fresh, double h, double rise) {
    if (fresh) steps_ = 0;
    next_h_ = h;
    double change = modulus_ * rise;
    if (steps_ == 0) return change;
    // Newton's divided differences of what remains.
    const double slope = last_.rest_rate(modulus_);
    double bend = 0.0, twist = 0.0;
    if (steps_ > 1) {
      const double slope2 = second_.rest_rate(modulus_);
      bend = (slope - slope2) * inverse_of_two_;
      if (steps_ > 2)
        twist = (bend - (slope2 - third_.rest_rate(modulus_)) * inverse_of_two_before_) * inverse_of_three_;
    }
    return change + h * (slope + (h + last_.h) * (bend + (h + last_.h + second_.h) * twist));
  }
  /// The same by linear extrapolation of the last step.
  double straight(bool fresh) const { return fresh ? 0.0 : next_h_ * last_.inverse_h * last_.stress; }
  /// That step has been solved: its changes, and the instantaneous modulus in it.
  void add(double stress, double rise, double modulus) {
    third_ = second_;
    second_ = last_;
    last_ = {stress, rise, next_h_, next_h_ == second_.h ? second_.inverse_h : 1.0 / next_h_};
    modulus_ = modulus;
    ++steps_;
    if (last_.h == second_.h && second_.h == third_.h && inverse_of_two_ == inverse_of_two_before_) return;
    inverse_of_two_before_ = inverse_of_two_;
    inverse_of_two_ = 1.0 / (last_.h + second_.h);
    inverse_of_three_ = 1.0 / (last_.h + second_.h + third_.h);
  }

 private:
  /// Changes over a step.
  struct Step {
    double stress = 0.0, rise = 0.0, h = 0.0, inverse_h = 0.0;
    double rest_rate(double modulus) const { return (stress - modulus * rise) * inverse_h; }
  };
  Step last_, second_, third_;
  double inverse_of_two_ = 0.0, inverse_of_two_before_ = 0.0, inverse_of_three_ = 0.0;  // lengths of steps
  double modulus_ = 0.0, next_h_ = 0.0;
  int steps_ = 0;  // since the last jump
};

}  // namespace probation
