"""Constants of the statistics stand in one place, each with what a reader wants to know of it."""

import ast
import dataclasses
from pathlib import Path

import pytest

from probation.settings.page import GROUPS, modules_by_setting, settings_page

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "python" / "probation"


@pytest.mark.parametrize("name", GROUPS)
def test_a_setting_says_unit_meaning_origin_and_source(name):
    for field in dataclasses.fields(GROUPS[name]):
        known = field.metadata
        assert known["meaning"].endswith((".", ")")), field.name
        assert known["unit"], field.name
        assert known["origin"] in {"derived", "chosen", "calibrated"}
        assert known["source"] or known["origin"] != "calibrated", field.name


def test_every_setting_is_used_and_every_name_that_is_used_is_a_setting():
    settings = {f"{name.upper()}.{field.name}" for name, group in GROUPS.items() for field in dataclasses.fields(group)}
    studies = "".join(path.read_text(encoding="utf-8") for path in PACKAGE.parent.glob("probation_studies/**/*.py"))
    assert set(modules_by_setting()) <= settings
    assert {name for name in settings if name not in studies} <= set(modules_by_setting())


@pytest.mark.parametrize("name", GROUPS)
def test_settings_are_frozen(name):
    field = dataclasses.fields(GROUPS[name])[0].name
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(GROUPS[name], field, 1.0)


def test_the_page_of_settings_is_what_they_say():
    """Else: ``python -m probation.settings.page > docs/settings.md``."""
    assert (ROOT / "docs/settings.md").read_text(encoding="utf-8") == settings_page()


STATISTICS = (
    *("noise", "detection", "smoothing", "effects", "inference", "design"),
    *("identify", "certificate", "calibration", "diagnosis", "comparison", "field"),
)
"""Rooms whose constants stand in the settings.

Priors of effects stand in their catalogue, each with its reason; the example of a field is data.
"""

