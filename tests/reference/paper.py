"""Numbers of André et al. and histories that several tests load the law with."""

import numpy as np

E_U, TAU_MAX, G = 3224.0, 5.207, 2.556
"""Experiment 1, Table 1: MPa, s, MPa."""

WEISSENBERG = (0.00464, 0.0367)
"""Eq. (11) as printed."""

TABLE_2 = {5e-5: 419.72, 4e-4: 63.23, 2.5e-3: 11.02, 5e-3: 6.01, 1e-2: 3.21}
"""tau_max [s] by strain rate [1/s]."""


def smooth_strain(t):
    """A strain that goes up in waves: smooth, monotonic, rates between 0.002 and 0.010 1/s."""
    return 0.006 * t + 0.016 * np.sin(0.25 * t + 0.3) - 0.016 * np.sin(0.3)


def smooth_rate(t):
    """Derivative of `smooth_strain`."""
    return 0.006 + 0.004 * np.cos(0.25 * t + 0.3)


def uneven(n, duration, seed=7):
    """n + 1 instants from 0 to duration; two successive steps have a ratio below 2."""
    steps = np.random.default_rng(seed).uniform(0.75, 1.4, n)
    time = np.concatenate([[0.0], np.cumsum(steps)])
    return time * (duration / time[-1])


def halved(time):
    """Every step cut in two."""
    return np.sort(np.concatenate([time, 0.5 * (time[1:] + time[:-1])]))
