"""What has no place in a file and stands there all the same."""

from __future__ import annotations

NUMBERS = (
    "1e308", "-1e308", "1e309", "1e400", "-1e400", "1e-320", "-0", "0", "nan", "NaN", "inf", "-inf", "Infinity", "1e",
    "1e99999999999", "9" * 400, "1" + "0" * 5000, "0." + "0" * 400 + "1", "1_000", "0x1f", "1d3", "٣", "１２", "½",
    "1,5", "1.234,5", "1,234.5", "1'234.5", "1 234.5", "+-1", "--1", ".", ",", "-", "1e5e5", "12 MPa", "12%", "5,0,0",
    "1/2",
)  # fmt: skip
TEXTS = (
    "", " ", "abc", "true", "None", "null", "#DIV/0!", "#N/A", "=1+1", "2020-01-01", "12:30:01", "\x1b[31mred\x1b[0m",
    "\x1b]0;title\x07", "\u202eevil", "\u2066x\u2069", "\x07", "\x08\x08", "\x7f", "\x9b31m", "\u2028", "\x85",
    "\x0b", "\x0c", "\ufeff", "\ufffd", "\U0001f600", "<script>alert(1)</script>", "</svg>", "'", '"', '"open',
    "a\tb", "%s%n", "{0}", "$\\frac{1}{0}$", "x" * 300, "x" * 20_000, "é" * 50, "../../etc/passwd", "[", "]",
    "[[red]]", "a=b",
)  # fmt: skip
CELLS = (*NUMBERS, *TEXTS)

UNITS = (
    "segments", "count", "text", "index", "-", "", "[]", "()", "s**9**9**9", "s^9^9^9", "9**9**9**9", "m**1e300",
    "m**(1/0)", "s/0", "nan s", "inf s", "1e400 s", "((((s))))", "(" * 200 + "s" + ")" * 200, "s*" * 500 + "s",
    "lambda x: x", "__import__('os')", "s;s", "s s", "s**s", "degC**2", "degC/s", "dB", "dBm", "delta_degC", "pH",
    "decade", "bit", "mol", "cd", "V", "mPa", "M", "k", "%%", "‰", "µ", "Å", "°", "°C", "10**3 N", "kN kN", "N.mm",
    "N-mm", "N//mm", "/mm2", "mm/", "1/", "s^-1", "s-1", "s⁻¹", "1/min", "kilofurlong", "\x1b[31m", "x" * 5000,
    "e" * 300, "#", "?", "eV", "planck_constant", "pi", "10", "0", "-1", "s**-0.5", "MPa s", "N/mm²", "N/mm^2",
    "N mm^-2", "kgf/cm2", "psi",
)  # fmt: skip
HEADINGS = (
    "", " ", "time", "time_s", "Time (s)", "t", "true_strain", "True strain [%]", "strain", "stress", "force",
    "Load (kN)", "kN", "mm", "s", "MPa", "true_stress_MPa", "temperature_C", "strain_rate_per_s",
    "strain_rate [1/min]", "transverse_strain", "stretch", "displacement / mm", "nan", "1", "1e400", "time time",
    "Time\n(s)", "TIME [S]", "time [s] [s]", "time (s", "time s)", "force in kN", "force, kN",
    "engineering_stress_kPa", "Zeit", "时间", "Время", *TEXTS,
)  # fmt: skip

TOML_VALUES = (
    "nan", "inf", "-inf", "1e400", "-1e400", "1e308", "1e-320", "0", "-1", "-0.0", "1", "2", "0.5", "9" * 25,
    "9" * 400, "9" * 5000, "-" + "9" * 400, "0x" + "f" * 400, "1e-999999999", "true", "false", '""', '" "', '"text"',
    "''", "[]", "{}", "[1, 2]", "[[1, 2], [3]]", '["a", 1]', "[nan]", "[true]", "[1e400, 2]",
    "[" + "9" * 400 + ", 1]", "{ a = 1 }", "{ a = { b = { c = 1 } } }", "[" * 100 + "]" * 100,
    "[" * 5000 + "]" * 5000, "2020-01-01", "12:00:00", "1979-05-27T07:32:00Z", '"\\u001b[31m"', '"a\\u0000b"',
    '"\\u202e"', '"/dev/zero"', '"/dev/null"', '"."', '".."', '"../campaign.toml"', '"campaign.toml"',
    '"no-such-file.csv"', '"' + "x" * 300 + '"', '"' + "x" * 20_000 + '"', '"a/' + "b" * 300 + '.csv"', '"~"', '"*"',
    '"\\n"', '"C:\\\\a"', "'''a\nb'''", '"identify"', '"held-out"', '"cyclic"', '"weissenberg"', '"table"', '"power"',
    '"exponential"', '"s**9**9**9"', '"kN"', "1_000", "=", "", "1 2", "{", "[", '"open',
)  # fmt: skip
JSON_VALUES = (
    None, True, False, 0, 1, -1, 0.5, -0.0, 1e308, -1e308, 1e-320, float("nan"), float("inf"), float("-inf"), 10**25,
    10**400, -(10**400), "", " ", "text", "nan", "1e400", "weissenberg", "table", "\x1b[31mred", "\u202eevil",
    "a\u0000b", "x" * 300, "x" * 20_000, "**end\n*MATERIAL", [], {}, [1, 2], [[]], [None], [1e308, 1e308],
    [float("nan"), 1.0], {"a": 1}, {"form": "table"},
)  # fmt: skip
