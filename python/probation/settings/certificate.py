"""When a parameter is known, a law is intrinsic, and noise is white: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import calibrated, chosen, derived


@dataclass(frozen=True)
class CertificateSettings:
    """When a parameter is known, a law is intrinsic, and noise is white."""

    bias_lengths: tuple[float, float] = chosen(
        (0.02, 0.3), "record", "Correlation lengths of a bias that are averaged over, shortest and longest."
    )
    bias_variances: tuple[float, float] = chosen(
        (1e-3, 1e6), "variance of a block's noise", "Variances of a bias that are tried, least and largest."
    )
    bias_blocks: int = chosen(150, "blocks", "A bias is seen on means over so many blocks of samples.")
    hidden_bias_spread: float = chosen(
        0.3,
        "-",
        "Standard deviation of the logarithm of the bias's amplitude over that of its visible part, beforehand.",
    )
    same_temperature: float = chosen(
        3.0,
        "°C",
        "Records whose mean temperatures differ by more confound temperature with whatever else differs [°C].",
    )
    tolerance: float = chosen(
        0.05,
        "largest stress",
        "Systematic error of a prediction that is let pass, as a fraction of the record's largest stress.",
    )
    significance: float = chosen(
        0.01,
        "probability",
        "Probability of failing some parameter of a law that is intrinsic, over all its parameters.",
    )
    clearly: float = chosen(
        4.0, "standard errors", "Standard errors by which a record's value must miss one that is held to contradict it."
    )
    hardening_from: float = chosen(
        0.4,
        "true strain",
        "True strain from which on the regression is taken, Figure S1.",
        source="André et al., Figure S1",
    )
    own_fault: float = chosen(
        0.5,
        "-",
        "Part of a prediction's error that must stay with parameters of the record's own for the law's form to be "
        "blamed.",
    )
    far: float = chosen(
        0.3,
        "largest stress",
        "Systematic error of a prediction, over the largest stress, from which on it does not matter what else is "
        "shared.",
    )
    identifiable: float = chosen(0.1, "relative standard error", "Largest of an identifiable parameter.")
    weakly_identifiable: float = chosen(0.5, "relative standard error", "Largest of a weakly identifiable parameter.")
    white_enough: float = chosen(
        0.001,
        "probability",
        "Chance below which white innovations would look as correlated as these do (Ljung & Box 1978).",
        source="Ljung & Box 1978",
    )
    bias_window: float = chosen(
        1.0 / 12.0,
        "record",
        "Part of the record over which a parabola takes the low-frequency part: waves of less than six in a record "
        "pass.",
    )
    bias_significant: float = derived(
        4.0,
        "standard deviations",
        "Standard deviations of the smoothed noise that the largest of a record of noise alone hardly reaches.",
        source="largest of a record of white noise",
    )
    white_ratio: float = chosen(
        2.0,
        "-",
        "A residual whose variance at low frequency exceeds the white level by more than this factor is correlated.",
    )
    slow_noise_share: float = calibrated(
        0.25,
        "-",
        "Part of the variance of autocorrelated noise's level at frequency zero that widens standard errors: "
        "parameters weigh higher frequencies, too, whose level is known better.",
        source="coverage of fits with AR(1) noise of 0.5 and 0.8 on ramps of 150 to 600 samples",
    )
    negligible_scheme_shift: float = chosen(
        0.1, "standard errors", "Shift of a parameter by the scheme's own error that is let pass [standard errors]."
    )
    strain_noise_matters: float = chosen(
        0.3,
        "-",
        "Part of a parameter's error that comes from strain noise, over the rest of it, from which on it matters.",
    )
    tolerated_scheme_error: float = chosen(
        2.0,
        "noise",
        "Norm of the scheme's error over the noise, all samples together: its square is what an effect must gain at "
        "least.",
    )
    bias_over_noise: float = chosen(
        2.0, "noise", "Bias of a fit from which on it is reported as a multiple of the noise, not as comparable to it."
    )
    fewest_for_bias: int = chosen(24, "samples", "Samples below which a bias is not looked for.")
    strain_draws: int = chosen(24, "draws", "Draws of the strain noise, of records too long for a matrix of it.")
    most_substeps: int = chosen(
        16, "steps", "Steps of the scheme from sample to sample that a fit takes at most by itself, on long records."
    )
    fewest_for_hardening: int = chosen(3, "samples", "Samples of the regression of hardening.")


CERTIFICATE = CertificateSettings()
