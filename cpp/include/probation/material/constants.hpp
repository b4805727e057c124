#pragma once
// The parameters as finite-element codes hand them over: one list of numbers, checked entry by entry.
// Positive: 1e-30 to 1e30. Moduli and stresses: at most 1e12 MPa. Within these ranges nothing overflows.
//
//    1  unrelaxed_modulus  E_u [MPa], not negative
//    2  hardening_modulus  G [MPa], not negative
//    3  bulk_modulus       K [MPa], positive
//    4  form               0 constant, 1 weissenberg, 2 exponential, 3 power, 4 table
//    5  tau_max [s] where the form is constant, else alpha [-]; positive
//    6  slope [-], coefficient [s] or, for a table, its number of points (2 to 32); else 0
//    7  intercept [-] or exponent [-]; else 0. Entries 6 and 7: from -1e30 to 1e30
//    8  rate_floor [1/s], positive; at it the form must give a positive time
//    9  rate_filter [-], a strain, not negative; 0: the companion relation sees the rate itself
//   10  modes              N, 1 to 64
//   11  decades            d, positive, at most 30: log-spaced modes, eqs. (4), (5);
//                          0: N ratios and N weights follow
//   12… where decades is 0:  N ratios tau_j / tau_max, then N weights p_j (0 to 1e6)
//       of a table:          its rates, then its times
// last  stress_tolerance   [MPa], may be left out. Where it is positive, an increment whose estimated error
//                          is larger asks for a smaller increment

#include <cmath>
#include <limits>

#include "probation/material/parameters.hpp"
#include "probation/material/status.hpp"

namespace probation::material {

constexpr int fixed_constants = 11;
constexpr int most_constants = fixed_constants + 2 * most_modes + 2 * most_table_points + 1;
constexpr double least_positive = 1e-30, most_positive = 1e30, most_modulus = 1e12, most_weight = 1e6;

namespace detail {

/// Reads the list entry by entry and remembers the first invalid one.
class ConstantReader {
 public:
  ConstantReader(const double* values, int count) noexcept : values_(values), count_(count) {}

  double finite() noexcept { return next(-most_positive, most_positive); }
  double not_negative(double most) noexcept { return next(0.0, most); }
  double positive(double most = most_positive) noexcept { return next(least_positive, most); }
  int whole(int least, int most) noexcept {
    const double value = next(least, most);
    if (value != std::floor(value)) refuse();
    return bad_ ? least : static_cast<int>(value);
  }
  /// Marks the entry just read as invalid, unless an earlier one is marked.
  void refuse() noexcept {
    if (bad_ == 0) bad_ = read_;
  }
  void refuse(int constant) noexcept {
    if (bad_ == 0) bad_ = constant;
  }
  /// Marks the list as invalid if it has more entries than were read.
  Outcome end() noexcept {
    if (read_ < count_) refuse(read_ + 1);
    return bad_ == 0 ? Outcome{} : Outcome{Status::bad_constant, bad_};
  }
  bool good() const noexcept { return bad_ == 0; }
  bool more() const noexcept { return read_ < count_; }

 private:
  double next(double least, double most) noexcept {
    const double value = read_ < count_ ? values_[read_] : std::numeric_limits<double>::quiet_NaN();
    ++read_;
    const bool inside = value >= least && value <= most;  // no NaN is
    if (!inside) refuse();
    return value;
  }

