"""The virtual laboratory: its own integration, its secrecy, its nulls."""

import ast
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import least_squares

import probation
import probation_studies
from probation.effects.registry import effects
from probation_studies.blind import laboratory
from probation_studies.blind.laboratory.bank import Bank
from probation_studies.blind.laboratory.causes import KNOWN, NAMES, OUTSIDE
from probation_studies.blind.laboratory.design import draw_design
from probation_studies.blind.laboratory.material import (
    TIME_RATIO,
    WEIGHT,
    Activation,
    BaseLaw,
    Heating,
    Specimen,
    integrate,
)
from probation_studies.blind.laboratory.noise import Noise, draw_record_noise
from probation_studies.blind.laboratory.rig import REFINEMENT
from probation_studies.blind.laboratory.trial import Acting, recorded_stress
from probation_studies.blind.laboratory.withheld import shortest_window

SOURCE = Path(probation_studies.__file__).parent
LABORATORY_FOLDERS = [
    SOURCE / "blind" / "laboratory",
    *(path.parent for path in sorted((SOURCE / "blind" / "laboratories").glob("*/__init__.py"))),
]
SHARED = {"probation.errors", "probation._files", "probation.limits"}  # files written whole: no mechanics in them
CONTRACT = {
    "rate_dependent_relaxation", "rate_dependent_hardening", "finite_extensibility", "spectrum_shape",
    "stress_activated_flow", "self_heating", "damage", "structural_softening", "slow_process", "delayed_hardening",
    "force_offset", "force_drift", "force_gain", "force_strain_lag", "strain_offset", "machine_compliance",
    "volume_change", "prestress", "grip_slip", "periodic_disturbance", "temperature_drift", "force_saturation",
}  # fmt: skip


def _module_file(name: str) -> Path | None:
    path = SOURCE.parent / Path(*name.split("."))
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if candidate.is_file():
            return candidate
    return None


def _imports(path: Path) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import hides what is shared"
            assert node.module is not None
            found.add(node.module)
            found |= {
                f"{node.module}.{alias.name}" for alias in node.names if _module_file(f"{node.module}.{alias.name}")
            }
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            "import_module",
            "__import__",
        ):
            pytest.fail(f"{path}: an import by name hides what is shared")
    return found


def _packages(folder: Path) -> set[str]:
    """The package of a folder and its modules."""
    paths = (path.relative_to(SOURCE.parent).with_suffix("") for path in folder.rglob("*.py"))
    return {".".join(path.parts).removesuffix(".__init__") for path in paths}


@pytest.mark.parametrize("folder", LABORATORY_FOLDERS, ids=lambda folder: folder.name)
def test_making_data_shares_nothing_with_what_is_tested(folder):
    """Follow every import from a laboratory: beside its own files only the exceptions may appear."""
    package = ".".join(folder.relative_to(SOURCE.parent).parts)
    parents = {package.rsplit(".", k)[0] for k in range(1, package.count(".") + 1)} - {"probation_studies"}
    waiting = _packages(folder) | parents
    seen: set[str] = set()
    while waiting:
        name = waiting.pop()
        seen.add(name)
        path = _module_file(name)
        if path is not None and name not in SHARED and name != "probation":
            waiting |= {each for each in _imports(path) if each.split(".")[0].startswith("probation")} - seen
    own = {name for name in seen if name == package or name.startswith(f"{package}.")}
    assert seen - own - parents <= SHARED


@pytest.mark.parametrize("folder", LABORATORY_FOLDERS, ids=lambda folder: folder.name)
def test_only_numpy_and_scipy_are_used_beside_the_standard_library(folder):
    for path in folder.rglob("*.py"):
        roots = {name.split(".")[0] for name in _imports(path)}
        assert roots <= {"numpy", "scipy", "probation", "probation_studies", "__future__"} | set(
            sys.stdlib_module_names
        ), path


