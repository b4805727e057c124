"""The posterior of the parameters without the Laplace approximation, for a sampler."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError
from probation.inference.likelihood import log_likelihood
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.inference.residual_noise import with_residual_noise
from probation.records.record import Noise, Record
from probation.results.extras import needed
from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.identify.record_fit import RecordFit
    from probation.law.modal import Law
    from probation.law.schemes import Scheme


@dataclass(frozen=True, eq=False)
class Posterior:
    """Log-posterior of a fit's identified parameters, flat where they are positive.

    The size of each record's noise is integrated out with the prior 1 / size; its shape (correlation, growth along the
    record) is what the fit found it to be.
    """

    problem: Problem

    @classmethod
    def of(
        cls,
        law: Law,
        names: Sequence[str],
        records: Iterable[RecordFit],
        weighting: str,
        *,
        scheme: Scheme,
        substeps: int,
    ) -> Posterior:
        """That of a fit, from what `Fit` has under these names.

        Raises
        ------
        InputError
            Where the noise of the strain weighs the residual, or the fit was read from JSON without curves.
        """
        views = []
        for record_fit in records:
            if record_fit.strain_noise_weighed:
                raise InputError(
                    f"sample: found strain noise weighed in {record_fit.id!r}, which method = 'emcee' does not know; "
                    "use method = 'laplace'"
                )
            record = Record(
                record_fit.id,
                record_fit.time,
                record_fit.true_strain,
                record_fit.true_stress,
                noise=Noise(record_fit.noise_MPa),
            )
            views.append(measured_view(record, record_fit.excitation, scheme, substeps))
        identified = DnlrLaw(law, [name for name in law.parameter_names if name not in names])
        problem = Problem.white(identified, views)
        if weighting in ("autocorrelated", "varying"):
            problem = with_residual_noise(problem, identified.start, [None] * len(views))
        return cls(problem)

    def __call__(self, values: FloatArray) -> float:
        """Ln p at values of the identified parameters, shape (free,); -inf where one is not positive."""
        return log_likelihood(self.problem, values) if np.all(values > 0.0) else -np.inf


def walk(posterior: Posterior, count: int, seed: int, around: FloatArray) -> FloatArray:
    """Draws by emcee's ensemble sampler, shape (count, free).

    Parameters
    ----------
    around : ndarray, shape (n_draws, free)
        Draws of the Laplace approximation: where the walkers start.

    Raises
    ------
    InputError
        Where emcee is not installed.
    """
    emcee = needed("emcee", "method = 'emcee'")
    sampler = emcee.EnsembleSampler(len(around), around.shape[1], posterior)
    random = np.random.RandomState(seed)
    state = sampler.run_mcmc(around, IDENTIFICATION.burn_in, rstate0=random.get_state())
    sampler.reset()
    sampler.run_mcmc(state, -(-count // len(around)) * IDENTIFICATION.thinned)
    drawn: FloatArray = sampler.get_chain(flat=True, thin=IDENTIFICATION.thinned)
    return drawn[:count]
