"""Files as laboratories have them, two of each kind: made after the formats that the profiles name.

Every specimen is pulled at 0.5 mm/s from a gauge length of 50 mm and a section of 10 mm by 4 mm, unless a file says
otherwise; `STRESS` is its engineering stress [MPa], `STRAIN` its engineering strain.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import openpyxl

from probation import Law

TIME = np.linspace(0.0, 20.0, 101)
STRAIN = 0.01 * TIME
_LAW = Law(unrelaxed_modulus=2400.0, tau_max=6.0, hardening_modulus=2.0)
STRESS = _LAW.stress(TIME, np.log1p(STRAIN)) / (1.0 + STRAIN)
FORCE = 40.0 * STRESS
EXTENSION = 50.0 * STRAIN


def _comma(value: float) -> str:
    return f"{value:.6f}".replace(".", ",")


def bluehill(path: Path) -> None:
    """Instron Bluehill: facts in three cells, units in brackets."""
    rows = [f"{t:.5f},{u:.5f},{f:.5f},22476,0" for t, u, f in zip(TIME, EXTENSION, FORCE, strict=True)]
    head = [
        'Text Inputs : Specimen label,"22L.3"',
        "General : Start Date,13/11/2018 5:14 PM",
        "Dimension : Length,50,mm",
        "Dimension : Width,10,mm",
        "Dimension : Thickness,4.0,mm",
        "",
        "Time,Extension,Load,Segment ID,Total Cycle Count",
        "(sec),(mm),(N),,",
    ]
    path.write_text("\n".join([*head, *rows]) + "\n")


def bluehill_with_commas(path: Path) -> None:
    """The same with decimal commas in quotes, strain and stress made by Bluehill."""
    head = [
        'Specimen properties : Area,"40,0",mm^2',
        'Specimen properties : Specimen label,""',
        'Specimen properties : Final area,"31,2",mm^2',
        "",
        "Time,Extension,Load,Tensile strain (Extension),Tensile stress,Cycle count",
        "(s),(mm),(N),(mm/mm),(MPa),",
    ]
    rows = [
        ",".join(f'"{_comma(value)}"' for value in values)
        for values in zip(TIME, EXTENSION, FORCE, STRAIN, STRESS, 0 * TIME, strict=True)
    ]
    path.write_text("\n".join([*head, *rows]) + "\n")


def zwick(path: Path) -> None:
    """Zwick testXpert: German, cp1252, decimal commas, quoted names over quoted units."""
    head = ['"Probenbreite b0";"10,00";"mm"', '"Probendicke a0";"4,00";"mm"', '"Prüfer";"Müller"', ""]
    head += ['"Prüfzeit";"Standardkraft";"Dehnung";"Traversenweg"', '"s";"N";"%";"mm"']
    rows = [";".join(map(_comma, values)) for values in zip(TIME, FORCE, 100 * STRAIN, EXTENSION + 0.3, strict=True)]
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("cp1252"))


def zwick_workbook(path: Path) -> None:
    """The same as a workbook: results first, then a sheet for each specimen."""
    book = openpyxl.Workbook()
    book.active.title = "Ergebnisse"
    for row in (["Legende", "Fmax", "dL bei Fmax"], ["", "N", "%"], ["Probe 1", 1800.0, 20.0]):
        book.active.append(row)
    for number in (1, 2):
        sheet = book.create_sheet(f"Probe {number}")
        sheet.append([f"Probe {number}"])
        sheet.append(["Prüfzeit", "Standardkraft", "Dehnung"])
        sheet.append(["s", "N", "mm"])
        for values in zip(TIME, FORCE * (1.0 + 0.01 * number), EXTENSION, strict=True):
            sheet.append([float(value) for value in values])
    book.save(path)


def mts_testsuite(path: Path) -> None:
    """MTS TestSuite: four facts, two empty lines, quoted names with blanks, units."""
    head = [
        r'"File Path: C:\MTS\Projects\HDPE.tcc"',
        '"Test: Tension"',
        '"Test Run: A3"',
        '"Date: 11/2/2022 2:11:08 PM"',
        "",
        "",
        '"Running Time ","Axial Displacement ","Axial Force "',
        '"sec","mm","kN"',
    ]
    rows = [f'"{t:.4f}","{u:.6f}","{f:.8f}"' for t, u, f in zip(TIME, EXTENSION, FORCE / 1000, strict=True)]
    path.write_text("\ufeff" + "\n".join([*head, *rows]) + "\n")


def mts_793(path: Path) -> None:
    """MTS 793: a .dat file, tabs."""
    head = [
        "MTS793|BTW|ENU|1|0|.|/|:|1|0|0|A",
        "",
        "Data Header:\t\tTime:\t0.2\tSec\t11/2/2022 2:11:08 PM",
        "Data Acquisition: Timed",
        "Station Name: EML858.cfg",
        "Test File Name: creep.000",
        "Time\tAxial Force\tAxial Displacement",
        "s\tN\tmm",
    ]
    rows = [f"{t:.5f}\t{f:.5f}\t{u:.6f}" for t, f, u in zip(TIME, FORCE, EXTENSION, strict=True)]
    path.write_text("\n".join([*head, *rows]) + "\n")


_TRAPEZIUM = [
    '"Key Word","","Product Name","","Test File Name","a.xtas"',
    '"Test Type","Tensile","Speed","30mm/min","Shape","Plate"',
    "",
    '"Name","Thickness","Width","Gauge_Length"',
    '"Units","mm","mm","mm"',
    '"1_1","4.0000","10.0000","50.0000"',
    '"1_2","4.0000","10.2000","50.0000"',
    "",
    '"Name","Max_Force","Max_Stress"',
    '"Parameters","Calc. at Entire Areas","Calc. at Entire Areas"',
    '"Unit","N","MPa"',
    '"1_1","1800.0","45.0"',
    "",
]


def trapezium(path: Path) -> None:
    """Shimadzu TRAPEZIUM: two specimens one below the other, their dimensions in a table above."""
    lines = list(_TRAPEZIUM)
    for number in (1, 2):
        lines += [f'"1 _ {number}"', '"Time","Force","Stroke"', '"sec","N","mm"']
        lines += [f'"{t:.3f}","{f:.5f}","{u:.5f}"' for t, f, u in zip(TIME, FORCE, EXTENSION, strict=True)]
        lines.append("")
    path.write_text("\r\n".join(lines))


def trapezium_side_by_side(path: Path) -> None:
    """The same side by side; the second specimen broke earlier."""
    lines = [*_TRAPEZIUM, '"1 _ 1","","","1 _ 2","",""', '"Time","Force","Stroke","Time","Force","Stroke"']
    lines.append('"sec","N","mm","sec","N","mm"')
    for at, (t, f, u) in enumerate(zip(TIME, FORCE, EXTENSION, strict=True)):
        cells = f'"{t:.3f}","{f:.5f}","{u:.5f}"'
        lines.append(f"{cells},{cells}" if at < 80 else f'{cells},"","",""')
    path.write_text("\n".join(lines) + "\n")


def kammrath_weiss(path: Path) -> None:
    """Kammrath & Weiss: a stage that starts at an offset, Latin-1, a rule of equal signs, blanks after every cell."""
    _stage(path, ["Section : Rectangular ", "Width(mm) : 10.000000 ", "Thickness(mm) : 4.000000 "], -200.0)


def kammrath_weiss_round(path: Path) -> None:
    """The same with a round specimen."""
    _stage(path, ["Section : Circular ", f"Diameter(mm) : {np.sqrt(160.0 / np.pi):.9f} "], 0.0)


def _stage(path: Path, section: list[str], offset: float) -> None:
    facts = ["Project Title : exSitu ", "Material : HDPE ", "Informations :  ", "Control Mod : Manual ", *section]
    facts += ["Total Length(mm) : 80.000000 ", "Gauge Length(mm) : 50.000000 ", "=" * 100]
    names = (
        "Time (s) \tSpeed (µm/s) \tDisplacement (µm) \tForce (N) \tReal Speed (µm/s) \tCal. Force (V) \tStress (Mpa) "
    )
    rows = [
        f"{t:.6f} \t500.0 \t{1000 * u + offset:.6f} \t{f:.6f} \t500.0 \t2.46 \t{s:.6f} \t"
        for t, u, f, s in zip(TIME, EXTENSION, FORCE, STRESS, strict=True)
    ]
    path.write_bytes("\r\n".join([*facts, names, *rows, ""]).encode("latin-1"))


_CATMAN = [
    ["File comment: ", "", "", ""],
    ["Time  1 - default sample rate      ", "Load   ", "Extenso   ", "Temperature   "],
    ["s         ", "kN        ", "mm        ", "°C        "],
    ["    ", "    ", "    ", "    "],
    ["11.12.18 14:50:30"] * 4,
    ["200.00 ms (5 Hz)"] * 4,
    ["Hardware channel:0", "Hardware channel:1", "Hardware channel:2", "Hardware channel:3"],
    ["Sensor:    ", "Sensor: DC voltage 10 V", "Sensor: DC voltage 10 V", "Sensor: Pt100"],
    ["Amplifier typeN.A.", "Amplifier typeMX1615", "Amplifier typeMX1615", "Amplifier typeMX1615"],
]


def catman_workbook(path: Path) -> None:
    """HBM catman: a workbook whose units tell what the channels are."""
    book = openpyxl.Workbook()
    for row in _CATMAN:
        book.active.append([cell or None for cell in row])
    for t, f, u in zip(TIME, FORCE, EXTENSION, strict=True):
        book.active.append([float(t), float(f) / 1000, float(u), 23.5])
    book.save(path)


def catman_text(path: Path) -> None:
    """The same as text: tabs, decimal commas, cp1252."""
    lines = ["\t".join(row) for row in _CATMAN]
    lines += [
        "\t".join(map(_comma, values)) for values in zip(TIME, FORCE / 1000, EXTENSION, 0 * TIME + 23.5, strict=True)
    ]
    path.write_bytes("\r\n".join([*lines, ""]).encode("cp1252"))


def french(path: Path) -> None:
    """French headings, semicolons, decimal commas, the specimen above."""
    head = ["Éprouvette;H12", "Largeur (mm);10,0", "Épaisseur (mm);4,0", "Longueur initiale (mm);50,0", ""]
    head.append("Temps (s);Déplacement (mm);Force (kN)")
    rows = [";".join(map(_comma, values)) for values in zip(TIME, EXTENSION, FORCE / 1000, strict=True)]
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("cp1252"))


def english(path: Path) -> None:
    """English headings that do not say whether they are true or engineering."""
    rows = [f"{t:.2f},{e:.6f},{s:.6f}" for t, e, s in zip(TIME, 100 * STRAIN, STRESS, strict=True)]
    path.write_text("\n".join(["Time (s),Strain (%),Stress (MPa)", *rows]) + "\n")


def bluehill_in_german(path: Path) -> None:
    """Instron Bluehill in German: facts of any name, semicolons, decimal commas and points between thousands."""
    head = ['Breite;"10,00";mm', 'Dicke;"4,00";mm', 'Anfangsmesslänge;"50,00";mm', ""]
    head += ["Zeit;Verlängerung;Last;Zugdehnung (Dehnung 1)", "(s);(mm);(N);(mm/mm)"]
    rows = []
    for t, u, f, e in zip(TIME, EXTENSION, FORCE, STRAIN, strict=True):
        force = f"{f:,.4f}".translate(str.maketrans(",.", ".,"))
        rows.append(f'"{_comma(t)}";"{_comma(u)}";"{force}";"{_comma(e)}"')
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("cp1252"))


def trapezium_with_results(path: Path) -> None:
    """Shimadzu: a table of dimensions above the samples, and one of results below them."""
    head = ['"Name","Thickness","Width","Gauge Length"', '"Units","mm","mm","mm"', '"1 _ 1","4.0","10.0","50.0"', ""]
    head += ['"Time","Stress","Strain(Ext.)","Stroke"', '"min","N/mm2","%","mm"']
    rows = [
        f'"{t / 60:.9f}","{s:.6f}","{100 * e:.6f}","{1.1 * u:.6f}"'
        for t, s, e, u in zip(TIME, STRESS, STRAIN, EXTENSION, strict=True)
    ]
    foot = ["", '"Name","Max_Stress","Break_Strain"', '"Units","N/mm2","%"', '"1 _ 1","44.0","20.0"']
    path.write_text("\n".join([*head, *rows, *foot]) + "\n")


def stage_with_clock(path: Path) -> None:
    """A stage whose samples have the time of day, across midnight; headings and dimensions in remarks."""
    head = ["# tensile stage", "# sample A, thickness 4.0 mm, width 10 mm, free length 50 mm"]
    head.append("# time       elongation[um]  force[N]")
    rows = []
    for t, u, f in zip(TIME, EXTENSION, FORCE, strict=True):
        of_day = (86390.0 + t) % 86400.0
        clock = f"{int(of_day // 3600):02d}:{int(of_day // 60) % 60:02d}:{of_day % 60:06.3f}"
        rows.append(f"{clock} {1000 * u:12.3f} {f:12.5f}")
    path.write_text("\n".join([*head, *rows]) + "\n")


def catman_with_counts(path: Path) -> None:
    """HBM catman: a row of counts above channels that have the user's names."""
    head = [
        *("HBM\tcatmanAP", "T0:\t12/03/2024 10:33:22", "Channels:\t3", f"Length:{f'{chr(9)}{len(TIME)}' * 3}"),
        "Time  1 - default sample rate\tU10M_Force\tExtens_DD1",
        *("s\tkN\tµm/m", "SR=5 Hz\tSR=5 Hz\tSR=5 Hz", "CH 0\tCH 1\tCH 2"),
    ]
    rows = [f"{t:.3f}\t{f / 1000:.8f}\t{1e6 * e:.3f}" for t, f, e in zip(TIME, FORCE, STRAIN, strict=True)]
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("cp1252"))


