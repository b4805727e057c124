"""Text from files is data: what does not print is shown escaped, and markup of any kind is shown as it stands."""

import io
import json
import sys
import time
from xml.etree import ElementTree

import numpy as np
import pytest

import probation
from probation import cli
from probation._text import printable, printable_lines, printed_escaped
from probation.answers import json_answer
from probation.commands import progress
from probation.commands.delivery import tell
from probation.commands.progress import shown
from probation.exporting.exporting import export_law
from probation.exporting.formats import FORMATS
from probation.exporting.header import c_comment, commented, header_lines
from probation.exporting.request import Request
from probation.records.campaign import Campaign
from probation.records.record import Record
from probation.report.figures import figure_to_svg, house_style, new_figure, save_figure
from probation.report.page import Page, Section, picture
from probation.report.table import Table

HOSTILE = "a\x1b[31mred\x9b2J\x07\x7f\n\u202egnp.exe\u2066\u200b\u2028\ud800 */ $\\frac{$ [bold] <b> end"
ESCAPED = (
    "a\\u001b[31mred\\u009b2J\\u0007\\u007f\\n\\u202egnp.exe\\u2066\\u200b\\u2028\\ud800 */ $\\frac{$ [bold] <b> end"
)


def is_harmless(text):
    """Nothing but printable characters, spaces and line ends."""
    return printable_lines(text) == text


def record(name="a"):
    time = np.linspace(0.0, 10.0, 21)
    return Record(name, time, 0.01 * time, 3.0 * time)


def test_what_does_not_print_is_escaped_and_all_else_stays():
    assert printable(HOSTILE) == ESCAPED
    assert printable(ESCAPED) == ESCAPED
    ordinary = "Versuch 3 – ε̇ = 0,01 1/s, 20 °C, 时间\u00a0μ 'x' \\ 😀"
    assert printable(ordinary) == ordinary
    assert printable("\U000e0001") == "\\udb40\\udc01"


def test_names_of_records_and_campaigns_are_one_printable_line_from_the_start():
    made = record(HOSTILE)
    campaign = Campaign(HOSTILE, (made,))
    assert made.id == campaign.name == ESCAPED
    assert campaign.record(HOSTILE) is made
    assert campaign.record(ESCAPED) is made


def test_names_in_a_campaign_file_are_too_and_come_back_from_a_saved_one(tmp_path):
    name = HOSTILE.replace("\ud800", "")
    Campaign("x", (record(),)).save(tmp_path)
    text = (tmp_path / "campaign.toml").read_text()
    text = text.replace('name = "x"', f"name = {json.dumps(name)}".replace("\x7f", "\\u007f"))
    (tmp_path / "campaign.toml").write_text(text)
    loaded = Campaign.load(tmp_path)
    assert loaded.name == printable(name)
    loaded.save(tmp_path / "again")
    assert Campaign.load(tmp_path / "again").name == loaded.name


def test_all_that_the_command_line_prints_is_escaped(monkeypatch):
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    out, error = sys.stdout, sys.stderr
    with printed_escaped():
        print(HOSTILE, file=sys.stderr)
        print(HOSTILE)
        sys.stdout.writelines([HOSTILE])
    assert sys.stdout is out
    for stream in (out, error):
        assert is_harmless(stream.getvalue())
        assert "\\u001b[31mred" in stream.getvalue()


@pytest.mark.parametrize("command", [["preview"], ["fit"], ["simulate"], ["crosscheck"]])
def test_a_hostile_file_name_is_shown_escaped(command, tmp_path, capfd):
    path = tmp_path / "a\x1b[31m\u202e\x9b.csv"
    path.write_text("time_s,true_strain,true_stress_MPa\n")
    assert cli.main([*command, str(path)]) == 2
    printed = capfd.readouterr()
    assert is_harmless(printed.out + printed.err)
    assert "a\\u001b[31m\\u202e\\u009b.csv" in printed.err


def test_a_preview_shows_hostile_headings_cells_and_names_escaped(tmp_path, capfd):
    path = tmp_path / "a\n\u202e.csv"
    rows = "".join(f'{at},{0.01 * at},{at},"x\u009b\u202e\nverdict: fine"\n' for at in range(12))
    path.write_text(f'time_s,true_strain,true_stress_MPa,"note\u202e [\u009bkN]"\n{rows}')
    assert cli.main(["preview", str(path)]) == 0
    printed = capfd.readouterr().out
    assert is_harmless(printed)
    assert "note\\u202e" in printed
    assert "a\\n\\u202e.csv" in printed
    assert "\nverdict" not in printed


