"""Fourteen more files of laboratories, two of each kind, with what the first fourteen do not have.

Text below the numbers, headings that come twice, specimens one below the other with facts between them, a test in
several blocks, a force that is a stress, Japanese headings, comments in columns of their own, sheets that begin in
column B. Every specimen is pulled at 0.25 mm/s from a gauge length of 50 mm and a section of 40 mm².
"""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np
import openpyxl

from probation import Law

COUNT = 60
TIME = np.linspace(0.0, 50.0, COUNT)
STRAIN = 0.005 * TIME
STRESS = Law(unrelaxed_modulus=1500.0, tau_max=20.0, hardening_modulus=3.0).stress(TIME, np.log1p(STRAIN)) / (
    1.0 + STRAIN
)
FORCE = 40.0 * STRESS
EXTENSION = 50.0 * STRAIN
_PLATE = ("10,00", "4,00")


def _comma(value: float) -> str:
    return f"{value:.6f}".replace(".", ",")


def _point(value: float) -> str:
    return f"{value:.6f}"


def _quoted(value: float) -> str:
    return f'"{value:.6f}"'


def _rows(separator: str, written: Callable[[float], str], *columns: Iterable[float]) -> list[str]:
    return [separator.join(map(written, values)) for values in zip(*columns, strict=True)]


def _write(path: Path, lines: Sequence[str], encoding: str = "utf-8") -> None:
    path.write_bytes("\r\n".join([*lines, ""]).encode(encoding))


def bluehill_with_results(path: Path) -> None:
    """A table of results above, two strains, text below the numbers."""
    head = ['"Results Table 1"', '"","Maximum Load [N]","Modulus [MPa]"', '"1","912.33","1480"', ""]
    head += [
        '"Dimension : Thickness","4.0","mm"',
        '"Dimension : Width","10.0","mm"',
        '"Dimension : Length","50","mm"',
        "",
    ]
    head += ['"Time","Extension","Load","Tensile strain (Strain 1)","Tensile strain (Extension)","Tensile stress"']
    head += ['"(s)","(mm)","(N)","(mm/mm)","(mm/mm)","(MPa)"']
    rows = _rows(",", _quoted, TIME, EXTENSION, FORCE, STRAIN, 0.9 * STRAIN, STRESS)
    _write(path, [*head, *rows, "", '"End of data"'], "utf-8-sig")


def bluehill_utf16(path: Path) -> None:
    """Semicolons and decimal commas in UTF-16."""
    head = [f"Dimension : Width;{_PLATE[0]};mm", f"Dimension : Thickness;{_PLATE[1]};mm", "Dimension : Length;50,00;mm"]
    head += ["", "", "Time;Extension;Load;Displacement (Strain 1)", "(s);(mm);(kN);(mm)"]
    _write(path, [*head, *_rows(";", _comma, TIME, EXTENSION, FORCE / 1000, EXTENSION)], "utf-16")


def zwick_below(path: Path) -> None:
    """Specimens one below the other, each with its section above; statistics below the last."""
    lines = ["Prüfprotokoll;;;", '"Vorkraft";"0,1";"MPa"', '"Einspannlänge bei Startposition";"115,00";"mm"']
    lines += ['"Messlänge Standardweg";"50,00";"mm"', ";;;"]
    for number, thickness in ((1, 4.0), (2, 8.0)):
        lines += [f'"Probe {number}";;;', f'"Probendicke a0";"{_comma(thickness)}";"mm"', '"Probenbreite b0";"10";"mm"']
        lines += ['"Prüfzeit";"Kraft";"Standardweg";"Dehnung"', '"s";"N";"mm";"%"']
        lines += [*_rows(";", _comma, TIME, FORCE * thickness / 4.0, EXTENSION, 100 * STRAIN), ";;;"]
    _write(path, [*lines, '"Statistik";"n = 2";;', '"E";"1480";"MPa";'], "cp1252")


def zwick_stress(path: Path) -> None:
    """A workbook with parameters, results and statistics first; the "Standardkraft" is in MPa."""
    book = openpyxl.Workbook()
    book.active.title = "Parameter"
    book.active.append(["Prüfgeschwindigkeit", 15, "mm/min"])
    results = book.create_sheet("Ergebnisse")
    for row in (["", "a0", "b0", "S0"], ["Nr", "mm", "mm", "mm²"], [1, 4.0, 10.0, 40.0]):
        results.append(row)
    for number in (1, 2):
        sheet = book.create_sheet(f"Probe {number}")
        for row in ([f"Probe {number}"], ["Dehnung", "Standardkraft", "Prüfzeit"], ["%", "MPa", "s"]):
            sheet.append(row)
        for values in zip(100 * STRAIN, STRESS, TIME, strict=True):
            sheet.append([float(value) for value in values])
    book.save(path)