def catman_in_french(path: Path) -> None:
    """HBM catman in French: dimensions with their symbols, units in the headings."""
    head = ["catmanEasy ; Exportation ASCII", "Longueur initiale L0 : 50,0 mm", "Section initiale S0 : 40,0 mm²", ""]
    head.append("Temps [s];Force [kN];Allongement [mm];Déformation [%]")
    rows = [
        ";".join(map(_comma, values)) for values in zip(TIME, FORCE / 1000, 1.1 * EXTENSION, 100 * STRAIN, strict=True)
    ]
    path.write_bytes("\r\n".join([*head, *rows, ""]).encode("cp1252"))


def zwick_series(path: Path) -> None:
    """Zwick testXpert: the gauge length on one sheet, each specimen's section on another."""
    book = openpyxl.Workbook()
    book.active.title = "Parameter"
    book.active.append(["Messlänge L0", 50, "mm"])
    results = book.create_sheet("Ergebnisse")
    for row in (["Legende", "Nr.", "h", "b", "S0"], [None, None, "mm", "mm", "mm²"], ["Probe 1", 1, 4.0, 10.0, 40.0]):
        results.append(row)
    results.append(["Probe 2", 2, 4.1, 10.0, 41.0])
    for number in (1, 2):
        sheet = book.create_sheet(f"Probe {number}")
        sheet.append(["Prüfzeit", "Standardkraft", "Standardweg"])
        sheet.append(["s", "N", "mm"])
        for values in zip(TIME, FORCE * (1.0, 1.025)[number - 1], EXTENSION, strict=True):
            sheet.append([float(value) for value in values])
    book.save(path)