  const double* values_;
  int count_, read_ = 0, bad_ = 0;
};

}  // namespace detail

/// Fills the parameters from the list. After bad_constant the parameters must not be used.
inline Outcome read_constants(const double* values, int count, Parameters& out) noexcept {
  detail::ConstantReader reader(values, count);
  out.unrelaxed_modulus = reader.not_negative(most_modulus);
  out.hardening_modulus = reader.not_negative(most_modulus);
  out.bulk_modulus = reader.positive(most_modulus);
  out.form = static_cast<Form>(reader.whole(0, 4));
  const double time_or_factor = reader.positive();
  (out.form == Form::constant ? out.tau_max : out.alpha) = time_or_factor;
  const bool table = out.form == Form::table;
  out.table_points = table ? reader.whole(2, most_table_points) : 0;
  out.coefficients[0] = table ? 0.0 : reader.finite();
  out.coefficients[1] = reader.finite();
  out.rate_floor = reader.positive();
  out.rate_filter = reader.not_negative(most_positive);
  out.modes = reader.whole(1, most_modes);
  const double decades = reader.not_negative(most_decades);
  if (!reader.good()) return reader.end();

  if (decades > 0.0) {
    out.set_log_spaced(out.modes, decades);
  } else {
    for (int j = 0; j < out.modes; ++j) out.relaxation_ratio[j] = reader.positive();
    for (int j = 0; j < out.modes; ++j) out.modal_weight[j] = reader.not_negative(most_weight);
  }
  for (int i = 0; i < out.table_points; ++i) {
    out.table_rate[i] = reader.positive();
    if (i > 0 && !(out.table_rate[i] > out.table_rate[i - 1])) reader.refuse();
  }
  for (int i = 0; i < out.table_points; ++i) out.table_tau_max[i] = reader.positive();
  out.stress_tolerance = reader.more() ? reader.not_negative(most_modulus) : 0.0;
  if (reader.good() && !possible_time(out.relaxation(out.rate_floor).tau_max)) reader.refuse(8);
  return reader.end();
}

/// Name of constant k (1 for the first) and the values it may have; `form` is constant 4, or any form where
/// constant 4 is invalid.
struct ConstantText {
  const char* name;
  const char* expected;
};

inline ConstantText constant_text(int constant, Form form) noexcept {
  switch (constant) {
    case 1:
      return {"unrelaxed_modulus", "a modulus from 0 to 1e12 MPa"};
    case 2:
      return {"hardening_modulus", "a modulus from 0 to 1e12 MPa"};
    case 3:
      return {"bulk_modulus", "a positive modulus of at most 1e12 MPa"};
    case 4:
      return {"form", "0 (constant), 1 (weissenberg), 2 (exponential), 3 (power) or 4 (table)"};
    case 5:
      return form == Form::constant ? ConstantText{"tau_max", "a time from 1e-30 to 1e30 s"}
                                    : ConstantText{"alpha", "a number from 1e-30 to 1e30"};
    case 6:
      return form == Form::table         ? ConstantText{"table_points", "a whole number from 2 to 32"}
             : form == Form::weissenberg ? ConstantText{"slope", "a finite number"}
             : form == Form::constant    ? ConstantText{"(unused)", "a finite number, best 0"}
                                         : ConstantText{"coefficient", "a finite number of s"};
    case 7:
      return form == Form::weissenberg ? ConstantText{"intercept", "a finite number"}
             : form == Form::constant || form == Form::table
                 ? ConstantText{"(unused)", "a finite number, best 0"}
                 : ConstantText{"exponent", "a finite number"};
    case 8:
      return {"rate_floor", "a rate from 1e-30 to 1e30 1/s at which the form gives a positive time"};
    case 9:
      return {"rate_filter", "a strain from 0 to 1e30"};
    case 10:
      return {"modes", "a whole number from 1 to 64"};
    case 11:
      return {"decades", "a positive number of at most 30, or 0 where ratios and weights follow"};
    default:
      return {
          "beyond decades",
          "as many ratios (positive) and weights (0 to 1e6) as modes where decades is 0, then as many rates "
          "(increasing) and times (positive) as table_points, then at most one number more, the "
          "stress_tolerance, from 0 to 1e12 MPa"};
  }
}

/// Writes the error message into a text of `capacity` characters, closing zero included; empty if ok.
inline void describe(Outcome outcome, Form form, char* text, int capacity) noexcept {
  if (text == nullptr || capacity < 1) return;
  int length = 0;
  const auto put = [&](const char* words) {
    while (*words != '\0' && length + 1 < capacity) text[length++] = *words++;
  };
  if (outcome.status == Status::cut_step) {
    put("probation: no update at this increment; try a smaller one");
  } else if (outcome.status == Status::bad_constant) {
    char digits[12] = {};
    int first = 11;
    for (int rest = outcome.constant; rest > 0 && first > 0; rest /= 10)
      digits[--first] = static_cast<char>('0' + rest % 10);
    const ConstantText known = constant_text(outcome.constant, form);
    put("probation: constant ");
    put(digits + first);
    put(" (");
    put(known.name);
    put(") must be ");
    put(known.expected);
  } else if (outcome.status == Status::short_state) {
    put("probation: too few state variables: 10 + 6 modes are needed (3 + modes in one dimension)");
  } else if (outcome.status == Status::no_element) {
    put("probation: this element is not offered: use solid, plane strain, axisymmetric or truss elements");
  }
  text[length] = '\0';
}

}  // namespace probation::material