def test_bold_is_the_programs_own_and_not_a_files(monkeypatch):
    monkeypatch.delenv("NO_COLOR", raising=False)
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr(sys, "stdout", terminal)
    with printed_escaped():
        tell("verdict \x1b[8m\nrest")
    assert terminal.getvalue() == "\x1b[1mverdict \\u001b[8m\x1b[0m\nrest\n"


def test_markup_in_a_name_is_no_markup_of_the_progress_bar(monkeypatch):
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr(progress, "SHOWN_AFTER", 0.0)
    with printed_escaped(), shown("on [/] [red]x\x1b[5m[/red]") as advance:
        advance(1, 2, "[/nonsense]")
        time.sleep(0.3)
    assert "[/] [red]x\\u001b[5m[/red]" in terminal.getvalue()
    assert "\x1b[5m" not in terminal.getvalue()


def test_a_page_shows_it_escaped(tmp_path):
    with house_style():
        figure = new_figure()
        figure.subplots().set_title(HOSTILE)
    page = Page(
        HOSTILE,
        HOSTILE,
        (Section(HOSTILE, (HOSTILE, Table((HOSTILE,), ((HOSTILE,),), HOSTILE), picture(figure, HOSTILE))),),
        lead=HOSTILE,
    )
    html = page.html()
    assert is_harmless(html)
    assert html.count("\\u001b[31mred") >= 9
    assert "<b>" not in html
    page.write(tmp_path / "page.html")


def test_a_figure_shows_it_escaped_and_reads_no_mathematics_into_it(tmp_path):
    with house_style():
        figure = new_figure()
        axes = figure.subplots()
        axes.plot([1e-3, 1.0], [1.0, 2.0], label=HOSTILE)
        axes.set(xscale="log", title=HOSTILE, xlabel=HOSTILE, ylabel="$\\frac{$")
        axes.set_yticks([1.0, 2.0], ["$a_b$", "b"])
        axes.text(0.1, 1.5, HOSTILE)
        axes.legend()
    svg = figure_to_svg(figure, HOSTILE)
    assert is_harmless(svg)
    texts = ["".join(node.itertext()) for node in ElementTree.fromstring(svg).iter() if node.tag.endswith("}text")]
    assert "$a_b$" in texts
    assert "$\\frac{$" in texts
    assert sum("\\u001b[31mred" in text for text in texts) == 4
    assert not any("mathdefault" in text for text in texts)  # powers of ten on the axis stay mathematics
    save_figure(figure, tmp_path / "figure.png")


def request_of(source):
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5, modes=9)
    return Request(
        law=law, original=law, source=source, name="m", rate=None, rates=(1e-3, 1e-2), strain=1.0, bulk_modulus=1e5,
        density=1e-9,
    )  # fmt: skip


def code_of(text, name):
    """What a code reads of an export: all but the comments."""
    if name == "mgis":
        return {key: value for key, value in json.loads(text).items() if key != "header"}
    if name in ("c", "list"):
        return text.partition("*/")[2]
    prefix = {"abaqus": "**", "calculix": "**", "ansys": "!", "ls": "$"}[name.split("-")[0]]
    return [line for line in text.splitlines() if not line.startswith(prefix)]


@pytest.mark.parametrize("name", sorted(FORMATS))
def test_no_export_header_is_broken_out_of(name):
    hostile = export_law(request_of(f"identified on {HOSTILE}\n*END\n      END\n{HOSTILE}\\"), FORMATS[name])
    plain = export_law(request_of("parameters as given"), FORMATS[name])
    assert "red" in hostile.text
    assert is_harmless(hostile.text)
    assert hostile.text.isascii()
    assert code_of(hostile.text, name) == code_of(plain.text, name)


def test_a_comment_stays_a_comment():
    lines = header_lines("x", [[HOSTILE, "*/ int main() /* \\", "**//"]])
    assert all(line.startswith("!") for line in commented(lines, "!").splitlines())
    assert c_comment(lines).count("*/") == 1


def test_json_holds_the_same_text_in_printable_characters():
    text = json_answer("x/1", {"name": HOSTILE, HOSTILE: 1})
    assert is_harmless(text)
    assert json.loads(text)["name"] == HOSTILE
    text.encode()