def _specimen(time, strain, law, **more):
    n = len(time)
    rate = np.diff(strain) / np.diff(time)
    return Specimen(
        time=time,
        strain=strain,
        log_time=law.log_time(rate),
        modulus=np.full(n - 1, law.unrelaxed_modulus),
        relaxed=law.hardening_modulus * (np.exp(2.0 * strain) - np.exp(-strain)),
        weight=more.pop("weight", WEIGHT),
        overstress=np.zeros_like(WEIGHT),
        extra=np.zeros(n),
        **more,
    )


def test_a_ramp_has_the_closed_form_of_equation_7():
    """Per mode, E_u r tau (1 - e^(-t/tau)) and the convolution of G e_HT / tau, by quadrature."""
    law, rate = BaseLaw(2000.0, 20.0, 2.0), 1e-3
    time = np.linspace(0.0, 1500.0, 6001)
    found = integrate([_specimen(time, rate * time, law)])[0]
    for t in (3.0, 150.0, 1500.0):
        expected = 0.0
        for ratio, weight in zip(TIME_RATIO, WEIGHT, strict=True):
            tau = 20.0 * ratio

            def pull(s, t=t, tau=tau):
                return 2.0 * (np.exp(2.0 * rate * (t - s)) - np.exp(-rate * (t - s))) * np.exp(-s / tau) / tau

            memory = quad(pull, 0.0, min(t, 40.0 * tau), epsabs=1e-10, epsrel=1e-10)[0]
            expected += weight * (2000.0 * rate * tau * -np.expm1(-t / tau) + memory)
        assert found[np.searchsorted(time, t)] == pytest.approx(expected, abs=2e-5)


def _by_an_ode_solver(law, rate, end, activation=None, heating=None):
    """Six slow modes and one thermal mode by Radau at 1e-10, with the work that is not stored elastically."""
    weight = np.where(np.arange(50) >= 44, WEIGHT, 0.0)
    weight /= weight.sum()
    tau = law.longest_time * TIME_RATIO[44:]
    p = weight[44:]

    def slopes(t, state):
        strain, warm = rate * t, state[-1] if heating else 0.0
        factor = 1.0 - heating.hardening_loss * warm if heating else 1.0
        stress = state[:6].sum()
        speed = 0.1 * warm / (1.0 + warm / 300.0) + (activation.log_gain(stress) if activation else 0.0)
        relaxed = law.hardening_modulus * factor * (np.exp(2.0 * strain) - np.exp(-strain))
        modes = p * law.unrelaxed_modulus * rate - (state[:6] - p * relaxed) * np.exp(speed) / tau
        power = 0.9 * max(stress * (rate - modes.sum() / law.unrelaxed_modulus), 0.0)
        cooling = heating.degrees_per_work * power - heating.rate[0] * warm if heating else 0.0
        return np.append(modes, cooling)

    found = solve_ivp(slopes, (0.0, end / rate), np.zeros(7), method="Radau", rtol=1e-10, atol=1e-10)
    return weight, found.y[:6, -1].sum()


@pytest.mark.parametrize(
    ("activation", "heating"),
    [
        (None, None),
        (Activation(gain=0.5, stress=10.0), None),
        (Activation(share=0.3, share_stress=12.0), None),
        (None, Heating(0.4, (5e-3,), (1.0,), 0.004)),
        (Activation(gain=0.3, stress=8.0), Heating(0.4, (5e-3,), (1.0,), 0.004)),
    ],
)
def test_feedbacks_agree_with_an_independent_solver(activation, heating):
    law, rate, end = BaseLaw(1500.0, 30.0, 1.5), 3e-3, 1.2
    weight, expected = _by_an_ode_solver(law, rate, end, activation, heating)
    time = np.linspace(0.0, end / rate, 3001)
    specimen = _specimen(time, rate * time, law, weight=weight, activation=activation, heating=heating)
    assert integrate([specimen])[0][-1] == pytest.approx(expected, rel=2e-5)


