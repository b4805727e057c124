#pragma once
// The exact solution for piecewise-linear strain: the oracle for the other schemes.

#include <Eigen/Core>

#include "probation/history.hpp"
#include "probation/law.hpp"

namespace probation {

/// Strain straight and tau_max constant within each step; the hardening is integrated in closed form. Inputs
/// that an effect samples (E_u, hardening factor, added relaxed stress) are taken as straight within the
/// step. `stress` has shape (n_times).
/// @throws InputError  if the change holds a feedback: there is no closed form then
void exact_stress(const Law& law, const LawChange& change, const History& history,
                  Eigen::Ref<Eigen::ArrayXd> stress);

}  // namespace probation
