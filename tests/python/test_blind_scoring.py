"""Seals, answers and scores, with answers that are made up."""

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from bench.laboratories import HEAD, contents_of, head_by, row, rows_by
from scipy.stats import binom

from campaigns.made_up_truth import made_up_truth
from probation.cli import main
from probation.errors import InputError
from probation.pool import run_all
from probation_studies.blind.layout import Layout
from probation_studies.blind.make import make_split
from probation_studies.blind.score import score_split
from probation_studies.blind.scores.answer import NO_ANSWER, Answer, Region, read_answer
from probation_studies.blind.scores.baselines import majority, shuffled
from probation_studies.blind.scores.board import board
from probation_studies.blind.scores.case import Case, oracle_answer
from probation_studies.blind.scores.intervals import Rate
from probation_studies.blind.scores.probabilities import area_under_curve, brier_score, log_score, reliability
from probation_studies.blind.scores.where import overlap
from probation_studies.blind.seal import open_truth, read_truth, seal_truth
from probation_studies.blind.solve import solve_split
from probation_studies.blind.solvers import solver_named


def _diagnosis(probabilities, answer_set=None, verdict=None, records=("a",), where=()):
    """An answer as docs/formats.md has it, from probabilities of tuples of names."""
    best = max(probabilities, key=lambda names: probabilities[names])
    entries = {(): 0.0, ("unknown",): 0.0} | probabilities
    return {
        "schema": "probation.diagnosis/1",
        "verdict": verdict or ("no_gap" if best == () else "unexplained" if "unknown" in best else "explained"),
        "headline": "made up",
        "base": {"parameters": {"unrelaxed_modulus_MPa": {"value": 2001.0, "se": 1.0, "status": "identifiable"}}},
        "causes": [
            {"effects": list(names), "records": list(records), "probability": p, "parameters": {}}
            for names, p in sorted(entries.items(), key=lambda item: -item[1])
        ],
        "answer_set": [list(names) for names in (answer_set or [best])],
        "where": [{"record": r, "time_s": [s, e], "share": 1.0} for r, s, e in where],
        "shrink": {"identify": {"closure": 0.99, "interval": [0.97, 1.01]}, "held_out": None},
    }


def _perfect(truth):
    windows = [(w["record"], *w["time_s"]) for cause in truth["causes"] for w in cause["windows"]]
    return _diagnosis({tuple(truth["explanation"]): 1.0}, where=windows)


def _cases(truths, answer=_perfect):
    return [Case(f"c{k}", truth, read_answer(answer(truth), "made up")) for k, truth in enumerate(truths)]


MIXED = (
    [made_up_truth() for _ in range(40)]
    + [made_up_truth((name,), localised=name == "grip_slip", everywhere=False) for name in ("damage", "grip_slip") * 10]
    + [made_up_truth(("damage", "force_offset")) for _ in range(10)]
    + [made_up_truth(("unknown",), "outside") for _ in range(10)]
)


def test_a_perfect_solver_scores_everything():
    scores = board(_cases(MIXED))
    for name, n in (("none", 40), ("single", 20), ("pair", 10), ("outside", 10)):
        group = scores["by_stratum"][name]
        assert (group["n"], group["top1"]["rate"], group["answer_set"]["coverage"]["rate"]) == (n, 1.0, 1.0)
        assert (group["probability_on_truth"], group["log_score"], group["brier_score"]) == (1.0, 0.0, 0.0)
    assert scores["false_alarms"]["k"] == 0
    assert scores["detection"]["15"]["rate"] == 1.0
    assert scores["unknown"]["auroc"] == scores["unknown"]["auroc_clear"] == 1.0
    assert 0.0 <= scores["unknown"]["level_at_5_percent_false_alarms"] < 1.0
    assert scores["where"]["mean_overlap"] == 1.0
    assert scores["where"]["right_record"]["rate"] == 1.0
    assert scores["exact_pairs"]["rate"] == 1.0
    assert scores["reliability"]["ece"] == 0.0
    assert scores["confusion"]["none"] == {"none": 40}
    assert scores["base_parameters"]["none"]["rate"] == 1.0


