#ifndef PROBATION_H
#define PROBATION_H
/* Plain C interface of the material point: for ctypes, felupe and your own codes. It allocates nothing and
   keeps no state, so that several threads may call it. Stresses in MPa, times in s.

   `constants` is the list of probation/material/constants.hpp. Deformation gradients are row by row, F[3 i +
   J]; symmetric tensors 11, 22, 33, 12, 13, 23. States are zero at the start; `before` and `after` may be the
   same.

   Where there is no update (any status but OK and COARSE_STEP), nothing is written; of many points, nothing
   in `before`. COARSE_STEP comes only with a stress_tolerance among the constants: the update is made and
   written, but its estimated error is larger. Who wants to repeat it with a smaller increment needs `before`
   apart from `after`. */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  PROBATION_OK = 0,
  PROBATION_CUT_STEP = 1,     /* no update at this increment: try a smaller one */
  PROBATION_BAD_CONSTANT = 2, /* probation_message says which */
  PROBATION_SHORT_STATE = 3,
  PROBATION_COARSE_STEP = 5 /* made, but with an error above the stress_tolerance */
};

/* Status of a list of constants; a text closed by a zero, empty if all is well, goes into message (may be
 * NULL). */
int probation_message(const double* constants, int count, char* message, int capacity);

/* State variables of one point, in three dimensions and in one; 0 if the constants are invalid. */
int probation_state_size(const double* constants, int count);
int probation_uniaxial_state_size(const double* constants, int count);

/* One increment of true strain; tangent = d true_stress / d strain_increment. */
int probation_uniaxial(const double* constants, int count, double strain_increment, double dt,
                       const double* before, double* after, double* true_stress, double* tangent);

/* One increment to F: second Piola-Kirchhoff stress [6], dS/dE [36] row by row (or NULL). */
int probation_second_piola(const double* constants, int count, const double* deformation_gradient, double dt,
                           const double* before, double* after, double* stress, double* tangent);

/* The same: Cauchy stress [6] and Jaumann tangent [36], as a UMAT gives them. */
int probation_cauchy(const double* constants, int count, const double* deformation_gradient, double dt,
                     const double* before, double* after, double* stress, double* tangent);

/* First Piola-Kirchhoff stress [9] and dP/dF [81] (or NULL) of many points, one after the other in every
   array. Stops at the first point that fails; *failed (may be NULL) is its index, or that of the first coarse
   one, else -1. */
int probation_first_piola(const double* constants, int count, int points, const double* deformation_gradients,
                          double dt, const double* before, double* after, double* stress, double* tangent,
                          int* failed);

#ifdef __cplusplus
}
#endif
#endif
