"""The figures of the explanation, drawn by the program when the site is built, into docs/built/figures.

A page shows `built/figures/explained-NAME.svg`. A figure is drawn again when this file changed.
"""

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import probation
from probation.published.experiments import twin_campaign
from probation.records.reading import read_record
from probation.report.figures import house_style, new_figure, save_figure
from probation.report.initial_page import clocks_figure
from probation.report.style import SERIES, colour
from probation.smoothing.answer import describe_excitation

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from sphinx.application import Sphinx

LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)


def setup(app: "Sphinx") -> dict[str, bool]:
    """Draw the figures, before Sphinx looks for sources."""
    app.connect("config-inited", lambda app, config: draw_all(Path(app.srcdir) / "built" / "figures"))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def draw_all(folder: Path) -> None:
    """Draw what is not there yet, or older than this file."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        path = folder / f"explained-{name}.svg"
        if not path.exists() or path.stat().st_mtime < Path(__file__).stat().st_mtime:
            save_figure(draw(), path)


def law() -> "Figure":
    """Stress at three rates, and what relaxes of it and what does not."""
    with house_style():
        figure = new_figure(8.4, 3.2)
        left, right = figure.subplots(1, 2)
        for at, rate in enumerate((0.0005, 0.005, 0.05)):
            test = probation.named_history("ramp", rate=rate, strain=1.5, samples=400)
            left.plot(test.true_strain, LAW.stress(test), color=colour(SERIES[at]), label=f"{rate:g} 1/s")
        test = probation.named_history("load-unload", rate=0.005, strain=1.0, samples=800)
        right.plot(test.true_strain, LAW.stress(test), color=colour("model"), label="stress")
        hardening = LAW.with_parameters(LAW.parameters * np.array([1e-9, 1.0, 1.0])).stress(test)
        right.plot(test.true_strain, hardening, "--", color=colour("second"), label="hardening, which does not relax")
        left.set(xlabel="true strain [–]", ylabel="true stress [MPa]", title="three strain rates")
        right.set(xlabel="true strain [–]", ylabel="true stress [MPa]", title="loading and unloading, 0.005 1/s")
        right.set_ylim(top=70.0)
        left.legend()
        right.legend(loc="upper left")
    return figure


def schemes() -> "Figure":
    """Error against step and against time."""
    return probation.crosscheck().plot()


def companion() -> "Figure":
    """The paper's Figure S2."""
    return probation.calibrate_companion(twin_campaign((1, 2, 3), noise=0.04)).plot()


def excitation() -> "Figure":
    """A strain with noise and a jump of its rate, smoothed."""
    test = probation.named_history("rate-jump", samples=400)
    strain = test.true_strain + np.random.default_rng(1).normal(0.0, 1e-3, test.true_strain.shape)
    record = probation.Record("rate-jump", test.time, strain, LAW.stress(test))
    return describe_excitation((record,)).plot()


def uncertainty() -> "Figure":
    """Confidence and prediction bands along a history that was not measured."""
    history = probation.named_history("ramp", rate=0.02, strain=1.5, samples=300)
    return probation.fit(twin_campaign((1,), noise=6.0)).predict(history).plot()


def certificate() -> "Figure":
    """Prediction of a test with nothing adjusted."""
    return probation.certify(twin_campaign((1, 2))).plot()


def isolability() -> "Figure":
    """What two ramps could discriminate."""
    rates = {"slow": 0.001, "fast": 0.02}
    tests = {name: probation.named_history("ramp", rate=rate, strain=1.5) for name, rate in rates.items()}
    return probation.plan(LAW, tests, noise=0.6).plot()


def clocks() -> "Figure":
    """A force file and a film of the same test, whose clock is 7.5 s ahead."""
    time, film = np.arange(-5.0, 20.0, 0.1), np.arange(-4.0, 19.0, 0.25)
    test = probation.named_history("ramp", rate=0.01, strain=0.2, samples=401)
    noise = np.random.default_rng(0)
    force = 40.0 * np.interp(time, test.time, LAW.stress(test)) + noise.normal(0.0, 0.5, time.shape)
    crosshead = 50.0 * np.expm1(np.interp(time, test.time, test.true_strain)) + 0.001 * force
    strain = np.expm1(np.interp(film, test.time, test.true_strain)) + noise.normal(0.0, 1e-4, film.shape)
    with tempfile.TemporaryDirectory() as folder:
        _write(Path(folder) / "force.csv", "Time (s),Stroke (mm),Force (N)", time + 5.0, crosshead, force)
        _write(Path(folder) / "film.csv", "Time (s),Engineering strain (%)", film + 12.5, 100.0 * strain)
        how = {"file": "film.csv"}
        return clocks_figure(read_record(Path(folder) / "force.csv", strain_from=how, specimen={"area_mm2": 40.0}))


def _write(path: Path, heading: str, *columns: np.ndarray) -> None:
    np.savetxt(path, np.stack(columns, axis=1), delimiter=",", header=heading, comments="", fmt="%.6f")


FIGURES: dict[str, Callable[[], "Figure"]] = {
    draw.__name__: draw for draw in (law, schemes, companion, excitation, uncertainty, certificate, isolability, clocks)
}
