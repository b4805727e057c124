"""Which speed targets are met?

REQUIRED is what the engine must reach; GOALS is the full target table, reached row by row later.
"""

from collections.abc import Callable
from dataclasses import dataclass

from bench.rows import Findings

Value = Callable[[Findings], float | None]
Words = Callable[[Findings], str]


@dataclass(frozen=True)
class Target:
    """`value` is compared with `limit`; None means that this run has no such number."""

    item: str
    value: Value
    limit: float
    at_least: bool = True
    unit: str = "x"
    limited_by: Words | None = None  # what keeps it from more, with this run's own measurement

    def met(self, found: Findings) -> bool | None:
        value = self.value(found)
        if value is None:
            return None
        return value >= self.limit if self.at_least else value <= self.limit


def _faster(fast: str, slow: str, case: str = "ramp") -> Value:
    return lambda found: found.ratio("forward", slow, fast, case)


def _ratio(section: str, method: str, other: str, case: str | None = None) -> Value:
    return lambda found: found.ratio(section, method, other, case)


def _median(section: str, method: str, scale: float) -> Value:
    def value(found: Findings) -> float | None:
        row = found.find(section, method)
        return None if row is None else row.median * scale

    return value


def _identified(slow: str, fast: str) -> Value:
    return _ratio("identification", slow, fast)


def _sa3_error(found: Findings) -> float | None:
    row = found.find("forward", "sa3", "ramp")
    return None if row is None else row.error


def _reused(found: Findings) -> float | None:
    """How many times as long a batch takes that makes its output anew."""
    ratio = found.ratio("batch", "new output", "one thread")
    return None if ratio is None else 1 / ratio


def _fraction_of_limit(scheme: str, limit: str = "limit") -> Words:
    """How much faster it would be if it did nothing but its multiply-adds."""

    def words(found: Findings) -> str:
        ratio = found.ratio("limit", scheme, limit)
        if ratio is None:
            return ""
        quasi_steady = ", quasi-steady fast modes" if limit == "quasi-steady limit" else ""
        return f"{1 / ratio:.0%} of the FMA limit{quasi_steady}: multiply-adds alone would be {ratio:.2f} times as fast"

    return words


def _parts_of_a_call(found: Findings) -> str:
    """Where the time goes that law.stress takes beside the compiled call."""
    parts = {"history": "history", "e_HT": "e_HT, in it", "law, one step": "any length (a call of one step)"}
    rows = {words: found.find("overhead", key) for key, words in parts.items()}
    return ", ".join(f"{words} {row.median * 1e6:.2g} µs" for words, row in rows.items() if row is not None)


def _reuse_words(found: Findings) -> str:
    row = found.find("batch", "new output")
    return "" if row is None else f"a new output takes {row.median * 1e3:.0f} ms: first touch of its memory"


REQUIRED = (
    Target("bE2 faster than numba, eq. (9) as printed", _faster("be2", "numba_be2"), 5),
    Target("bE2 faster than scipy BDF", _faster("be2", "scipy_bdf"), 400),
)

GOALS = (
    Target("bE2 faster than numba, eq. (9) as printed", _faster("be2", "numba_be2"), 20),
    Target(
        "bE2 faster than numba fastmath",
        _faster("be2", "numba_be2_fastmath"),
        2.5,
        limited_by=_fraction_of_limit("be2"),
    ),
    Target("bE2 faster than numpy (precomputed)", _faster("be2", "numpy_be2"), 250),
    Target("bE2 faster than scipy BDF", _faster("be2", "scipy_bdf"), 1700),
    Target("bE2 faster than scipy LSODA", _faster("be2", "scipy_lsoda"), 400),
    Target("bE2 faster than CVODE in C", _faster("be2", "cvode_c"), 150),
    Target(
        "SA3 faster than numba fastmath bE2",
        _faster("sa3", "numba_be2_fastmath"),
        5,
        limited_by=_fraction_of_limit("sa3", "quasi-steady limit"),
    ),
    Target("SA3 faster than lfilter SA2", _faster("sa3", "lfilter_sa2"), 100),
    Target("SA3 faster than CVODE in C", _faster("sa3", "cvode_c"), 330),
    Target("SA3's largest error", _sa3_error, 2e-7, at_least=False, unit=" MPa"),
    Target(
        "bE2 over its FMA limit",
        _ratio("limit", "be2", "limit"),
        1.6,
        at_least=False,
        limited_by=_fraction_of_limit("be2"),
    ),
    Target(
        "SA3 over its FMA limit, no quasi-steady mode",
        _ratio("limit", "sa3", "limit"),
        1.7,
        at_least=False,
        limited_by=_fraction_of_limit("sa3", "quasi-steady limit"),
    ),
    Target("uneven steps: bE2 faster than numba bE2", _faster("be2", "numba_be2_variable", "uneven ramp"), 4),
    Target("uneven steps: SA3 faster than numba SA2", _faster("sa3", "numba_sa2_variable", "uneven ramp"), 13),
    Target(
        "bE2 by the kernels for any x86-64", _median("overhead", "be2_baseline", 1e6), 60, at_least=False, unit=" µs"
    ),
    Target("bE2, tau_max by rate over constant", _ratio("forward", "be2", "beside", "grips"), 2.5, at_least=False),
    Target("SA3, tau_max by rate over constant", _ratio("forward", "sa3", "beside", "grips"), 2.5, at_least=False),
    *(
        Target(
            f"{name}, {words} over the base law",
            _ratio("feedbacks", f"{scheme}, {key}", "beside", "ramp"),
            4,
            at_least=False,
        )
        for scheme, name in (("be2", "bE2"), ("sa3", "SA3"))
        for key, words in (("stress activation", "flow by stress"), ("self-heating", "self-heating"))
    ),
    Target("bE2, three sensitivities over a solve", _ratio("sensitivities", "be2", "beside"), 4.5, at_least=False),
    Target("SA3, three sensitivities over a solve", _ratio("sensitivities", "sa3", "beside"), 4.5, at_least=False),
    Target("10^4 solves as a batch, SA3, CPU", _median("batch", "sa3", 1e3), 90, at_least=False, unit=" ms"),
    Target("10^4 solves as a batch, two threads over one", _ratio("batch", "2 threads", "one thread"), 1.8),
    Target("10^4 solves as a batch, gain of a reused output", _reused, 1, limited_by=_reuse_words),
    Target("variable projection faster than scipy on numpy", _identified("numpy", "variable-projection"), 800),
    Target("variable projection faster than scipy on numba", _identified("numba", "variable-projection"), 25),
    Target("Levenberg-Marquardt faster than scipy on numpy", _identified("numpy", "levenberg-marquardt"), 350),
    Target("Levenberg-Marquardt faster than scipy on numba", _identified("numba", "levenberg-marquardt"), 12),
    Target("compiled call with out=", _median("overhead", "one step", 1e6), 1, at_least=False, unit=" us"),
    Target(
        "law.stress beyond the compiled call",
        _median("overhead", "beyond", 1e6),
        5,
        at_least=False,
        unit=" us",
        limited_by=_parts_of_a_call,
    ),
)
