"""Every page of the site in a browser: ``python -m site_pages build/docs/html``, which `make docs` calls.

Light and dark, on a desk and on a telephone, nothing sticks out, no table is cut, no text is faint. Listings may be
scrolled.
"""

import sys
import tempfile
from pathlib import Path

from browser import Layout, browser, layouts

DESK, TELEPHONE = 1280, 390
_TOGETHER = 16  # pages in one window
_EMPTY = ("search.html", "genindex.html", "py-modindex.html")


def faults(found: Layout, width: int) -> list[str]:
    """What is wrong with a page at that width."""
    told = [f"sticks out: {each}" for each in found.outside]
    told += [f"is {found.scroll_width} pixels wide"] if found.scroll_width > width else []
    told += [f"is cut: {each}" for each in found.cut if each.startswith("TABLE")]
    return told + [f"is faint: {each}" for each in found.faint]


def look(folder: Path) -> list[str]:
    """What is wrong, with the page, the width and the theme in front; colours do not depend on the width."""
    pages = [
        (str(path.relative_to(folder)), path) for path in sorted(folder.rglob("*.html")) if path.name not in _EMPTY
    ]
    told = []
    with tempfile.TemporaryDirectory() as made:
        for first in range(0, len(pages), _TOGETHER):
            some = dict(pages[first : first + _TOGETHER])
            for theme, widths in (("light", (DESK, TELEPHONE)), ("dark", (DESK,))):
                opened = layouts(some, widths, Path(made), dark=theme == "dark")
                for (name, width), found in opened.items():
                    told += [f"{name}, {width} pixels, {theme}: {fault}" for fault in faults(found, width)]
    print(f"docs: {len(pages)} pages opened, light and dark, {DESK} and {TELEPHONE} pixels wide: {len(told)} faults")
    return told


if __name__ == "__main__":
    if browser() is None:
        print("docs: no browser here (chromium was looked for): the pages were not opened")
        sys.exit(0)
    wrong = look(Path(sys.argv[1]).resolve())
    print("\n".join(wrong), file=sys.stderr, end="\n" if wrong else "")
    sys.exit(bool(wrong))