def mts_in_blocks(path: Path) -> None:
    """MTS 793: a test in two blocks, each below a header of its own."""
    lines = ["MTS793|BTW|ENU|1|2|.|/|:|1|0|0|A", ""]
    for block in (slice(0, COUNT // 2), slice(COUNT // 2, None)):
        lines += [f"Data Header:\t\t\tTime:\t{TIME[block][-1]:.4f}\tSec\t3/4/2019 11:02:33 AM"]
        lines += ["Data Acquisition:\tTimed Acq", "Station Name:\tElastomer.cfg"]
        lines += ["Axial Count\tTime\tAxial Displacement\tAxial Force\tCommand", "segments\tSec\tmm\tkN\tkN"]
        lines += _rows(
            "\t", _point, 1 + 0 * TIME[block], TIME[block], EXTENSION[block], FORCE[block] / 1000, TIME[block]
        )
        lines += [""]
    _write(path, lines)


def mts_twice(path: Path) -> None:
    """TestSuite: one heading twice, in other units; empty cells at the end of every row; text below."""
    head = ["Test Run Name,HDPE-R2", "Width,10.0,mm,", "Thickness,4.0,mm,", "Gage Length,50.0,mm,", ""]
    head += ["Running Time,Crosshead,Load,Axial Strain,Axial Strain,", "(sec),(mm),(N),(mm/mm),(%),", ""]
    rows = [f"{row}," for row in _rows(",", _point, TIME, EXTENSION, FORCE, STRAIN, 100 * STRAIN)]
    _write(path, [*head, *rows, "", "Test Run End Reason,Break detected"], "utf-8-sig")


def trapezium_japanese(path: Path) -> None:
    """Side by side in Shift-JIS; two specimens broke earlier."""
    head = ['"キーワード","","試料名","","HDPE"', "", '"名前","厚さ","幅","標点間距離"', '"単位","mm","mm","mm"', ""]
    head += ['"1 _ 1","","","1 _ 2","","","1 _ 3","",""', ",".join(['"時間","試験力","ストローク"'] * 3)]
    head += [",".join(['"sec","N","mm"'] * 3)]
    rows = [
        ",".join(row if at < end else '"","",""' for end in (COUNT, 50, 40))
        for at, row in enumerate(_rows(",", _quoted, TIME, FORCE, EXTENSION))
    ]
    _write(path, [*head, *rows], "cp932")


def trapezium_extensometer(path: Path) -> None:
    """One below the other, an extensometer beside the stroke, no dimensions."""
    lines = ['"Test Type","Tensile","Speed","15 mm/min"', ""]
    for number in (1, 2):
        lines += [f'"1 _ {number}"', '"Time","Stroke","Force","Extensometer Strain"', '"s","mm","kN","%"']
        lines += [*_rows(",", _quoted, TIME, 1.1 * EXTENSION, FORCE / 1000, 100 * STRAIN), "", ""]
    _write(path, lines)


_STAGE = ["Control Mod : Displacement ", "Section : Rectangular "]


def stage_with_commas(path: Path) -> None:
    """Kammrath & Weiss with decimal commas, in µm."""
    facts = [*_STAGE, "Width(mm) : 10,000000 ", "Thickness(mm) : 4,000000 ", "Gauge Length(mm) : 50,000000 "]
    names = "Time (s) \tSpeed (µm/s) \tDisplacement (µm) \tForce (N) \tStress (Mpa) "
    rows = _rows(" \t", _comma, TIME, 250 + 0 * TIME, 1000 * EXTENSION, FORCE, STRESS)
    _write(path, [*facts, "=" * 90, names, *rows], "latin-1")


def stage_with_remarks(path: Path) -> None:
    """The same in UTF-16, a remark in some rows, a rule and text below the numbers."""
    facts = [*_STAGE, "Width(mm) : 10.0 ", "Thickness(mm) : 4.0 ", "Gauge Length(mm) : 50.0 ", "=" * 90, ""]
    names = "Time (s) \tDisplacement (mm) \tForce (N) \tComment "
    rows = _rows(" \t", _point, TIME, EXTENSION, FORCE)
    rows = [f"{row} \timage {at}" if at % 20 == 0 else f"{row} \t" for at, row in enumerate(rows)]
    _write(path, [*facts, names, *rows, "", "=" * 90, "Test stopped by user "], "utf-16")


def catman_german(path: Path) -> None:
    """catman's text in UTF-16: names of the user's own, a row of dates below the units, strain in µm/m."""
    head = ["HBM_CATMAN_DATAFILE_40", "catman ASCII export 4.2", ""]
    head += ["Zeit  1 - Standardmessrate\tKraft MX840 CH1\tWeg WA10\tDMS 1", "s\tkN\tmm\tµm/m"]
    head += ["\t".join(["05.05.2020 09:12:44"] * 4)]
    _write(path, [*head, *_rows("\t", _comma, TIME, FORCE / 1000, EXTENSION, 1e6 * STRAIN)], "utf-16")


def catman_german_workbook(path: Path) -> None:
    """The same as a workbook; two lengths, of which the extensometer is read."""
    book = openpyxl.Workbook()
    book.active.append(["Dateikommentar: Zug PE"])
    book.active.append(["Zeit  1 - Standardmessrate", "Kraft", "Wegaufnehmer", "Ext. Clip"])
    for row in (["s", "N", "mm", "mm"], [None] * 4, ["Hardware-Kanal: 0"] * 4, ["01.02.21 10:00:00"] * 4):
        book.active.append(row)
    for t, f, u in zip(TIME, FORCE, EXTENSION, strict=True):
        book.active.append([float(t), float(f), 1.1 * float(u), float(u)])
    book.save(path)


def workbook_from_column_b(path: Path) -> None:
    """A summary, then sheets whose tables begin in column B, strain shown in percent, a remark."""
    book = openpyxl.Workbook()
    for row in (["HDPE tension"], ["Specimen", "E (MPa)"], ["A1", 1500]):
        book.active.append(row)
    for name in ("A1", "A2"):
        sheet = book.create_sheet(name)
        sheet.merge_cells("B1:E1")
        sheet["B1"] = f"Specimen {name}"
        for at, text in enumerate(("Time (s)", "Eng. Strain", "Eng. Stress (MPa)", "Remarks"), start=2):
            sheet.cell(4, at, text)
        for row, values in enumerate(zip(TIME, STRAIN, STRESS, strict=True), start=5):
            for at, value in enumerate(values, start=2):
                sheet.cell(row, at, float(value)).number_format = "0.00%" if at == 3 else "General"
        sheet.cell(30, 5, "necking visible")
    book.save(path)


def workbook_side_by_side(path: Path) -> None:
    """Two specimens with an empty column between, German headings, units in square brackets."""
    book = openpyxl.Workbook()
    head = (["Probe A", None, None, None, "Probe B"], ["Zeit", "Weg", "Kraft", None, "Zeit", "Weg", "Kraft"])
    units = ["[s]", "[mm]", "[N]"]
    for row in (["Zugversuche PE, 23 °C"], [], *head, [*units, None, *units]):
        book.active.append(row)
    for at, values in enumerate(zip(TIME, EXTENSION, FORCE, strict=True)):
        row = [float(value) for value in values]
        book.active.append([*row, None, *(row if at < 50 else [])])
    book.save(path)


def bluehill_universal(path: Path) -> None:
    """All specimens in one file: results with dimensions above, each curve below a row with its number and name."""
    head = ["Results Table 1", ",Specimen label,Maximum Tensile stress [MPa],Width [mm],Thickness [mm]"]
    lines = [*head, "1,PP-01,30.1,10.0,4.0", "2,PP-02,30.4,10.0,4.0", "Mean,,30.2,,", "", "Results Table 2"]
    for number in (1, 2):
        lines += [f"{number},PP-0{number}", "Time,Displacement,Force,Tensile strain (Strain 1)", "(s),(mm),(kN),(%)"]
        lines += [*_rows(",", _point, TIME, 1.3 * EXTENSION, FORCE / 1000, 100 * STRAIN), ""]
    _write(path, lines)


def mts_german(path: Path) -> None:
    """MTS 793 in German: names that no list holds, of which the unit tells; two blocks of one test."""
    lines = ["MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A", "", "Durchmesser: 7,1365 mm", ""]
    for block in (slice(0, COUNT // 2), slice(COUNT // 2, None)):
        lines += ["Datenerfassung:\t\tZeit:\t12,500\tSek\t01.09.2014 13:25:39"]
        lines += ["Laufzeit\tAxialweg\tAxialkraft\tExtensometer", "Sek\tmm\tkN\tmm"]
        lines += [*_rows("\t", _comma, TIME[block], 2 * EXTENSION[block], FORCE[block] / 1000, EXTENSION[block]), ""]
    _write(path, lines, "cp1252")


def trapezium_two_lengths(path: Path) -> None:
    """The stroke beside an extensometer, both in mm; a table of results below."""
    head = ['"Time","Force","Stroke","Ext.1","Stress"', '"sec","N","mm","mm","N/mm2"']
    below = ["", '"Name","Max_Force"', '"Unit","N"', '"1 _ 1","1204.1"', '"Standard Deviation","-.--"']
    _write(path, [*head, *_rows(",", _quoted, TIME, FORCE, 2 * EXTENSION, EXTENSION, STRESS), *below])


def labview(path: Path) -> None:
    """LabVIEW: two headers with numbers of their own, the time as X_Value, a French heading."""
    head = ["LabVIEW Measurement", "Decimal_Separator\t,", "Time\t14:02:33,1875", "***End_of_Header***", ""]
    head += ["Channels\t2\t\t", f"Samples\t{COUNT}\t{COUNT}\t", "X0\t0\t0\t", "***End_of_Header***\t\t\t"]
    head += ["X_Value\tForce (N)\tAllongement (mm)\tComment"]
    _write(path, [*head, *(f"{row}\t" for row in _rows("\t", _comma, TIME, FORCE, EXTENSION))], "cp1252")


def french_workbook(path: Path) -> None:
    """By hand: minutes, daN and percent, the section in words above."""
    book = openpyxl.Workbook()
    for row in (["Essai de traction PEHD"], ["Section initiale S0", "40 mm²"], []):
        book.active.append(row)
    book.active.append(["N°", "temps (min)", "Charge (daN)", "Allongement (%)", "Remarque"])
    for at, (t, f, e) in enumerate(zip(TIME, FORCE, STRAIN, strict=True)):
        remark = "striction" if at == 30 else None
        book.active.append([at + 1, float(t) / 60, float(f) / 10, 100 * float(e), remark])
    book.save(path)


MESSY: dict[str, tuple[Callable[[Path], None], str, int]] = {
    "Specimen_RawData_7.csv": (bluehill_with_results, "bluehill", 1),
    "probe_is_tens_1.csv": (bluehill_utf16, "bluehill", 1),
    "Serie_12.TRA": (zwick_below, "testxpert", 2),
    "ZV_2023-117.xlsx": (zwick_stress, "testxpert", 2),
    "specimen.dat": (mts_in_blocks, "testsuite", 1),
    "DAQ- Crosshead, … - (Timed).csv": (mts_twice, "testsuite", 1),
    "試験.csv": (trapezium_japanese, "trapezium", 3),
    "b_export.csv": (trapezium_extensometer, "trapezium", 2),
    "MT_0004.txt": (stage_with_commas, "kammrath-weiss", 1),
    "run 2 (DIC).txt": (stage_with_remarks, "kammrath-weiss", 1),
    "catman_DAQ_1.ASC": (catman_german, "catman", 1),
    "Messung_1.xlsx": (catman_german_workbook, "catman", 1),
    "hdpe results FINAL v2.xlsx": (workbook_from_column_b, "excel", 2),
    "Auswertung.xlsx": (workbook_side_by_side, "excel", 2),
}
"""Fourteen files by name: what makes each, the profile that reads it, how many specimens it holds."""
FURTHER: dict[str, tuple[Callable[[Path], None], str, int]] = {
    "Bluehill_PP_all.csv": (bluehill_universal, "bluehill", 2),
    "specimen_de.dat": (mts_german, "testsuite", 1),
    "ABS 2_1.csv": (trapezium_two_lengths, "trapezium", 1),
    "traction_05.lvm": (labview, "csv", 1),
    "essai PEHD.xlsx": (french_workbook, "excel", 1),
}
"""Five more, likewise: each has what neither of the two times fourteen has."""
