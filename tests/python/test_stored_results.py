"""Fits, certificates, diagnoses and calibrations go to JSON and come back, whatever fields they have."""

import json
from dataclasses import dataclass, field

import numpy as np
import pytest

from campaigns.typical_results import FURTHER, NAMES, result
from probation import InputError, StressBand, init_campaign, preview, reduce_spectrum
from probation.certificate.result import Certificate
from probation.diagnosis.result import Diagnosis
from probation.exporting.result import Export, Exports
from probation.histories import named_history
from probation.identify.result import Fit
from probation.results.data import CURVE, LEFT_OUT, Stored, WithCurves, encoded, from_curves


@pytest.mark.parametrize("name", [*NAMES, *FURTHER])
def test_a_result_comes_back_with_its_text(name):
    done = result(name)
    again = type(done).from_json(done.to_json())
    assert again.to_json() == done.to_json()
    assert again.summary() == done.summary()


@pytest.fixture
def tension_file(tmp_path):
    time = np.linspace(0.0, 20.0, 101)
    rows = np.column_stack([time, 0.01 * time, 30.0 * np.tanh(time)])
    path = tmp_path / "tension.csv"
    np.savetxt(path, rows, delimiter=",", header="time_s,true_strain,true_stress_MPa", comments="")
    return path


def test_what_is_said_of_a_file_comes_back_with_its_records(tension_file, tmp_path):
    """The summary draws the records: they are always written."""
    for done in (preview(tension_file), init_campaign([tension_file], tmp_path / "campaign")):
        again = type(done).from_json(done.to_json())
        assert again.to_json() == done.to_json()
        assert again.summary() == done.summary()
        assert again.plot().axes


def test_what_has_no_text_comes_back_with_its_numbers():
    """Draws, a band of a predicted stress, a spectrum of fewer modes."""
    fit, ramp = result("fit"), named_history("ramp", samples=60)
    for done in (fit.sample(20), fit.predict(ramp), reduce_spectrum(modes=5)):
        again = type(done).from_json(done.to_json())
        assert again.to_json() == done.to_json()
        assert encoded(again) == encoded(done)
    assert json.loads(fit.sample(20).to_json())["draws"].keys() == set(fit.sample(20).names)


def test_one_law_in_several_formats_comes_back_with_their_files():
    """As `probation export --format all --json` writes them; an `Export` is read of a text that holds one."""
    kinds = ("the whole law", "a linear part with fewer modes", "flow curves")
    done = Exports(tuple(result(f"export of {kind}") for kind in kinds))
    again = Exports.from_json(done.to_json())
    assert again.to_json() == done.to_json()
    assert [each.text for each in again.exports] == [each.text for each in done.exports]
    assert [each.summary() for each in again.exports] == [each.summary() for each in done.exports]
    with pytest.raises(InputError, match=r"found 3 exports, expected one; Exports\.from_json reads several"):
        Export.from_json(done.to_json())


def test_a_band_that_is_not_known_comes_back_without_an_end():
    """Infinite in the result, null for programs: JSON has no infinity."""
    one = np.ones(2)
    band = StressBand("law", one, one, one, np.array([0.5, np.inf]), 0.1, 0.95, 30.0)
    assert json.loads(band.to_json())["standard_error_MPa"] == [0.5, None]
    assert np.array_equal(StressBand.from_json(band.to_json()).standard_error, [0.5, np.inf])


@pytest.mark.parametrize("name", ["fit", "certificate", "diagnosis"])
def test_with_curves_a_result_comes_back_with_its_figure(name):
    done = result(name)
    again = type(done).from_json(done.to_json(curves=True))
    assert again.to_json(curves=True) == done.to_json(curves=True)
    assert again.to_json() == done.to_json()
    assert again.plot().axes


@pytest.mark.parametrize("name", ["fit", "certificate", "diagnosis"])
def test_without_curves_a_figure_is_refused_in_one_line(name):
    done = result(name)
    with pytest.raises(InputError, match=r"found no curves, as it was read from JSON without them; write it with"):
        type(done).from_json(done.to_json()).plot()