def test_an_oracles_set_has_one_level_in_every_laboratory():
    """Of 0.6, 0.33, 0.05 and 0.02 three are needed for 0.95, whatever set a laboratory wrote down."""
    truth = made_up_truth(("damage",))
    posterior = {"": 0.02, "damage": 0.6, "prestress": 0.33, "damage+prestress": 0.05}
    truth["oracle"] |= {"posterior": posterior, "answer_set": [["damage"], ["prestress"]]}
    case = Case("one", truth, read_answer(_diagnosis({("damage",): 0.9, (): 0.1}), "made up"))
    assert oracle_answer(truth).answer_set == (("damage",), ("prestress",), ("damage", "prestress"))
    assert board([case])["gaps"]["answer_set"]["oracle_mean_size"] == 3.0


def test_false_alarms_are_counted_apart_where_specimens_differ_and_where_strains_are_noisy():
    """Replicates of a null are nulls; a truth says in its own keys or in its noise's by how much specimens differ.

    An answer says whether it has that from replicates.
    """
    kinds = ({"noise": {"strain": 1e-3}}, {"scatter": {"modulus": 0.02}, "stratum": "replicates"})
    kinds += ({"noise": {"strain": 1e-4, "scatter_tau": 0.01}}, {"scatter": None, "noise": {"scatter_tau": 0.0}})
    alarm = _diagnosis({("damage",): 0.9, ("unknown",): 0.1})
    shown = alarm | {"scatter": {"alpha": {"relative": 0.02, "source": "replicates"}}}
    found = board(
        _cases([made_up_truth() | kind for kind in kinds], lambda truth: shown if truth.get("scatter") else alarm)
    )
    assert found["by_stratum"]["none"]["n"] == 4
    assert {name: each["n"] for name, each in found["false_alarms_by_kind"].items()} == {
        "alike": 2,
        "differing": 2,
        "replicates": 1,
        "strain_noise_to_5e-4": 3,
    }
    assert all(each["rate"] == 1.0 for each in found["false_alarms_by_kind"].values())


def test_a_truth_need_not_say_what_is_left_of_every_record():
    truth = made_up_truth(("damage",)) | {"noise_drawn_MPa": {"a": 0.04}}
    truth["records"]["b"]["role"] = "held-out"
    case = _cases([truth])[0]
    assert case.squares("noise_drawn_MPa", "identify") == pytest.approx(0.04**2)
    assert case.squares("noise_drawn_MPa", "held-out") is None


def test_a_row_of_the_laboratories_page_is_made_of_a_score():
    content = {
        "laboratory": "university",
        "campaigns": len(MIXED),
        "seeds": [3],
        "scores": {"answers": board(_cases(MIXED))},
    }
    cells = row(content)
    assert len(cells) == len(HEAD)
    assert cells[:3] == ["university", str(len(MIXED)), "3"]
    assert cells[HEAD.index("single, resolvable: named")].startswith("100 % of ")
    assert cells[HEAD.index("P of the truth")] == "1.00 (1.00 to 1.00)"
    assert cells[HEAD.index("their size, over the oracle's")] == "1.00 (1.00 to 1.00)"
    assert cells[HEAD.index("calibration error")] == "0.000; below 0.000 if calibrated"
    assert cells[HEAD.index("held-out explained fraction, over the oracle's")] == "–, n = 0"


def _answered(folder, truths):
    """A sealed folder with answers that are right, but for the last one, which failed."""
    for name in ("truths", "answers"):
        (folder / name).mkdir(parents=True)
    (folder / "seals.json").write_text(json.dumps({"laboratory": folder.name, "seals": {"test-0": ""}}))
    for index, truth in enumerate(truths):
        seal_truth(json.dumps(truth)).write(folder / "truths" / f"test-{index}.json")
        content = {"diagnosis": _perfect(truth)} if index + 1 < len(truths) else {"error": "made up"}
        (folder / "answers" / f"test-{index}.json").write_text(json.dumps(content))
    return folder


