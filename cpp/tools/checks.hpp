#pragma once
// Checks of a material point: each gives one number that must stay within a limit.

#include "probation/material/parameters.hpp"

namespace probation::tools {

using material::Parameters;

/// The three-dimensional stress against the one-dimensional one in incompressible tension, over the largest
/// stress.
double three_against_one_dimension(const Parameters& parameters);
/// The one-dimensional stress against the engine's SA2 on the same piecewise-linear history, over the largest
/// stress.
double one_dimension_against_engine(const Parameters& parameters);
/// Tangents against differences of the stress, over the largest of E_u, G, and a hundredth of K.
double uniaxial_tangent_error(const Parameters& parameters);
double tangent_error(const Parameters& parameters);
double jaumann_tangent_error(const Parameters& parameters);
double first_piola_tangent_error(const Parameters& parameters);
/// Cauchy stress under a rotation that goes along with the path, turned back, against no rotation; over the
/// largest.
double objectivity_error(const Parameters& parameters);
/// Order in the increment's length on a smooth path of variable rate.
double uniaxial_time_order(const Parameters& parameters);
double time_order(const Parameters& parameters);
/// Microseconds of one three-dimensional update.
double update_cost(const Parameters& parameters, bool with_tangent);

}  // namespace probation::tools