@pytest.mark.parametrize("name", [*NAMES, *FURTHER])
def test_curves_are_left_out_unless_they_are_asked_for(name):
    content = json.loads(result(name).to_json())["result"]
    longest = max((len(each["values"]) for each in arrays(content)), default=0)
    assert longest < 60


def arrays(content):
    if isinstance(content, dict):
        if content.get("is") == "array":
            yield content
        for each in content.values():
            yield from arrays(each)
    elif isinstance(content, list):
        for each in content:
            yield from arrays(each)


def test_a_verdict_that_was_edited_is_refused():
    text = result("made-up diagnosis").to_json()
    assert '"verdict": "explained"' in text
    with pytest.raises(InputError, match=r"the text: found another 'verdict' than the one under 'result'"):
        Diagnosis.from_json(text.replace('"verdict": "explained"', '"verdict": "no_gap"', 1))


@pytest.mark.parametrize(
    ("found", "put", "said"),
    [
        ("identify.result.Fit", "certificate.result.Certificate", "found no 'verdict'"),
        ("identify.result.Fit", "os.path.join", "'os.path.join' as a kind of value"),
        ("identify.result.Fit", "cli.main", "'cli.main' as a kind of value"),
        ("identify.result.Fit", "__main__.main", "'__main__.main' as a kind of value"),
        ("identify.result.Fit", "pathlib.PurePath", "'pathlib.PurePath' as a kind of value"),
        ("identify.result.Fit", "results.data.Stored", "'results.data.Stored' as a kind of value"),
        ('"type": "float64"', '"type": "object"', "found an array of object"),
        ('"rms_MPa":', '"rms":', "found no 'rms_MPa'"),
    ],
)
def test_what_to_json_did_not_write_is_refused_in_one_line(found, put, said):
    text = result("fit").to_json()
    assert found in text
    with pytest.raises(InputError, match=rf"^the text: .*{said}.*, expected what to_json writes[^\n]*$"):
        Fit.from_json(text.replace(found, put))


def test_a_certificate_is_no_fit():
    with pytest.raises(InputError, match=r"found the schema 'probation\.fit/1'"):
        Certificate.from_json(result("fit").to_json())


@dataclass(frozen=True, eq=False)
class Unforeseen(Stored, WithCurves):
    """A result with every kind of field that a new result may have."""

    SCHEMA = "probation.unforeseen/1"

    numbers: tuple[float, ...]
    by_name: dict[str, tuple[str, float] | None]
    by_pair: dict[tuple[str, int], bool]
    matrix: np.ndarray
    part: slice
    names: frozenset[str]
    rows: list[int]
    curve: np.ndarray = field(metadata=CURVE)
    function: object = field(default=None, metadata=LEFT_OUT)

    @from_curves
    def largest(self):
        return float(self.curve.max())

    def to_dict(self):
        return {"largest": self.largest}


def test_every_kind_of_field_comes_back_as_it_was_in_another_package_too():
    done = Unforeseen(
        (1.5, np.inf, -0.0),
        {"is": ("a", np.nan), "b": None},
        {("a", 1): True},
        np.array([[1.0, np.nan]]),
        slice(3, None),
        frozenset("xy"),
        [1, 2],
        np.array([1.0, 7.0]),
        print,
    )
    again = Unforeseen.from_json(done.to_json())
    assert (again.numbers, again.by_pair, again.part, again.names, again.rows) == (
        (1.5, np.inf, -0.0),
        {("a", 1): True},
        slice(3, None),
        frozenset("xy"),
        [1, 2],
    )
    assert again.largest == 7.0
    assert again.function is None
    assert encoded(again) == encoded(done)
    with pytest.raises(InputError, match=r"Unforeseen\.curve: found no curves"):
        _ = again.curve
    assert not hasattr(again, "another")


def test_what_cannot_be_written_is_named():
    with pytest.raises(TypeError, match="builtin_function_or_method has no form in JSON"):
        encoded((print,))