NUMERICAL = {
    "detection/hidden_steps.py": {"_BEFORE", "_EDGE", "_RECOVERIES"},
    "effects/sudden.py": {"NEAR", "_BESIDE", "_STAYS"},
    "effects/instants.py": {"_EVEN"},
    "noise/arma.py": {"START_UP", "SETTLED", "_EDGES", "GRID", "REFINED"},
    "noise/drift.py": {"SIZES", "BIASES"},
    "noise/joint_noise.py": {"LEAST_SEEN"},
    "noise/local_noise.py": {"MEMORY"},
    "noise/local_size.py": {"MEDIAN_OF_NORMAL"},
    "noise/span.py": {"DEPENDENT", "HARDLY_NEW"},
    "noise/white_level.py": {"LOG_LEVEL_TOLERANCE"},
    "noise/whitener.py": {"LEAST_SHARED"},
    "detection/gap_test.py": {"ABSORBED"},
    "detection/lines_and_steps.py": {"KEPT", "ROUNDING"},
    "detection/strain_periodic.py": {"FREQUENCIES_PER_SPACING", "GRID"},
    "detection/without_lines.py": {"PLACES"},
    "detection/tail.py": {"MANY", "_NODES", "_WEIGHTS"},
    "smoothing/averaging.py": {"PART", "BEYOND", "FURTHER", "ORDERS"},
    "smoothing/necking.py": {"REFINED"},
    "smoothing/penalised_spline.py": {"FEWEST_KNOTS", "MOST_KNOTS", "ALL_KNOTS", "LEAST_TURNS", "COARSE"},
    "smoothing/savitzky_golay.py": {"WINDOWS", "EVEN", "AT_ONCE"},
    "smoothing/smoothed.py": {"ROUNDS"},
    "smoothing/transient.py": {"DEGREE"},
    "effects/coordinate.py": {"NEARLY"},
    "effects/maxwell_element.py": {"LONGEST"},
    "effects/record_view.py": {"TAUT", "_MOVING"},
    "effects/relaxation_spectra.py": {"_ANGLES"},
    "inference/prediction.py": {"MOST_STEPS"},
    "inference/base_fit.py": {"MOST_TURNS", "MOST_REFIT_STEPS", "SETTLED"},
    "inference/callable_law.py": {"_STEP"},
    "inference/deviations.py": {"_STEP"},
    "inference/discrepancy.py": {"DEPENDENT"},
    "inference/information.py": {"SINGULAR"},
    "inference/laplace.py": {"UNDETERMINED"},
    "inference/least_squares.py": {"FIRST_DAMPING", "LEAST_DAMPING", "MOST_DAMPING", "ALL_DIGITS"},
    "inference/modal_law.py": {"_BOUNDS"},
    "inference/elastic_frame.py": {"MODES", "SAMPLES", "STEP", "MOVING", "MOST_GROWTH"},
    "inference/model.py": {"_ONE_SIDED", "_PROBE", "_PARABOLA", "_MOVED_KINKS"},
    "inference/moving_noise.py": {"KEPT"},
    "inference/remembering.py": {"KEPT"},
    "inference/own_force.py": {
        *("MOST_NEWTON_STEPS", "MOST_DIRECTIONS", "MOST_KEPT", "PARTS", "SETTLED", "SLOPE", "ROUGHLY", "GOOD_ENOUGH"),
        *("ROUGHEST", "FINEST", "PATIENCE", "HOPELESS", "PROBE", "MANY", "LOST"),
    },
    "inference/propagated.py": {"ROUNDING", "STRAIN_STEP"},
    "inference/refit.py": {"MOST_STEPS"},
    "inference/scalar_minimum.py": {"GOLDEN", "MOST_CALLS"},
    "inference/scatter.py": {"FIRST_STEP", "ACCEPTED", "ADAPTED"},
    "inference/strain_noise.py": {"_SPARE", "_PER_FREEDOM", "_STEP"},
    "design/effect_design.py": {"NOTHING", "CLOSE", "_REFINED"},
    "design/effect_signals.py": {"_SMALLER", "_ATTEMPTS"},
    "design/isolability_result.py": {"_NAMED"},
    "design/planned_tests.py": {"_HOURS", "_TURNS", "_SETTLED"},
    "design/predicted.py": {"_LOOSE"},
    "design/rivalry.py": {"_HALVINGS"},
    "identify/base_law.py": {"START"},
    "identify/draws.py": {"MOST_REDRAWS"},
    "identify/fit.py": {"PARAMETERS"},
    "identify/profile.py": {"FIRST_STEP", "MOST_POINTS", "FINE_ENOUGH"},
    "identify/scheme_error.py": {"ENOUGH_INSTANTS"},
    "identify/search.py": {"FINAL_STEP", "LONGEST_STEP", "ZERO"},
    "identify/variable_projection.py": {"POINTS", "NEARBY"},
    "identify/weighting.py": {"SMALL_STEP", "ROUGH_STEP"},
    "certificate/bias.py": {"LENGTHS", "RATIOS"},
    "certificate/fits.py": {"LATE", "PARAMETERS"},
    "calibration/cross_validation.py": {"SMALLEST_REPORTED"},
    "calibration/direct.py": {"FINAL_STEP", "MOST_SEARCH_STEPS", "LONGEST_STEP"},
    "calibration/regression.py": {"_MOST_ROUNDS", "FINAL_STEP"},
    "diagnosis/free_function.py": {"POINTS", "SMALLEST_STRESS"},
    "diagnosis/headline.py": {"MOST_RIVALS"},
    "diagnosis/refitting.py": {"_PARTS"},
    "diagnosis/search.py": {"_USUAL"},
    "comparison/measured_law.py": {"ROUNDING", "TINY"},
    "field/block.py": {"SEED"},
    "field/fingerprint.py": {"PIECE", "PIECES"},
    "field/identify.py": {"PIXELS"},
    "field/source.py": {"SHOWN_REASON", "UNITS"},
    "field/store.py": {"_MARK", "_RUN"},
}
"""Constants of modules: steps, grids and ends of numerical methods, rounding, closed forms, histories, words."""

