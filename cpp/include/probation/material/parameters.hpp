#pragma once
// Parameters of the material point, and the companion relation that they hold: fixed size, no heap.

#include <cmath>

#include "probation/companion/forms.hpp"
#include "probation/log_spaced.hpp"

namespace probation::material {

constexpr int most_modes = 64;
constexpr int most_table_points = 32;
constexpr double most_decades = 30.0;

/// How tau_max follows the rate; the numbers are those of the list of constants (constants.hpp).
enum class Form { constant = 0, weissenberg = 1, exponential = 2, power = 3, table = 4 };

/// tau_max at one rate, and its slope.
struct Relaxation {
  double tau_max;    ///< [s]
  double log_slope;  ///< d ln tau_max / d ln rate
};

/// The law, eq. (6), and what three dimensions add to it (the bulk modulus).
struct Parameters {
  double unrelaxed_modulus = 0.0;  ///< E_u [MPa]
  double hardening_modulus = 0.0;  ///< G [MPa]
  double bulk_modulus = 0.0;       ///< K [MPa]; not used in one dimension
  Form form = Form::constant;
  double tau_max = 0.0;           ///< [s], where the form is constant
  double alpha = 1.0;             ///< [-], elsewhere: tau_max = alpha form(rate)
  double coefficients[2] = {};    ///< of the form: (slope, intercept) or (coefficient, exponent)
  double rate_floor = 0.0;        ///< [1/s]; the least rate used in the companion relation
  double rate_filter = 0.0;       ///< [-], strain over which the rate is filtered; 0: no filter
  double stress_tolerance = 0.0;  ///< [MPa], of the estimated error of an increment; 0: none
  int modes = 0;
  double relaxation_ratio[most_modes] = {};  ///< tau_j / tau_max [-]
  double modal_weight[most_modes] = {};      ///< p_j [-]
  int table_points = 0;
  double table_rate[most_table_points] = {};     ///< [1/s], increasing
  double table_tau_max[most_table_points] = {};  ///< [s]

  /// The paper's modes; false, and nothing changed, unless 1 <= number <= most_modes and 0 < decades <=
  /// most_decades.
  bool set_log_spaced(int number, double decades) noexcept {
    if (number < 1 || number > most_modes || !(decades > 0.0) || !(decades <= most_decades)) return false;
    modes = number;
    log_spaced_modes(number, decades, relaxation_ratio, modal_weight);
    return true;
  }

  /// tau_max at a rate [1/s] above the floor; not positive where the relation gives no time.
  Relaxation relaxation(double rate) const noexcept {
    switch (form) {
      case Form::weissenberg:
        return scaled(WeissenbergForm{coefficients[0], coefficients[1]}, rate);
      case Form::exponential:
        return scaled(ExponentialForm{coefficients[0], coefficients[1]}, rate);
      case Form::power:
        return scaled(PowerLawForm{coefficients[0], coefficients[1]}, rate);
      case Form::table:
        return scaled(TableForm{table_rate, table_tau_max, table_points}, rate);
      default:
        return {tau_max, 0.0};
    }
  }

 private:
  template <class Formula>
  Relaxation scaled(const Formula& formula, double rate) const noexcept {
    return {alpha * formula.relaxation_time(rate), formula.log_slope(rate)};
  }
};

/// Whether a relaxation time can be used.
inline bool possible_time(double tau_max) noexcept { return tau_max > 0.0 && std::isfinite(tau_max); }

}  // namespace probation::material
