"""A field from samples to maps, interrupted and not; 16 x 16 pixels, in 16 blocks or in one."""

import json
import os
import signal
import subprocess
import sys

import distributed
import numpy as np
import pytest
import zarr

import probation
from probation.bulk import identify_many
from probation.cli import main
from probation.field import identify_field, open_maps
from probation.field.between import between
from probation.field.block import identify_block
from probation.field.example.make import make_example
from probation.field.identify import BlockLostError
from probation.field.maps import FieldMaps
from probation.field.smoothing import smoothed
from probation.pool import WorkersLostError, run_all

BLOCKS, PIXELS = 16, 16
ONE_BLOCK = 256


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    return make_example(tmp_path_factory.mktemp("example"), size=16, times=201, processes=1)


@pytest.fixture(scope="module")
def whole(example, tmp_path_factory):
    """Maps of one uninterrupted run."""
    out = tmp_path_factory.mktemp("whole") / "maps.zarr"
    done = identify_field(example[0], out, pixels=PIXELS, processes=1, threads=1)
    assert (done.now, done.before, done.again) == (BLOCKS, 0, 0)
    return open_maps(out)


@pytest.fixture(scope="module")
def precise(example, tmp_path_factory):
    """Maps by the scheme whose own error is far below the noise, neighbourhoods of 8 x 8 pixels."""
    out = tmp_path_factory.mktemp("precise") / "maps.zarr"
    identify_field(example[0], out, None, "sa3", pixels=ONE_BLOCK, processes=1, threads=1)
    return open_maps(out)


def same(maps, others):
    """Every map equal to the last bit, and every block's seconds there."""
    assert maps.maps.keys() == others.maps.keys()
    for name, values in maps.maps.items():
        np.testing.assert_array_equal(values, others.maps[name], err_msg=name)
    assert maps.blocks_done == others.blocks_done == BLOCKS


def test_the_example_s_material_comes_back_as_near_as_is_told(example, precise):
    """95 % intervals hold the truth: of n pixels, within 3.3 binomial deviations (one in a thousand) of 95 %."""
    found = precise.compared_with(example[1])
    count = np.count_nonzero(precise.identified)
    assert count > 200
    product = found.closeness[0]
    assert product.name == "unrelaxed_modulus_times_tau_max"
    assert abs(product.bias) < 4.0 * product.scatter / np.sqrt(count)
    for each in found.closeness:
        assert each.coverage == pytest.approx(0.95, abs=3.3 * np.sqrt(0.95 * 0.05 / count)), each


@pytest.mark.parametrize("times", [51, 101])
def test_intervals_hold_the_truth_however_far_apart_the_samples_are(times, tmp_path):
    """Steps of 4.5 and 2.2 s at a tau_max of 5 s: bE2 takes the steps between the samples that it needs."""
    field, truth = make_example(tmp_path, size=24, times=times, processes=1)
    identify_field(field, tmp_path / "maps.zarr", pixels=1024, processes=1, threads=1)
    maps = open_maps(tmp_path / "maps.zarr").compared_with(truth)
    assert maps.run["scheme"] == "be2"
    assert maps.substeps[0] > 1
    count = np.count_nonzero(maps.identified)
    assert count > 400
    for each in maps.closeness:
        assert each.coverage == pytest.approx(0.95, abs=3.3 * np.sqrt(0.95 * 0.05 / count)), each


def test_maps_come_back_from_json_with_their_text_and_with_curves_with_their_figure(example, whole):
    maps = whole.compared_with(example[1])
    again = FieldMaps.from_json(maps.to_json())
    assert again.to_json() == maps.to_json()
    assert again.summary() == maps.summary()
    with pytest.raises(probation.InputError, match=r"FieldMaps\.maps: found no curves"):
        again.plot()
    drawn = FieldMaps.from_json(maps.to_json(curves=True))
    assert drawn.to_json(curves=True) == maps.to_json(curves=True)
    assert drawn.plot().axes