IN_FUNCTIONS = {
    "noise/arma.py": {256},  # a cache
    "noise/local_noise.py": {6.0},  # second differences of white noise
    "noise/local_size.py": {1e-3},  # the logarithm of nothing
    "noise/moving_parabola.py": {5.0},  # Savitzky and Golay's weights
    "noise/nuisance_drift.py": {1e-4},  # rounding of what a refit leaves
    "noise/outliers.py": {0.9},  # the quantile of UPPER_95
    "noise/segments.py": {256},  # a cache
    "diagnosis/other_measure.py": {0.9},  # a strain of which there is a logarithm
    "detection/lines_and_steps.py": {1e-3, 6.0, 256},  # even samples; Student's kurtosis; a batch
    "detection/strain_periodic.py": {1.38},  # see its docstring
    "smoothing/answer.py": {0.95},
    "smoothing/excitation.py": {26.0},  # three-point differences
    "smoothing/necking.py": {0.25, 1e-5, 8.0, 12.0, 30.0, 0.1, 0.4},  # a step, bounds and starts of
    "smoothing/penalised_spline.py": {1e-3, 1e5, 0.01, 1.02},  # ends and precision of its search
    "smoothing/savitzky_golay.py": {1.02},
    "smoothing/segmented.py": {6.0},  # half of a sampling interval, uniform
    "smoothing/sines.py": {0.98, 60},
    "effects/coordinate.py": {10.0},
    "effects/effect.py": {1e-4, 1e-5},  # steps of difference quotients
    "effects/large_forms.py": {0.9},  # bounds of a gain
    "effects/record_view.py": {1e-3},
    "effects/relaxation_spectra.py": {50.0},
    "inference/callable_law.py": {1000.0, 10.0, 1e7, 1e9},  # an example
    "inference/information.py": {0.975},
    "inference/least_squares.py": {5.0, 10.0},  # damping
    "inference/scatter.py": {0.025, 0.975},
    "design/effect_design.py": {1.01},
    "design/next_test.py": {1800.0, 0.99},  # half an hour; words
    "design/planned_tests.py": {60.0, 120.0, 7200.0},  # words for times
    "design/rivalry.py": {1.01},
    "identify/covariance.py": {0.975},
    "identify/describe.py": {0.975},
    "identify/profile.py": {0.1, 0.07},  # steps of the walk
    "identify/result.py": {0.95, 1000},  # defaults that a caller sees
    "identify/scattered.py": {0.975},
    "identify/substeps.py": {0.2, 0.25},  # powers of Lagrange's optimum
    "identify/search.py": {1000.0, 4000},
    "identify/variable_projection.py": {1e-3},
    "calibration/calibrate.py": {1e-3, 0.6, 0.2},  # starts
    "calibration/companion_forms.py": {1000.0},  # eq. (12)
    "calibration/cross_validation.py": {0.1, 0.0005},  # digits
    "calibration/direct.py": {1.01, 200.0},
    "calibration/record_fits.py": {50.0},  # the median; rounds
    "calibration/result.py": {0.975},
    "inference/calibration_check.py": {10.0},  # digits
    "field/identify.py": {157, 160},  # words
    "field/maps.py": {0.05, 0.95},  # the percentiles that the key of the answer names
    "field/smoothing.py": {10.0, 64},  # the base of the exponents; a cache
    "field/status.py": {20},  # a code
    "field/store.py": {60},  # words
    "comparison/measured_law.py": {40},  # finer intervals than any record has
}
"""Numbers in functions that have no say in an answer, or belong to a formula."""

FORMULAS = {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 100.0}


def _sources():
    for room in STATISTICS:
        for path in sorted((PACKAGE / room).rglob("*.py")):
            if not {"catalogue", "example"} & {*path.parts}:
                yield path.relative_to(PACKAGE).as_posix(), ast.parse(path.read_text(encoding="utf-8"))


def _numbers(node):
    """Literals outside texts, outside what is said of progress, and outside bounds and priors with a reason."""
    said = isinstance(node, ast.Call) and getattr(node.func, "id", getattr(node.func, "attr", "")) in {
        *("advance", "done", "progress", "Part", "_begin", "EffectParameter")
    }
    if isinstance(node, ast.Constant) and type(node.value) in {int, float}:
        yield node.value
    elif not said and not isinstance(node, ast.JoinedStr):
        for child in ast.iter_child_nodes(node):
            yield from _numbers(child)