def with_remarks(path: Path) -> None:
    """A file that somebody kept by hand: remarks above, between and beside the samples, results below."""
    head = ["// strip 13, second try", "# gauge length 50 mm, section 4.0 x 10 mm", ""]
    head += ["Running Time,Axial Force,Stroke,Extensometer,Remarks", "sec,N,mm,mm,"]
    rows = [f"{t:.3f},{f:.5f},{1.1 * u:.5f},{u:.5f}," for t, f, u in zip(TIME, FORCE, EXTENSION, strict=True)]
    rows[7] += "necking?"
    rows[50:50] = ["", "# light switched on here"]
    path.write_text("\n".join([*head, *rows, "", "Max force,641.38,N", "Mean,12.3,4.5,6.7", "END OF TEST"]) + "\n")


FILES: dict[str, tuple[Callable[[Path], None], str, int]] = {
    "Specimen_RawData_1.csv": (bluehill, "bluehill", 1),
    "Specimen_RawData_2.csv": (bluehill_with_commas, "bluehill", 1),
    "Zugversuch.txt": (zwick, "testxpert", 1),
    "Zugversuch.xlsx": (zwick_workbook, "testxpert", 2),
    "DAQ- Axial.csv": (mts_testsuite, "testsuite", 1),
    "specimen.dat": (mts_793, "testsuite", 1),
    "raw.csv": (trapezium, "trapezium", 2),
    "raw-side.csv": (trapezium_side_by_side, "trapezium", 2),
    "stage.txt": (kammrath_weiss, "kammrath-weiss", 1),
    "stage-round.txt": (kammrath_weiss_round, "kammrath-weiss", 1),
    "Temp_LP.xlsx": (catman_workbook, "catman", 1),
    "Temp_LP.asc": (catman_text, "catman", 1),
    "essai.csv": (french, "csv", 1),
    "tension.csv": (english, "csv", 1),
    "Zug 1.csv": (bluehill_in_german, "bluehill", 1),
    "raw-results.csv": (trapezium_with_results, "trapezium", 1),
    "in-situ.asc": (stage_with_clock, "csv", 1),
    "counts.asc": (catman_with_counts, "catman", 1),
    "essai-catman.csv": (catman_in_french, "catman", 1),
    "Serie.xlsx": (zwick_series, "testxpert", 2),
    "strip-13.csv": (with_remarks, "testsuite", 1),
}
"""Files by name: what makes each, the profile that reads it, how many specimens it holds."""