def test_the_example_s_stress_does_not_depend_on_how_far_apart_its_samples_are(tmp_path):
    """Every second instant of 41 is one of 21; what differs is noise, and integration to 1e-3 MPa."""
    noise = {"STRAIN_NOISE": 0.0, "FORCE_NOISE": 0.0, "LOST": 0.0, "LOST_LATER": 0.0, "DROPPED": 0.0}
    with pytest.MonkeyPatch.context() as patch:
        for name, value in noise.items():
            patch.setattr(f"probation.field.example.make.{name}", value)
        coarse, fine = (make_example(tmp_path / str(times), size=4, times=times, processes=1)[0] for times in (21, 41))
    stresses = [np.asarray(zarr.open_group(each, mode="r")["true_stress"]) for each in (coarse, fine)]
    there = np.isfinite(stresses[0])
    assert there.any()
    assert stresses[1][:, :, ::2][there] == pytest.approx(stresses[0][there], abs=1e-3)


def test_residuals_are_those_of_the_noise(precise):
    """Four standard deviations are exceeded once in 30 000."""
    ratio = precise.maps["rms_residual"] / precise.maps["noise"]
    assert np.nanmedian(ratio) == pytest.approx(1.0, abs=0.05)
    assert not precise.beyond_noise.any()


def test_background_is_no_data_and_nan(whole):
    nothing = whole.maps["samples"] == 0
    assert nothing[8, 0]
    assert (whole.maps["status"][nothing] == 20).all()
    assert np.isnan(whole.maps["unrelaxed_modulus"][nothing]).all()


