#pragma once
// Creep and other stress-driven tests: the stress is imposed, the strain is found.

#include <Eigen/Core>

#include "probation/history.hpp"
#include "probation/law.hpp"
#include "probation/schemes/forcing.hpp"

namespace probation {

/// True strain [-] under an imposed true stress, by bE2: bE2 along this strain gives the stress back.
///
/// The specimen is relaxed and unloaded before time[0]; true_stress[0] is applied at once, so that the strain
/// starts at true_stress[0] / E_u. Where a companion relation makes the flow stress fall with the rate,
/// several strains can carry one stress: the one that continues the strain so far is taken.
/// @param time         [s], increasing; shape (n_times)
/// @param true_stress  [MPa]; shape (n_times)
/// @param jumps        instants at which the stress rate jumps
/// @throws InputError        for a feedback in the change, or E_u = 0
/// @throws ConvergenceError  where no strain carries the stress, with the time
Eigen::ArrayXd creep_strain(const Law& law, const LawChange& change, const Samples& time,
                            const Samples& true_stress, const History::Indices& jumps, Start start);

}  // namespace probation