def test_several_folders_have_a_row_of_all_their_campaigns_together(tmp_path):
    ours = _answered(tmp_path / "university", [made_up_truth(("damage",))] * 4)
    other = _answered(tmp_path / "industry", [made_up_truth(("damage",)) | {"seed": 5}] * 6)
    lines = [dict(zip(HEAD, row(content), strict=True)) for content in contents_of([ours, other])]
    assert [line["laboratory"] for line in lines] == ["university", "industry", "all"]
    assert [line["seeds"] for line in lines] == ["3", "5", "3, 5"]
    named = [line["single, resolvable: named"].split(" (")[0] for line in lines]
    assert named == ["75 % of 4", "83 % of 6", "80 % of 10"]
    assert lines[-1]["P of the truth"].startswith("0.80 (")
    assert [row(content) for content in contents_of([ours])] == [list(lines[0].values())]


def test_scores_by_strain_noise_count_every_campaign_once():
    """Nulls at 1e-5 and with nothing said, causes at 1e-4, all declared damage; the last class is empty."""
    quiet, usual = {"noise": {"strain": 1e-5}}, {"noise": {"strain": 1e-4}}
    truths = [
        made_up_truth() | quiet,
        made_up_truth(),
        *(made_up_truth((name,)) | usual for name in ("damage", "self_heating", "damage")),
    ]
    content = {"seeds": [3], "scores": {"answers": board(_cases(truths, lambda _: _diagnosis({("damage",): 1.0})))}}
    lines = rows_by("by_strain_noise", content)
    assert all(len(line) == len(head_by("by_strain_noise")) for line in lines)
    assert [line[:3] for line in lines] == [["own", "3", "to 2e-5"], ["own", "3", "to 2e-4"]]
    assert [[cell.split(" (")[0] for cell in line[3:]] for line in lines] == [
        ["100 % of 2", "–", "–"],
        ["–", "67 % of 3", "67 % of 3"],
    ]


def test_scores_by_strength_count_causes_alone():
    """A null, and causes of a √λ of 10, 20 and 300, all declared damage."""
    causes = [
        made_up_truth((name,)) | {"detectability": size}
        for name, size in (("damage", 10), ("damage", 20), ("lag", 300))
    ]
    cases = _cases([made_up_truth(), *causes], lambda _: _diagnosis({("damage",): 1.0}))
    lines = rows_by("by_strength", {"seeds": [3], "scores": {"answers": board(cases)}})
    assert [line[2] for line in lines] == ["to 10", "to 30", "above"]
    assert [line[4].split(" (")[0] for line in lines] == ["100 % of 1", "100 % of 1", "0 % of 1"]


def test_shuffled_answers_score_chance():
    """Of a balanced two-way truth, right by chance: k of 400 within six standard deviations of 200."""
    truths = [made_up_truth((name,)) for name in ("damage", "self_heating") * 200]
    right = sum(case.right for case in shuffled(_cases(truths)))
    assert abs(right - 200) < 6 * 10.0


def test_the_majority_knows_the_frequencies_and_nothing_else():
    """40 of 80 are none: right in a half, ln P the entropy of (40, 10, 10, 10, 10) / 80."""
    cases = majority(_cases(MIXED))
    parts = np.array([40, 10, 10, 10, 10]) / 80
    assert Rate.of(case.right for case in cases).value == 0.5
    assert log_score(cases) == pytest.approx(np.sum(parts * np.log(parts)))
    assert brier_score(cases) == pytest.approx(1.0 - np.sum(parts**2))