def test_the_base_law_is_the_one_that_is_diagnosed():
    """Independent codes, one law: a null is a null for the engine's exact scheme, too."""
    law = BaseLaw(1800.0, 1.05, 1.7, (0.00464, 0.0367))
    time = np.linspace(0.0, 200.0, 1001)
    strain = 5e-3 * time + 0.02 * np.sin(time / 40.0) ** 2
    engine = probation.Law(
        unrelaxed_modulus=1800.0, alpha=1.05, hardening_modulus=1.7, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    expected = engine.stress(time, strain, scheme="exact")
    assert integrate([_specimen(time, strain, law)])[0] == pytest.approx(expected, abs=2e-3)


def test_every_name_of_the_contract_can_be_withheld():
    assert set(NAMES) == CONTRACT
    assert len({cause.name for cause in OUTSIDE}) >= 5
    assert not {cause.name for cause in OUTSIDE} & CONTRACT
    since = {cause.known_as for cause in OUTSIDE if cause.known_as}
    assert since < {effect.name for effect in effects()} - CONTRACT
    assert {cause.answer for cause in OUTSIDE if not cause.known_as} == {"unknown"}
    assert all(not cause.outside for cause in KNOWN)
    assert all(cause.outside for cause in OUTSIDE)


def test_every_cause_adds_the_same_on_the_samples_and_on_four_times_finer_steps():
    """In one unloaded record; the samples' signals are what detectabilities are made of."""
    random = np.random.default_rng(4)
    bench = draw_design(random, needs_unloading=True, needs_reach=True).bench
    k = next(k for k, test in enumerate(bench.tests) if test.schedule.unloads)
    bench = replace(bench, held_out=tuple(j != k for j in range(len(bench.tests))))
    noise = Noise(0.1, False, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    noises = [draw_record_noise(random, noise, bench.law, test.time, test.strain) for test in bench.tests]
    bank = Bank(bench, noises)
    setting = bank.setting([k])
    plain = recorded_stress([(bench.trial(k, fine=True), ())])[0][::REFINEMENT]
    for cause in (*KNOWN, *OUTSIDE):
        acting = Acting(cause, 0.5 * min(cause.scale, cause.largest(setting)), cause.draw(random, setting))
        coarse = bank.added(k, [(acting,)])[0]
        fine = recorded_stress([(bench.trial(k, fine=True), (acting,))])[0][::REFINEMENT] - plain
        assert np.linalg.norm(coarse - fine) <= 0.1 * np.linalg.norm(fine) + 1e-6, cause.name


@pytest.fixture(scope="module")
def campaigns():
    return [laboratory.make(1, index) for index in (18, 22, 23, 48)]


def test_a_campaign_is_the_same_for_the_same_seed_and_another_for_another(campaigns):
    again = laboratory.make(1, 22)
    assert again.truth.to_json() == campaigns[1].truth.to_json()
    for one, other in zip(again.records, campaigns[1].records, strict=True):
        assert np.array_equal(one.true_stress, other.true_stress)
    other_split = laboratory.make(1, 22, split="calibrate")
    assert other_split.truth.base != again.truth.base


def test_a_written_campaign_is_read_back_digit_by_digit_and_says_nothing_of_the_truth(campaigns, tmp_path):
    for sealed in campaigns:
        folder = sealed.write(tmp_path / sealed.name)
        read = probation.Campaign.load(folder)
        assert [record.id for record in read.records] == [record.id for record in sealed.records]
        for found, written in zip(read.records, sealed.records, strict=True):
            assert np.array_equal(found.true_stress, written.true_stress)
            assert np.array_equal(found.true_strain, written.true_strain)
            assert found.role == ("held-out" if written.held_out else "identify")
        said = "".join(path.read_text() for path in folder.glob("*.toml")).lower()
        assert not any(word in said for word in (*CONTRACT, "stratum", "truth", "seed =", "unknown"))


def test_truths_are_plain_json_and_hang_together(campaigns):
    for sealed in campaigns:
        truth = json.loads(sealed.truth.to_json())
        assert truth["stratum"] in laboratory.STRATA
        assert (truth["stratum"] == "none") == (truth["causes"] == []) == (truth["explanation"] == [])
        assert sum(truth["oracle"]["posterior"].values()) == pytest.approx(1.0, abs=0.05)
        assert 3 <= len(sealed.records) <= 8
        for cause in truth["causes"]:
            assert cause["detectability"] >= 2.0
            assert set(cause["records"]) <= set(truth["records"])
            for window in cause["windows"]:
                assert window["record"] in cause["records"]
                assert window["time_s"][0] <= window["time_s"][1]


def test_neither_sampling_nor_drift_pretends_to_be_an_effect(campaigns):
    for sealed in campaigns:
        assert sealed.truth.sampling_detectability < 1.0
        assert sealed.truth.drift_detectability < 1.0


def _engine(sealed, unrelaxed_modulus, third, hardening_modulus):
    companion = None if sealed.companion is None else probation.Weissenberg(*sealed.companion)
    return probation.Law(
        unrelaxed_modulus=unrelaxed_modulus,
        hardening_modulus=hardening_modulus,
        companion=companion,
        **({"tau_max": third} if companion is None else {"alpha": third}),
    )


def _root_mean_squares(sealed, parameters):
    """Of what the engine's exact scheme leaves of every record."""
    law = _engine(sealed, *parameters)
    stress = {r.id: law.stress(r.time, r.true_strain, scheme="exact") for r in sealed.records}
    return {r.id: float(np.sqrt(np.mean((r.true_stress - stress[r.id]) ** 2))) for r in sealed.records}


def test_nulls_leave_the_base_law_at_the_level_of_the_noise(campaigns):
    """The engine's exact scheme with the true parameters: residuals of the size of the noise, and as the truth says."""
    nulls = [sealed for sealed in campaigns if sealed.truth.stratum == "none"]
    assert nulls
    for sealed in nulls:
        left = _root_mean_squares(sealed, sealed.truth.base.values())
        assert all(left[name] < 1.5 * level for name, level in sealed.truth.noise_level.items())
        assert sealed.truth.noise_drawn == pytest.approx(left, rel=0.01)


def test_a_refit_that_is_told_leaves_what_the_engines_own_refit_of_a_null_leaves(campaigns):
    """Ordinary least squares by the engine, generalised ones by the laboratory: within two per cent in every record."""
    sealed = next(each for each in campaigns if each.truth.stratum == "none")
    fitted = [record for record in sealed.records if not record.held_out]
    true = np.array(list(sealed.truth.base.values()))

    def residual(factor):
        law = _engine(sealed, *(true * factor))
        return np.concatenate([law.stress(r.time, r.true_strain, scheme="exact") - r.true_stress for r in fitted])

    found = least_squares(residual, np.ones(3), diff_step=1e-5, x_scale=1e-3).x
    assert sealed.truth.left_when_told == pytest.approx(_root_mean_squares(sealed, true * found), rel=0.02)
    assert sealed.truth.left_when_told != sealed.truth.noise_drawn


def test_the_shortest_window_holds_nine_tenths_of_the_squares():
    """A signal of 1 on samples 30 to 39 and 0.1 elsewhere: 9 of the 10 hold 9 / 10.9 and all 10 hold 10 / 10.9."""
    signal = np.full(120, 0.1)
    signal[30:40] = 1.0
    first, last = shortest_window(signal)
    assert (first, last) == (30, 39)


@pytest.mark.parametrize(("seed", "index", "split"), [(-1, 0, "develop"), (0, -1, "develop"), (0, 0, "train")])
def test_bad_arguments_are_named(seed, index, split):
    with pytest.raises(probation.InputError, match=r"split|seed, index"):
        laboratory.make(seed, index, split)
