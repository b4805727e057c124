"""What `make docs` finds wrong with a page of the site."""

import pytest

from browser import browser
from site_pages import look

PAGE = "<!DOCTYPE html><meta charset='utf-8'><body style='margin: 0; background: #fff; color: #222'>{}</body>"


@pytest.mark.skipif(browser() is None, reason="no browser here: chromium was looked for")
def test_a_page_that_sticks_out_a_cut_table_and_a_faint_text_are_found(tmp_path):
    cell = "<td><div style='width: 600px'>a table</div></td>"
    bodies = {
        "good": "<p>Text.</p><pre style='overflow-x: auto'>" + 99 * "a listing " + "</pre>",
        "wide": "<div style='width: 800px'>wide</div>",
        "cut": f"<table style='display: block; overflow-x: auto'><tr>{cell}</tr></table>",
        "faint": "<p style='color: #bbb'>faint</p>",
    }
    for name, body in bodies.items():
        (tmp_path / f"{name}.html").write_text(PAGE.format(body), encoding="utf-8")
    found = [fault.split(": ", 1) for fault in look(tmp_path)]
    assert {(where, what.split(":")[0]) for where, what in found} == {
        ("wide.html, 390 pixels, light", "sticks out"),
        ("wide.html, 390 pixels, light", "is 800 pixels wide"),
        ("cut.html, 390 pixels, light", "is cut"),
        ("faint.html, 1280 pixels, light", "is faint"),
        ("faint.html, 390 pixels, light", "is faint"),
        ("faint.html, 1280 pixels, dark", "is faint"),
    }