def test_intervals_are_those_of_clopper_and_pearson():
    """At each bound the observed or a more extreme number has probability 2.5 %; 0 of 300 ends at 1 - 0.025^(1/300)."""
    low, high = Rate(3, 250).interval
    assert binom.sf(2, 250, low) == pytest.approx(0.025)
    assert binom.cdf(3, 250, high) == pytest.approx(0.025)
    assert Rate(0, 300).interval == (0.0, pytest.approx(1.0 - 0.025 ** (1 / 300)))


def test_an_honest_solver_is_calibrated_and_a_boaster_is_not():
    def cases(said, right):
        other = ("damage",)
        truths = [made_up_truth() if hit else made_up_truth(other) for hit in right]
        return [Case("c", t, Answer({(): said, ("unknown",): 1.0 - said}, {}, (), gap=False)) for t in truths]

    right = [k % 10 < 7 for k in range(200)]
    honest, boasting = reliability(cases(0.7, right)), reliability(cases(0.99, right))
    assert honest["ece"] == pytest.approx(0.0, abs=1e-12)
    assert boasting["ece"] == pytest.approx(0.29)
    assert boasting["ece"] > boasting["ece_limit95"]


def test_the_calibration_error_of_a_calibrated_solver_stays_below_its_limit_in_95_percent_of_repeats():
    """Says 0.55 to 0.95 of 26 cases: in all of 40 repeats but a few (P < 0.2 %)."""
    random, held = np.random.default_rng(3), []
    for _ in range(40):
        said = random.uniform(0.55, 0.95, size=26)
        truths = [made_up_truth() if hit else made_up_truth(("damage",)) for hit in random.uniform(size=26) < said]
        answers = [Answer({(): p, ("unknown",): 1.0 - p}, {}, (), gap=False) for p in said]
        found = reliability([Case("c", truth, answer) for truth, answer in zip(truths, answers, strict=True)])
        held.append(found["ece"] <= found["ece_limit95"])
    assert 33 <= sum(held) < 40


def test_area_under_the_curve_counts_pairs():
    """Positives 3, 1 over negatives 2, 1: 2 + 1/2 of 4 pairs."""
    assert area_under_curve([3.0, 1.0], [2.0, 1.0]) == pytest.approx(2.5 / 4)
    assert area_under_curve([], [1.0]) is None


def test_overlap_weighs_records_by_their_duration():
    """20-60 against 40-80 of 100 s: 0.2 / 0.6; half of another record of 50 s beside: 0.2 / (0.6 + 0.5)."""
    durations = {"a": 100.0, "b": 50.0}
    one, other = [Region("a", 20.0, 60.0)], [Region("a", 40.0, 70.0), Region("a", 60.0, 80.0)]
    assert overlap(one, other, durations) == pytest.approx(0.2 / 0.6)
    assert overlap(one, [*other, Region("b", 0.0, 25.0)], durations) == pytest.approx(0.2 / 1.1)
    assert overlap([], [], durations) == 0.0


def test_a_mimic_may_be_called_what_it_mimics_in_the_answer_set_only():
    truth = made_up_truth(("unknown",), "mimic", mimics="damage")
    case = _cases([truth], lambda _: _diagnosis({("damage",): 0.9, ("unknown",): 0.1}))[0]
    assert not case.right
    assert case.covered


def test_a_failed_answer_is_wrong_in_everything():
    case = Case("c", made_up_truth(), NO_ANSWER)
    assert (case.right, case.covered, case.probability) == (False, False, 0.0)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda answer: answer.pop("causes"),
        lambda answer: answer["causes"][0].update(probability=0.5),
        lambda answer: answer["causes"][0].update(probability="much"),
        lambda answer: answer.update(verdict="perhaps"),
        lambda answer: answer.update(answer_set=["damage"]),
    ],
)
def test_an_answer_of_another_form_is_named(spoil):
    answer = _diagnosis({(): 1.0})
    spoil(answer)
    with pytest.raises(InputError, match=r"split/answers/x\.json.*the form of"):
        read_answer(answer, "split/answers/x.json")


