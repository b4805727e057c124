"""The posterior of the parameters without the Laplace approximation, for a sampler."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.inference.record_problem import RecordProblem
from probation.law.schemes import scheme_of
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.records.record import Noise, Record
from probation.results.extras import needed

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.identify.result import Fit

WALKERS, BURN_IN, THIN = 16, 300, 10
"""Of the ensemble: how many, steps that are dropped, and one step kept of so many. Chosen."""


@dataclass(frozen=True, eq=False)
class Posterior:
    r"""Log-posterior of a fit's identified parameters, flat where they are positive.

    The size of each record's noise is integrated out with the prior 1 / size:
    :math:`\ln p = -\tfrac12 \sum_i n_i \ln(r_i^T R_i^{-1} r_i)`, R that of AR(1) noise with the
    correlation of neighbours that the fit has.

    Attributes
    ----------
    fit : Fit
    records : tuple of (RecordProblem, NoiseModel)
    """

    fit: Fit
    records: tuple[tuple[RecordProblem, NoiseModel], ...]

    @classmethod
    def of(cls, fit: Fit) -> Posterior:
        """That of a fit.

        Raises
        ------
        InputError
            Where the noise of the strain weighs the residual, or the fit was read from JSON without curves.
        """
        scheme = scheme_of(fit.scheme, fit.start)
        records = []
        for each in fit.records.values():
            if each.strain_noise_weighed:
                raise InputError(
                    f"sample: found strain noise weighed in {each.id!r}, which method = 'emcee' does not know; "
                    "use method = 'laplace'"
                )
            record = Record(each.id, each.time, each.true_strain, each.true_stress, noise=Noise(each.noise_MPa))
            problem = RecordProblem.prepare(record, each.excitation, scheme, fit.substeps)
            noise = NoiseModel.stationary(each.id, Arma(phi=each.noise_correlation), len(each.time))
            records.append((problem, noise))
        return cls(fit, tuple(records))

    def __call__(self, values: FloatArray) -> float:
        """Ln p at values of the identified parameters, shape (free,); -inf where one is not positive."""
        if not np.all(values > 0.0):
            return -np.inf
        law = self.fit.law
        parameters = law.parameters
        parameters[[law.parameter_names.index(name) for name in self.fit.names]] = values
        there = law.with_parameters(parameters)
        total = 0.0
        for problem, noise in self.records:
            whitened = noise.whiten(problem.residual(there))
            total -= 0.5 * len(whitened) * float(np.log(max(float(whitened @ whitened), 1e-300)))
        return total


def walk(fit: Fit, count: int, seed: int, around: FloatArray) -> FloatArray:
    """Draws by emcee's ensemble sampler, shape (count, free).

    Parameters
    ----------
    fit : Fit
    count, seed : int
    around : ndarray, shape (n_draws, free)
        Draws of the Laplace approximation: where the walkers start.

    Raises
    ------
    InputError
        Where emcee is not installed, or as `Posterior.of`.
    """
    emcee = needed("emcee", "method = 'emcee'")
    posterior = Posterior.of(fit)
    sampler = emcee.EnsembleSampler(len(around), around.shape[1], posterior)
    random = np.random.RandomState(seed)
    state = sampler.run_mcmc(around, BURN_IN, rstate0=random.get_state())
    sampler.reset()
    sampler.run_mcmc(state, -(-count // len(around)) * THIN)
    drawn: FloatArray = sampler.get_chain(flat=True, thin=THIN)
    return drawn[:count]
