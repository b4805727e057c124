// The formulas of schemes/ for many steps at once, in loops without branches, which every compiler can
// vectorise.

#include "kernels/form_steps.hpp"

#include "probation/inline.hpp"
#include "sweeps.hpp"
#include "vector.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// scale = scale_of(m) for every step; whether all are positive.
template <class ScaleOf>
PROBATION_INLINE bool form_scales(long from, long to, double* __restrict scale, ScaleOf scale_of) {
  unsigned not_positive = 0;
  for (long m = from; m < to; ++m) {
    scale[m] = scale_of(m);
    not_positive |= scale[m] > 0.0 ? 0U : 1U;
  }
  return not_positive == 0;
}

/// Where tau_max never changes.
PROBATION_INLINE bool form_steady_scales(const StepSamples& in, long from, long to, double* scale) {
  return form_scales(from, to, scale, [h = in.h, fluidity = *in.end](long m) { return h[m] * fluidity; });
}

PROBATION_INLINE void form_changes(const StepSamples& in, long from, long to, double* __restrict forcing) {
  const double* f = in.integral;
  for (long m = from; m < to; ++m) forcing[m] = f[m + 1] - f[m];
}

/// sa3_step's, which sees the step before.
PROBATION_INLINE void form_curvatures(long from, long to, const double* scale, const double* forcing,
                                      double* __restrict curvature) {
  for (long m = from; m < to; ++m) {
    const double growth = scale[m] / scale[m - 1];
    curvature[m] = bend_weight(growth) * (forcing[m] - forcing[m - 1] * growth);
  }
}

/// Calls body(from, to) for parts that stay in the nearest cache.
template <class Body>
PROBATION_INLINE void in_parts(long count, Body body) {
  constexpr long part = 256;
  for (long from = 0; from < count; from += part) body(from, from + part < count ? from + part : count);
}

}  // namespace

bool form_two_step(const StepSamples& in, const FormedSteps& out) {
  const double *h = in.h, *f = in.integral, *end = in.end, *rate = in.rate;
  double* __restrict ratio = out.ratio, * __restrict forcing = out.forcing;
  bool positive = true;
  in_parts(in.count, [&](long from, long to) {
    for (long m = from; m < to; ++m) {
      ratio[m] = h[m] / h[m - 1];
      forcing[m] = Bdf2Difference(ratio[m])(f[m + 1], f[m], f[m - 1]);
    }
    if (rate)
      for (long m = from; m < to; ++m) forcing[m] += in.modulus * (h[m] * rate[m]);
    positive &= in.begin ? form_scales(from, to, out.scale, [h, end](long m) { return h[m] * end[m]; })
                         : form_steady_scales(in, from, to, out.scale);
  });
  return positive;
}

bool form_straight(const StepSamples& in, const FormedSteps& out) {
  form_changes(in, 0, in.count, out.forcing);
  if (!in.begin) return form_steady_scales(in, 0, in.count, out.scale);
  return form_scales(0, in.count, out.scale, [h = in.h, begin = in.begin, end = in.end](long m) {
    return (0.5 * h[m]) * (begin[m] + end[m]);
  });
}

bool form_parabolic(const StepSamples& in, const FormedSteps& out) {
  const double *h = in.h, *begin = in.begin, *end = in.end;
  // parabolic_reduced_time()
  const auto curved_scale = [h, begin, end](long m) {
    const double ratio = h[m] / h[m - 1];
    const double bend = bend_weight(ratio) * ((end[m] - begin[m]) - ratio * (begin[m] - begin[m - 1]));
    return h[m] * (0.5 * (begin[m] + end[m]) - (1.0 / 6.0) * bend);
  };
  bool positive = true;
  in_parts(in.count, [&](long from, long to) {
    form_changes(in, from, to, out.forcing);
    positive &=
        begin ? form_scales(from, to, out.scale, curved_scale) : form_steady_scales(in, from, to, out.scale);
    form_curvatures(from, to, out.scale, out.forcing, out.curvature);
  });
  return positive;
}

}  // namespace probation::kernels::PROBATION_ISA