def test_a_seal_breaks_with_one_changed_digit(tmp_path):
    sealed = seal_truth('{"stratum": "none", "x": 1}')
    path = tmp_path / "t.json"
    sealed.write(path)
    assert open_truth(path, sealed.seal) == {"stratum": "none", "x": 1}
    path.write_text(path.read_text().replace("1}", "2}"))
    with pytest.raises(InputError, match=r"changed after it was sealed"):
        open_truth(path, sealed.seal)


def test_equal_truths_have_different_seals():
    assert seal_truth("{}").seal != seal_truth("{}").seal


def _publish(folder: Path, truths) -> Layout:
    """A split with truths that are made up; its campaigns are empty."""
    layout = Layout(folder)
    layout.truths.mkdir(parents=True)
    seals = {}
    for k, truth in enumerate(truths):
        name = f"develop-{k:04d}"
        (layout.campaigns / name).mkdir(parents=True)
        (layout.campaigns / name / "campaign.toml").write_text(f'name = "{name}"\n')
        sealed = seal_truth(json.dumps(truth))
        sealed.write(layout.truths / f"{name}.json")
        seals[name] = sealed.seal
    (folder / "seals.json").write_text(json.dumps({"split": "develop", "seals": seals}))
    return layout


def _knows(layout):
    return lambda folder: _perfect(json.loads(read_truth(layout.truths / f"{folder.name}.json").text))


@pytest.fixture
def split(tmp_path):
    return _publish(tmp_path / "split", MIXED[35:45])


def test_answers_are_kept_one_by_one_and_an_interruption_loses_none(split):
    calls = []

    def stops_at_the_fifth(folder):
        calls.append(folder.name)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return _knows(split)(folder)

    with pytest.raises(KeyboardInterrupt):
        solve_split(split.folder, stops_at_the_fifth, processes=1)
    assert len(list(split.answers.glob("develop-*.json"))) == 4
    done = solve_split(split.folder, stops_at_the_fifth, processes=1)
    assert (done.before, done.now, done.failed) == (4, 6, {})
    assert len(calls) == 5 + 6
    answer = json.loads(next(split.answers.glob("develop-*.json")).read_text())
    assert {"version", "commit", "at"} <= set(answer["answered"])
    assert score_split(split.folder).content["scores"]["answers"]["by_stratum"]["none"]["top1"]["rate"] == 1.0


def test_a_failure_is_kept_said_and_tried_again(split):
    def fails_once(folder):
        if folder.name.endswith("3"):
            raise RuntimeError("no convergence")
        return _knows(split)(folder)

    done = solve_split(split.folder, fails_once, processes=1)
    assert done.failed == {"develop-0003": "RuntimeError: no convergence"}
    again = solve_split(split.folder, _knows(split), processes=1)
    assert (again.before, again.now) == (9, 1)


def test_another_executor_gives_the_same_answers(split, tmp_path):
    """As a cluster's client offers one."""
    solve_split(split.folder, _knows(split), processes=1)
    with ThreadPoolExecutor(2) as executor:
        solve_split(split.folder, _knows(split), answers=tmp_path / "other", executor=executor)
    for path in split.answers.glob("develop-*.json"):
        other = json.loads((tmp_path / "other" / path.name).read_text())
        assert other["diagnosis"] == json.loads(path.read_text())["diagnosis"]


def test_answers_after_the_opening_are_refused(split):
    solve_split(split.folder, _knows(split), processes=1)
    score_split(split.folder)
    score_split(split.folder)
    solve_split(split.folder, lambda folder: _diagnosis({(): 1.0}), processes=1, again=True)
    with pytest.raises(InputError, match=r"not there when the truths were opened"):
        score_split(split.folder)
    assert score_split(split.folder, after_opening=True).content["answers_after_opening"] == 10


def test_answers_to_other_data_are_refused(split):
    solve_split(split.folder, _knows(split), processes=1)
    (split.campaigns / "develop-0002" / "campaign.toml").write_text("name = 'changed'\n")
    with pytest.raises(InputError, match=r"develop-0002.*other data"):
        score_split(split.folder)