def test_what_was_identified_is_what_the_bulk_identification_finds(example, whole):
    """One pixel by hand: no map is moved or mixed up."""
    source = probation.field.open_field(example[0])
    y, x = np.argwhere(whole.identified & (whole.maps["samples"] == len(source.time)))[60]
    strain, stress = source.read(slice(y, y + 1), slice(x, x + 1))
    law = probation.Law(unrelaxed_modulus=1.0, tau_max=1.0, hardening_modulus=1.0)
    zarrs = zarr.open_group(whole.path, mode="r")
    steps = int(zarrs["block_substeps"][y // 4, x // 4])
    fine, driving = between(source.time, smoothed(source.time, strain), steps, smooth=True)
    alone = identify_many(law, fine, driving, stress, whole.run["scheme"], substeps=steps)
    names = ("unrelaxed_modulus", "tau_max", "hardening_modulus")
    assert [whole.maps[name][y, x] for name in names] == pytest.approx(alone.parameters[0], rel=1e-6)


def test_a_killed_run_goes_on_where_it_stopped(example, whole, tmp_path):
    """The process is killed in the moment that the fifth block is done."""
    out = tmp_path / "maps.zarr"
    code = f"""
import os, signal
from probation.field import identify_field
def kill(done, total, what):
    if done == 5:
        os.kill(os.getpid(), signal.SIGKILL)
identify_field({str(example[0])!r}, {str(out)!r}, pixels={PIXELS}, processes=1, threads=1, progress=kill)
"""
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == -signal.SIGKILL
    assert open_maps(out).blocks_done == 5
    assert "unfinished, 5 of 16 blocks" in open_maps(out).summary()
    steps = []
    done = identify_field(example[0], out, pixels=PIXELS, processes=1, progress=lambda *step: steps.append(step[:2]))
    assert (done.now, done.before, done.again) == (BLOCKS - 5, 5, 0)
    assert steps == [(k, BLOCKS) for k in range(6, BLOCKS + 1)]
    same(open_maps(out), whole)


def test_a_block_that_is_not_what_was_written_is_done_again(example, whole, tmp_path):
    out = tmp_path / "maps.zarr"
    identify_field(example[0], out, pixels=PIXELS, processes=1)
    zarr.open_group(out, mode="r+")["hardening_modulus"][5, 5] = 7.0
    done = identify_field(example[0], out, pixels=PIXELS, processes=1)
    assert (done.now, done.before, done.again) == (1, BLOCKS - 1, 1)
    same(open_maps(out), whole)


def test_another_field_law_or_scheme_is_refused(example, tmp_path):
    out = tmp_path / "maps.zarr"
    other = make_example(tmp_path / "other", size=16, times=101, seed=2, processes=1)[0]
    identify_field(example[0], out, pixels=256, processes=1)

    def refused(said, field=example[0], law=None, **changed):
        with pytest.raises(probation.InputError, match=said):
            identify_field(field, out, law, **{"pixels": 256, "processes": 1, **changed})

    refused(r"maps\.zarr: the field has changed, or is another: .* or --afresh", other)
    refused("the scheme is another: found maps begun with scheme be2, expected sa3", scheme="sa3")
    companion = probation.Weissenberg(0.00464, 0.0367)
    refused("the law is another", law=probation.Law(unrelaxed_modulus=1.0, hardening_modulus=1.0, companion=companion))
    refused("the law is another", hold={"unrelaxed_modulus_MPa": 3000.0})
    refused("the strain is smoothed, or not", smoothing=False)
    refused("the blocks are others", pixels=16)
    refused("the steps from sample to sample are others: found maps begun with substeps auto, expected 1", substeps=1)
    refused("substeps is 0; expected 'auto' or a whole number from 1", substeps=0)
    done = identify_field(other, out, pixels=256, processes=1, afresh=True)
    assert (done.now, done.before) == (1, 0)


def test_nothing_but_maps_is_ever_removed(example, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("years")
    with pytest.raises(probation.InputError, match=r"mine: found the schema 'none', expected"):
        identify_field(example[0], tmp_path / "mine", processes=1, afresh=True)
    assert (tmp_path / "mine" / "thesis.txt").read_text() == "years"


def test_a_held_parameter_and_a_companion_relation(example, tmp_path):
    law = probation.Law(unrelaxed_modulus=1.0, hardening_modulus=1.0, companion=probation.Weissenberg(0.0, 0.05))
    identify_field(example[0], tmp_path / "maps.zarr", law, hold={"hardening_modulus_MPa": 1.8}, processes=1)
    maps = open_maps(tmp_path / "maps.zarr")
    assert "alpha" in maps.maps
    good = maps.identified
    assert (maps.maps["hardening_modulus"][good] == 1.8).all()
    assert (maps.maps["hardening_modulus_standard_error"][good] == 0.0).all()
    assert maps.beyond_noise.any()  # tau_max of this field does not follow the rate
    with pytest.raises(probation.InputError, match="'tau_max_s' is not a parameter of this law"):
        identify_field(example[0], tmp_path / "more.zarr", law, hold={"tau_max_s": 5.0})


def test_the_command_on_a_cluster_then_in_words_pictures_and_json(cluster, example, whole, tmp_path, capsys):
    out = tmp_path / "maps.zarr"
    identify = ["field", "identify", str(example[0]), "--out", str(out), "--pixels", str(PIXELS)]
    assert main([*identify, "--scheduler", cluster.scheduler_address]) == 0
    same(open_maps(out), whole)
    answer, picture = tmp_path / "answer.json", tmp_path / "maps.png"
    told = capsys.readouterr().out
    assert " of 256 pixels identified; the residual of " in told.splitlines()[0]
    assert "16 blocks done now, 0 before" in told
    page = tmp_path / "maps.html"
    arguments = ["--truth", str(example[1]), "--json", str(answer), "--plot", str(picture), "--report", str(page)]
    assert main(["field", "map", str(out), *arguments]) == 0
    assert "against the truth" in capsys.readouterr().out
    assert " of 256 pixels identified" in page.read_text(encoding="utf-8")
    content = json.loads(answer.read_text())
    assert content["schema"] == "probation.field/1"
    assert content["blocks"] == {"done": BLOCKS, "all": BLOCKS}
    assert content["run"]["scheme"] == "be2"
    assert sum(content["pixels"].values()) == 256
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_workers_killed_half_way_lose_nothing_and_count_nothing_twice(cluster, example, whole, tmp_path):
    """One dies with half of a block written, one after its block was marked and before it could tell."""
    out = tmp_path / "maps.zarr"
    half, told = tmp_path / "half", tmp_path / "told"

    def dies(task, block):
        if block == (1, 2) and not half.exists():
            half.touch()
            zarr.open_group(task.store.path, mode="r+")["status"][task.store.grid.slices(block)] = 5
            os.kill(os.getpid(), signal.SIGKILL)
        identify_block(task, block)
        if block == (2, 1) and not told.exists():
            told.write_text(str(zarr.open_group(task.store.path, mode="r")["block_cpu_seconds"][block]))
            os.kill(os.getpid(), signal.SIGKILL)
        return block

    with pytest.MonkeyPatch.context() as patch, distributed.Client(cluster) as client:
        patch.setattr("probation.field.identify.identify_block", dies)
        with client.get_executor() as executor:
            done = identify_field(example[0], out, pixels=PIXELS, executor=executor)
    assert half.exists()
    assert (done.now, done.before, done.again) == (BLOCKS, 0, 0)
    same(open_maps(out), whole)
    seconds = zarr.open_group(out, mode="r")["block_cpu_seconds"]
    assert str(seconds[2, 1]) == told.read_text()  # what was done was not done again


def test_a_block_that_kills_every_worker_is_named(cluster, example, tmp_path, monkeypatch):
    """The scheduler is set to give up at the second death instead of the fourth; four tasks at once are enough."""
    monkeypatch.setattr(cluster.scheduler, "allowed_failures", 1)

    def dies(task, block):
        if block == (0, 1):
            os.kill(os.getpid(), signal.SIGKILL)
        return identify_block(task, block)

    monkeypatch.setattr("probation.field.identify.identify_block", dies)
    said = r"died while they had block \(0, 1\).* fewer --pixels than 64; what is"
    with (
        distributed.Client(cluster) as client,
        client.get_executor() as executor,
        pytest.raises(BlockLostError, match=said),
    ):
        identify_field(example[0], tmp_path / "maps.zarr", pixels=64, executor=executor)


def test_processes_give_the_same_maps(example, whole, tmp_path):
    identify_field(example[0], tmp_path / "maps.zarr", pixels=PIXELS, processes=2)
    same(open_maps(tmp_path / "maps.zarr"), whole)


def test_a_process_that_dies_ends_the_run_and_its_blocks_are_named():
    with pytest.raises(WorkersLostError, match=r"died while they had 7$") as caught:
        run_all(os._exit, {7: (1,)}, processes=2, executor=None, progress=None, on_done=None)
    assert caught.value.keys == (7,)


def test_the_command_makes_the_example(tmp_path, capsys):
    make = ["field", "example", "--size", "4", "--times", "20", "--out", str(tmp_path), "--processes", "1"]
    assert main(make) == 0
    assert main(make) == 2
    assert "field.zarr: found it there, expected another --out" in capsys.readouterr().err
    assert main(["field"]) == 2
    assert main(["field", "map", str(tmp_path / "field.zarr")]) == 2
    assert "expected 'probation.field/1', as probation field identify writes" in capsys.readouterr().err
    assert main(["field", "identify", str(tmp_path / "field.zarr"), "--out", "x", "--column", "time"]) == 2
    assert "--column: found 'time', expected ROLE=NAME" in capsys.readouterr().err


def test_a_block_that_was_not_written_is_noticed(example, tmp_path, monkeypatch):
    monkeypatch.setattr("probation.field.identify.identify_block", lambda task, block: block)
    with pytest.raises(BlockLostError, match=r"block \(0, 0\) was done and is not marked"):
        identify_field(example[0], tmp_path / "maps.zarr", processes=1)
