"""When a parameter is known, a law is intrinsic, and noise is white: the constants."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting


@dataclass(frozen=True)
class CertificateSettings:
    """When a parameter is known, a law is intrinsic, and noise is white."""

    bias_lengths: tuple[float, float] = setting(
        (0.02, 0.3),
        "Correlation lengths of a bias that are averaged over, shortest and longest.",
        unit="record",
        origin="chosen",
        used_in="certificate/bias.py",
    )
    bias_variances: tuple[float, float] = setting(
        (1e-3, 1e6),
        "Variances of a bias that are tried, least and largest.",
        unit="variance of a block's noise",
        origin="chosen",
        used_in="certificate/bias.py",
    )
    bias_blocks: int = setting(
        150,
        "A bias is seen on means over so many blocks of samples.",
        unit="blocks",
        origin="chosen",
        used_in="certificate/bias.py",
    )
    hidden_bias_spread: float = setting(
        0.3,
        ("Standard deviation of the logarithm of the bias's amplitude over that of its visible part, beforehand."),
        unit="-",
        origin="chosen",
        used_in="certificate/bias.py",
    )
    same_temperature: float = setting(
        3.0,
        ("Records whose mean temperatures differ by more confound temperature with whatever else differs [°C]."),
        unit="°C",
        origin="chosen",
        used_in="certificate/certify.py",
    )
    tolerance: float = setting(
        0.05,
        ("Systematic error of a prediction that is let pass, as a fraction of the record's largest stress."),
        unit="largest stress",
        origin="chosen",
        used_in="certificate/certify.py",
    )
    significance: float = setting(
        0.01,
        "Probability of failing some parameter of a law that is intrinsic, over all its parameters.",
        unit="probability",
        origin="chosen",
        used_in="certificate/consistency.py",
    )
    clearly: float = setting(
        4.0,
        "Standard errors by which a record's value must miss one that is held to contradict it.",
        unit="standard errors",
        origin="chosen",
        used_in="certificate/consistency.py",
    )
    hardening_from: float = setting(
        0.4,
        "True strain from which on the regression is taken, Figure S1.",
        unit="true strain",
        origin="chosen",
        source="André et al., Figure S1",
        used_in="certificate/hardening.py",
    )
    own_fault: float = setting(
        0.5,
        (
            "Part of a prediction's error that must stay with parameters of the record's own for the "
            "law's form to be blamed."
        ),
        unit="-",
        origin="chosen",
        used_in="certificate/verdict.py",
    )
    far: float = setting(
        0.3,
        (
            "Systematic error of a prediction, over the largest stress, from which on it does not matter "
            "what else is shared."
        ),
        unit="largest stress",
        origin="chosen",
        used_in="certificate/verdict.py",
    )
    identifiable: float = setting(
        0.1,
        "Largest of an identifiable parameter.",
        unit="relative standard error",
        origin="chosen",
        used_in="inference/parameter.py",
    )
    weakly_identifiable: float = setting(
        0.5,
        "Largest of a weakly identifiable parameter.",
        unit="relative standard error",
        origin="chosen",
        used_in="inference/parameter.py",
    )
    white_enough: float = setting(
        0.001,
        ("Chance below which white innovations would look as correlated as these do (Ljung & Box 1978)."),
        unit="probability",
        origin="chosen",
        source="Ljung & Box 1978",
        used_in="noise/whiteness.py",
    )
    bias_window: float = setting(
        1.0 / 12.0,
        (
            "Part of the record over which a parabola takes the low-frequency part: waves of less than "
            "six in a record pass."
        ),
        unit="record",
        origin="chosen",
        used_in="identify/bias.py",
    )
    bias_significant: float = setting(
        4.0,
        ("Standard deviations of the smoothed noise that the largest of a record of noise alone hardly reaches."),
        unit="standard deviations",
        origin="derived",
        source="largest of a record of white noise",
        used_in="identify/bias.py",
    )
    white_ratio: float = setting(
        2.0,
        ("A residual whose variance at low frequency exceeds the white level by more than this factor is correlated."),
        unit="-",
        origin="chosen",
        used_in="noise/whiteness.py",
    )
    slow_noise_share: float = setting(
        0.25,
        (
            "Part of the variance of autocorrelated noise's level at frequency zero that widens standard errors: "
            "parameters weigh higher frequencies, too, whose level is known better."
        ),
        unit="-",
        origin="calibrated",
        source="coverage of fits with AR(1) noise of 0.5 and 0.8 on ramps of 150 to 600 samples",
        used_in="identify/covariance.py",
    )
    negligible_scheme_shift: float = setting(
        0.1,
        "Shift of a parameter by the scheme's own error that is let pass [standard errors].",
        unit="standard errors",
        origin="chosen",
        used_in="identify/scheme_error.py",
    )
    strain_noise_matters: float = setting(
        0.3,
        ("Part of a parameter's error that comes from strain noise, over the rest of it, from which on it matters."),
        unit="-",
        origin="chosen",
        used_in="identify/errors_by_strain_noise.py",
    )
    tolerated_scheme_error: float = setting(
        2.0,
        (
            "Norm of the scheme's error over the noise, all samples together: its square is what an "
            "effect must gain at least."
        ),
        unit="noise",
        origin="chosen",
        used_in="identify/substeps.py",
    )
    fewest_for_bias: int = setting(
        24,
        "Samples below which a bias is not looked for.",
        unit="samples",
        origin="chosen",
        used_in="identify/bias.py",
    )
    strain_draws: int = setting(
        24,
        "Draws of the strain noise, of records too long for a matrix of it.",
        unit="draws",
        origin="chosen",
        used_in="identify/errors_by_strain_noise.py",
    )
    most_substeps: int = setting(
        16,
        "Steps of the scheme from sample to sample that a fit takes at most by itself, on long records.",
        unit="steps",
        origin="chosen",
        used_in="identify/scheme_error.py",
    )
    fewest_for_hardening: int = setting(
        3,
        "Samples of the regression of hardening.",
        unit="samples",
        origin="chosen",
        used_in="certificate/hardening.py",
    )


CERTIFICATE = CertificateSettings()