def test_a_missing_answer_is_named(split):
    with pytest.raises(InputError, match=r"no answer to develop-0000 and 9 more.*blind solve"):
        score_split(split.folder)


def test_other_answers_are_scored_beside(split, tmp_path):
    solve_split(split.folder, _knows(split), processes=1)
    solve_split(split.folder, lambda folder: _diagnosis({(): 1.0}), answers=tmp_path / "none", processes=1)
    steps = []
    score = score_split(
        split.folder, beside={"always none": tmp_path / "none"}, progress=lambda *said: steps.append(said)
    )
    scores = score.content["scores"]
    assert [what for _, _, what in steps] == [
        "opening the truths",
        *(
            "the answers" if name == "answers" else name if name == "always none" else f"the baseline {name}"
            for name in scores
        ),
    ]
    assert all(done < total for done, total, _ in steps)
    assert scores["always none"]["by_stratum"]["single"]["top1"]["rate"] == 0.0
    assert scores["oracle"]["by_stratum"]["single"]["top1"]["rate"] == 1.0
    assert set(scores) == {"answers", "majority", "oracle", "shuffled", "always none"}


def test_processes_of_their_own_do_every_job():
    found = {}
    jobs = {k: (k, 2) for k in range(9)}
    run_all(pow, jobs, processes=2, executor=None, progress=None, on_done=found.__setitem__)
    assert found == {k: k**2 for k in range(9)}


def test_made_solved_and_scored_on_the_command_line(tmp_path, capsys):
    folder = tmp_path / "split"
    make = ["blind", "make", "--seed", "1", "--count", "2", "--out", str(folder), "--truths", str(tmp_path / "kept")]
    assert main([*make, "--processes", "1"]) == 0
    assert not list(folder.rglob("*truth*"))
    published = "".join(path.read_text() for path in folder.rglob("*") if path.is_file() and path.suffix != ".csv")
    assert "seed" not in published
    before = (folder / "seals.json").read_text()
    assert main([*make, "--processes", "1"]) == 0  # all there: the seals stay
    assert json.loads((folder / "seals.json").read_text())["seals"] == json.loads(before)["seals"]
    solver = "probation_studies.blind.example:no_gap"
    assert main(["blind", "solve", str(folder), "--solver", solver, "--processes", "1"]) == 0
    capsys.readouterr()
    page = tmp_path / "score.html"
    score = ["blind", "score", str(folder), "--truths", str(tmp_path / "kept"), "--report", str(page)]
    assert main([*score, "--json", "-"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["schema"] == "probation.blind.score/1"
    assert told["scores"]["answers"]["by_stratum"]["none"]["top1"]["rate"] == 1.0
    assert told["seeds"] == [1]
    assert told["aims"][0]["aim"] == "false alarms on nulls"
    assert "By detectability" in page.read_text()
    for bound, status, said in (("at_most", 0, ""), ("at_least", 1, "failed: campaigns: found 2, required at least 3")):
        required = tmp_path / "thresholds.json"
        required.write_text(json.dumps({"require": {"campaigns": {bound: 3}}}))
        assert main([*score, "--require", str(required)]) == status
        assert said in capsys.readouterr().err


def test_another_plan_in_the_same_folder_is_refused(tmp_path):
    (tmp_path / "truths").mkdir()
    (tmp_path / "truths" / "plan.json").write_text('{"split": "develop", "seed": 1, "count": 2}')
    with pytest.raises(InputError, match=r"found a split made with.*'seed': 1"):
        make_split(tmp_path, seed=2, count=2)


@pytest.mark.parametrize("name", ["nowhere:solve", "probation.cli", "probation.cli:nothing"])
def test_an_unknown_solver_is_named(name):
    with pytest.raises(InputError, match="solver"):
        solver_named(name)
