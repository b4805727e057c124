"""What commands print fits a terminal of 80 columns, however long the names of records are."""

import argparse
from dataclasses import replace

import pytest

import probation
from campaigns.few_records import few_records
from campaigns.typical_results import NAMES, result
from lab_files import bluehill
from probation import Campaign, init_campaign, preview
from probation.cli import build_parser, main
from probation.commands.help_text import fitted
from probation.report.table import Table
from probation.smoothing.answer import describe_excitation
from probation.wording import WIDTH, within_width

LONG = "load-unload at 23 C, specimen 14 of batch HD-2020-B, left grip renewed, "


def renamed(campaign: Campaign) -> Campaign:
    return replace(campaign, records=tuple(replace(each, id=LONG + each.id) for each in campaign.records))


def too_long(text):
    """Lines beyond the terminal's width that could be broken: more than one word and its indentation."""
    return [line for line in text.splitlines() if len(line) > WIDTH and len(line.split()) > 1]


@pytest.mark.parametrize("name", NAMES)
def test_a_summary_fits(name):
    assert too_long(result(name).summary()) == []


@pytest.mark.parametrize(
    "ask",
    [
        probation.fit,
        probation.certify,
        lambda campaign: probation.diagnose(campaign, effects=["force_offset"], threads=1, design=False),
        lambda campaign: probation.compare(campaign, campaign, effects=["force_offset"]),
        lambda campaign: describe_excitation(campaign.records),
    ],
    ids=["fit", "certify", "diagnose", "compare", "excitation"],
)
def test_long_names_of_records_do_not_widen_it(ask):
    assert too_long(ask(renamed(few_records(names=("slow", "middle"), held_out=("middle",)))).summary()) == []


def test_files_of_a_laboratory_with_long_names_fit(tmp_path):
    path = tmp_path / f"{LONG}.csv"
    bluehill(path)
    assert too_long(preview(path).summary()) == []
    assert too_long(init_campaign([path], tmp_path / "made").summary()) == []


def test_a_command_prints_no_wider_line(capsys, tmp_path):
    bluehill(tmp_path / "a.csv")
    assert main(["preview", str(tmp_path / "a.csv")]) == 0
    assert too_long(capsys.readouterr().out) == []


def test_a_long_line_goes_on_below_and_a_line_that_fits_stays():
    drawn = "  " + "│   *" * 15
    text = within_width(f"{'word ' * 30}\n{drawn}\n  {'word ' * 30}")
    first, *rest = text.splitlines()
    assert first == ("word " * 16).strip()
    assert drawn in rest
    assert rest[-1].startswith("    word")
    assert within_width(text) == text


def test_a_word_that_is_too_long_stays_whole_so_that_it_can_be_copied():
    path = "/data/" + "x" * 100
    assert path in within_width(f"wrote the campaign to {path} today")


def test_a_wide_table_breaks_its_words_and_gives_every_column_its_share():
    table = Table(("effect", "what it does", "n"), (("heating " * 6, "softens the law " * 6, "12"),), left=2)
    lines = table.text().splitlines()
    assert max(map(len, lines)) <= WIDTH
    assert len(lines) == 2 + 3  # 48 and 96 letters share 75 columns
    assert lines[2].endswith("12")


def test_a_table_of_too_many_numbers_goes_on_below_under_the_first_column():
    headings = ("record", *(f"quantity-{at} [MPa]" for at in range(12)))
    rows = (("slow", *("1.234567",) * 12), ("fast", *("7.654321",) * 12))
    lines = Table(headings, rows, "Numbers").text().splitlines()
    assert max(map(len, lines)) <= WIDTH
    assert lines[0] == "Numbers"
    assert sum(line.startswith("  slow ") for line in lines) > 1
    assert sum(line.count("1.234567") for line in lines) == 12


def _helps(parser, name="probation"):
    yield name, parser.format_help()
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for command, own in action.choices.items():
                yield from _helps(own, f"{name} {command}")


def test_the_help_of_every_command_fits(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    helps = dict(_helps(build_parser()))
    assert {"probation", "probation fit", "probation field identify", "probation blind make"} <= set(helps)
    for name, text in helps.items():
        assert [line for line in text.splitlines() if len(line) > WIDTH] == [], name


def test_an_example_is_broken_where_a_shell_goes_on_and_its_remark_stands_below():
    text = "  probation export fit.json --format calculix --accuracy 1e-3      of what fit --json wrote"
    assert fitted(text, 50) == (
        "  probation export fit.json --format calculix \\\n      --accuracy 1e-3\n      of what fit --json wrote"
    )
    assert fitted(text, 100) == text


def test_prose_is_filled_and_a_word_keeps_its_meaning_beside_it():
    text = "One two\nthree four.\nFive.\n\n  where  in which records,\n         and in which parts"
    assert fitted(text, 20) == (
        "One two three four.\nFive.\n\n  where  in which\n         records,\n         and in\n         which parts"
    )


def test_many_choices_are_listed_in_the_help_of_their_option(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "80")
    assert main(["fit", "--help"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "--excitation EXCITATION" in shown
    assert "quintic-spline, spline, savitzky-golay" in shown


def test_a_table_never_breaks_what_belongs_together():
    rate = "−25.5 % (−34.0\N{NO-BREAK SPACE}to\N{NO-BREAK SPACE}−18.2\N{NO-BREAK SPACE}%)"
    table = Table(("aim", "wanted", "reached", "met"), (("x" * 20, "y" * 20, rate, "z" * 20),), left=3)
    assert rate.split(" (")[1] in table.text()
