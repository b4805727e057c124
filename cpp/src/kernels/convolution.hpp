#pragma once
// A forcing convolved with a response of a few steps.

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

/// Adds sum_k response[k] u[n - k] to stress[n] for K vectors of successive n. Responses that lie a vector of
/// steps apart meet the same samples: these are loaded once.
template <int length, int K>
PROBATION_INLINE void convolve_block(const double* response, const double* u, double* stress) {
  constexpr int groups = length / lanes;
  Vector total[K];
  for (int k = 0; k < K; ++k) total[k] = load(stress + std::ptrdiff_t{k} * lanes);
#pragma GCC unroll 4
  for (int shift = 0; shift < lanes; ++shift) {
    Vector of[groups];
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) of[g] = Vector{} + response[g * lanes + shift];
#pragma GCC unroll 16
    for (int j = 1 - groups; j < K; ++j) {
      const Vector samples = load(u + std::ptrdiff_t{j} * lanes - shift);
#pragma GCC unroll 8
      for (int g = 0; g < groups; ++g)
        if (j + g >= 0 && j + g < K) total[j + g] += of[g] * samples;
    }
  }
  for (int k = 0; k < K; ++k) store(stress + std::ptrdiff_t{k} * lanes, total[k]);
}

/// Adds sum_k response[k] u[n - k], k < length, to stress[n] for n < count. u reaches back by length - 1.
template <int length>
void convolve(const double* response, const double* u, int count, double* stress) {
  constexpr int vectors = 8;
  int n = 0;
  for (; n + vectors * lanes <= count; n += vectors * lanes)
    convolve_block<length, vectors>(response, u + n, stress + n);
  for (; n + lanes <= count; n += lanes) convolve_block<length, 1>(response, u + n, stress + n);
  for (; n < count; ++n)
    for (int k = 0; k < length; ++k) stress[n] += response[k] * u[n - k];
}

}  // namespace probation::kernels::PROBATION_ISA
