"""Records in .xlsx: what stands in the cells, in the XML around them, and in the archive around that."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

from fuzz import odd
from fuzz.bytes_damage import damaged
from fuzz.case import Case
from fuzz.content import from_bytes, to_bytes
from fuzz.kinds.comma_separated import record_case
from fuzz.row_mutations import mutated
from fuzz.rows import WITH_HEADINGS, plain, plain_truth

if TYPE_CHECKING:
    from random import Random

    from fuzz.content import Content

NAME, SHARE = "xlsx", 12

_FILE = "tension-7.xlsx"
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_SPREADSHEET = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
SHEET = "xl/worksheets/sheet1.xml"

_LAUGHS = (
    '<!DOCTYPE worksheet [<!ENTITY a "ha">'
    + "".join(f'<!ENTITY {chr(98 + at)} "{f"&{chr(97 + at)};" * 10}">' for at in range(9))
    + "]>"
)
_CELLS = (
    "<v>1e400</v>", "<v>nan</v>", "<v>abc</v>", "<v></v>", "", "<v>" + "9" * 5000 + "</v>", "<v>1,5</v>",
    "<f>1/0</f>", "<f>A1</f><v>3</v>", "<is><t>x</t></is>", "<v>&j;</v>", "<v>-1</v>", "<v>99999999999</v>",
    "<v>0x10</v>", "<v> 3 </v>", "<v>1e-320</v>",
)  # fmt: skip
_TYPES = (
    "",
    ' t="s"',
    ' t="b"',
    ' t="e"',
    ' t="d"',
    ' t="n"',
    ' t="str"',
    ' t="inlineStr"',
    ' t="odd"',
    ' s="1"',
    ' s="99"',
)
_PLACES = ("A1", "A0", "ZZZZ1", "XFD1048576", "A1048577", "1A", "", "A", "A99999999999", "a5", "$B$5")
_ROWS = ("0", "-1", "1", "2", "1048576", "1048577", "999999999", "99999999999999999999", "x", "", "1.5")


def members(cells: list[list[str]], *, shared: bool = False) -> dict[str, str]:
    """The files of a workbook of one sheet, numbers as numbers and the rest as text."""
    strings: list[str] = []
    rows = [
        f'<row r="{at}">' + "".join(_cell(text, strings if shared else None) for text in row) + "</row>"
        for at, row in enumerate(cells, start=1)
    ]
    overrides = {
        "/xl/workbook.xml": "sheet.main",
        f"/{SHEET}": "worksheet",
        "/xl/styles.xml": "styles",
        "/xl/sharedStrings.xml": "sharedStrings",
    }
    kinds = "".join(
        f'<Override PartName="{part}" ContentType="{_SPREADSHEET}.{what}+xml"/>' for part, what in overrides.items()
    )
    targets = {"worksheet": "worksheets/sheet1.xml", "styles": "styles.xml", "sharedStrings": "sharedStrings.xml"}
    relations = "".join(
        f'<Relationship Id="rId{at}" Type="{_OFFICE}/{what}" Target="{target}"/>'
        for at, (what, target) in enumerate(targets.items(), start=1)
    )
    items = "".join(f"<si><t>{escape(text)}</t></si>" for text in strings)
    return {
        "[Content_Types].xml": f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types"><Default Extension="rels" ContentType='
        f'"application/vnd.openxmlformats-package.relationships+xml"/>{kinds}</Types>',
        "_rels/.rels": f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="rId1" '
        f'Type="{_OFFICE}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'{_HEAD}<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}"><sheets>'
        '<sheet name="Data" sheetId="1" r:id="rId1"/></sheets></workbook>',
        "xl/_rels/workbook.xml.rels": f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">'
        f"{relations}</Relationships>",
        "xl/styles.xml": f'{_HEAD}<styleSheet xmlns="{_MAIN}"><fonts count="1"><font/></fonts>'
        '<fills count="1"><fill><patternFill patternType="none"/></fill></fills>'
        '<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs>'
        '<cellXfs count="2"><xf/><xf numFmtId="14" applyNumberFormat="1"/></cellXfs></styleSheet>',
        "xl/sharedStrings.xml": f'{_HEAD}<sst xmlns="{_MAIN}" count="{len(strings)}">{items}</sst>',
        SHEET: f'{_HEAD}<worksheet xmlns="{_MAIN}"><sheetData>{"".join(rows)}</sheetData></worksheet>',
    }


def make(chance: Random) -> Case:
    """A workbook that went wrong in its cells, its XML or its bytes; damaged bytes never change a number."""
    layer = chance.choice(("cells", "xml", "xml", "bytes"))
    if layer == "bytes":
        data = to_bytes({"zip": members(plain().cells, shared=chance.random() < 0.5)})
        for _ in range(chance.choice((1, 1, 2))):
            data = damaged(data, chance)
        return Case(NAME, ("read", _FILE), {_FILE: from_bytes(data)}, truth=plain_truth())
    seed = rows = chance.choice(WITH_HEADINGS)()
    for _ in range(chance.choice((1, 2)) if layer == "cells" else 0):
        rows = mutated(rows, chance)
    parts: dict[str, Content] = dict(members(rows.cells, shared=chance.random() < 0.5))
    for _ in range(chance.choice((1, 1, 2)) if layer == "xml" else 0):
        parts = _changed(parts, chance)
    case = record_case(NAME, _FILE, b"", seed.options, chance)
    return Case(NAME, case.command, {_FILE: {"zip": parts}})


def _cell(text: str, strings: list[str] | None) -> str:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if value - value == 0.0:
        return f"<c><v>{value!r}</v></c>"
    text = _NOT_XML.sub("?", text)
    if strings is None:
        return f'<c t="inlineStr"><is><t>{escape(text)}</t></is></c>'
    strings.append(text)
    return f'<c t="s"><v>{len(strings) - 1}</v></c>'


def _changed(parts: dict[str, Content], chance: Random) -> dict[str, Content]:
    """One thing that goes wrong in the XML or with a file of the archive."""
    parts = dict(parts)
    name = chance.choice(list(parts))
    text = parts[name] if isinstance(parts[name], str) else ""
    sheet = parts.get(SHEET, "") if isinstance(parts.get(SHEET, ""), str) else ""
    match chance.choice(
        (
            "lost",
            "cut",
            "damaged",
            "odd text",
            "laughs",
            "cell",
            "cell",
            "cell",
            "place",
            "row",
            "row",
            "renamed",
            "strings",
            "name",
        )
    ):
        case "lost":
            del parts[name]
        case "cut":
            parts[name] = text[: chance.randrange(len(text) + 1)]
        case "damaged":
            parts[name] = from_bytes(damaged(text.encode(), chance))
        case "odd text":
            at = chance.randrange(len(text) + 1)
            parts[name] = text[:at] + chance.choice(odd.TEXTS) + text[at:]
        case "laughs":
            parts[SHEET] = sheet.replace(_HEAD, _HEAD + _LAUGHS).replace("<v>", "<v>&j;", 1)
        case "cell":
            cell = f"<c{chance.choice(_TYPES)}>{chance.choice(_CELLS)}</c>"
            parts[SHEET] = _replaced(sheet, r"<c(?: [^>]*)?>.*?</c>", cell, chance)
        case "place":
            parts[SHEET] = _replaced(sheet, "<c(?= |>)", f'<c r="{chance.choice(_PLACES)}"', chance)
        case "row":
            parts[SHEET] = _replaced(sheet, r'<row r="\d+"', f'<row r="{chance.choice(_ROWS)}"', chance)
        case "renamed":
            parts[chance.choice((name.upper(), f"../{name}", f"/{name}", "x", f"{name}/"))] = parts.pop(name)
        case "strings":
            parts["xl/sharedStrings.xml"] = chance.choice(
                ("", "<sst/>", "<a>", _HEAD, _HEAD + _LAUGHS + "<sst>&j;</sst>")
            )
        case "name":
            title = escape(_NOT_XML.sub("?", chance.choice(odd.TEXTS)), {'"': "&quot;"})
            parts["xl/workbook.xml"] = str(parts.get("xl/workbook.xml", "")).replace('"Data"', f'"{title}"')
    return parts


def _replaced(text: str, pattern: str, new: str, chance: Random) -> str:
    """Replace one of the places that match."""
    found = list(re.finditer(pattern, text, re.DOTALL))
    if not found:
        return text
    chosen = chance.choice(found)
    return text[: chosen.start()] + new + text[chosen.end() :]