def test_a_constant_of_the_statistics_stands_in_the_settings():
    found = {}
    for path, tree in _sources():
        for statement in tree.body:
            if isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
                targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
                if any(number not in {0, 1} for number in _numbers(statement.value)):
                    names = {name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)}
                    found.setdefault(path, set()).update(names)
    assert found == NUMERICAL


def test_no_number_in_a_function_has_a_say_of_its_own():
    """Not above rounding, no small count, no factor of a formula: it would be a setting."""
    found = {}
    for path, tree in _sources():
        for statement in tree.body:
            if isinstance(statement, ast.FunctionDef | ast.ClassDef):
                own = {
                    number
                    for number in map(abs, _numbers(statement))
                    if number > (1e-6 if type(number) is float else 10) and number not in FORMULAS
                }
                found[path] = found.get(path, set()) | own
    assert {path: numbers for path, numbers in found.items() if numbers} == IN_FUNCTIONS


SPREADS = {"sd", "se", "sigma", "std", "sqrt", "deviation", "noise", "error"}
"""Parts of the names of standard deviations, and what makes one of a variance."""


def _is_spread(node):
    """Whether a name, an attribute or a call is a standard deviation by its name."""
    node = node.func if isinstance(node, ast.Call) else node
    return bool(SPREADS & {*getattr(node, "id", getattr(node, "attr", "")).split("_")})


def _multiples_of_spreads(tree):
    """Comparisons and ends with a literal 2, 3 or 4 that says how many standard deviations matter."""
    for node in ast.walk(tree):
        called = isinstance(node, ast.Call) and getattr(node.func, "id", getattr(node.func, "attr", ""))
        if isinstance(node, ast.Compare) or called in {"max", "min", "maximum", "minimum", "clip"}:
            compared = any(
                map(_is_spread, [node.left, *node.comparators] if isinstance(node, ast.Compare) else node.args)
            )
            for product in ast.walk(node):
                if isinstance(product, ast.BinOp) and isinstance(product.op, ast.Mult):
                    factors = [product.left, product.right]
                    literal = any(isinstance(each, ast.Constant) and each.value in {2, 3, 4} for each in factors)
                    if literal and (compared or any(map(_is_spread, factors))):
                        yield ast.unparse(node)


def test_how_many_standard_deviations_matter_stands_in_the_settings():
    """Though 2, 3 and 4 may be factors of a formula."""
    assert [f"{path}: {found}" for path, tree in _sources() for found in _multiples_of_spreads(tree)] == []


@pytest.mark.parametrize("line", ["bias_MPa > 2.0 * self.noise_MPa", "se < 3 * abs(a)", "max(x - 2.0 * np.sqrt(n), 0)"])
def test_a_number_of_standard_deviations_is_found(line):
    assert [*_multiples_of_spreads(ast.parse(line))] == [ast.unparse(ast.parse(line))]
    assert not [*_multiples_of_spreads(ast.parse(line.replace("2.0", "EVIDENCE.some").replace("3", "EVIDENCE.some")))]


EXPLAINED = ("records", "schemes", "law", "effects/catalogue")
"""Rooms whose own constants stay where they are used, each with a comment or a docstring that says what it is."""


def _unexplained(path):
    """Names of a module's constants without either."""
    source = path.read_text(encoding="utf-8")
    lines, body = ["", *source.split("\n")], ast.parse(source).body
    for statement, next_one in zip(body, [*body[1:], None], strict=True):
        if isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
            says = isinstance(next_one, ast.Expr) or "#" in lines[statement.end_lineno]
            above = lines[statement.lineno - 1].startswith("#")
            if not says and not above and any(number not in {0, 1} for number in _numbers(statement.value)):
                target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
                yield ast.unparse(target)


@pytest.mark.parametrize("room", EXPLAINED)
def test_a_constant_that_stays_in_its_module_says_what_it_is(room):
    """A table of units and the object of an effect have names for their numbers."""
    found = [
        f"{path.relative_to(PACKAGE).as_posix()}: {name}"
        for path in sorted((PACKAGE / room).rglob("*.py"))
        if path.name != "units.py"
        for name in _unexplained(path)
        if name != "EFFECT"
    ]
    assert not found
