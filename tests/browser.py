"""Pages in headless Chromium: what lies where at a given width of the window, and what a pointer shows."""

import base64
import html
import json
import re
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

_PROBE = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Layout:
    """How a page lies in a window.

    Attributes
    ----------
    scroll_width : int
        Pixels that the page is wide; more than the window's where it must be scrolled sideways.
    outside : list of str
        Elements that reach beyond the window, and how far.
    cut : list of str
        Tables and drawings of which a part is seen only by scrolling.
    empty : list of str
        Drawings without width or height.
    clipped : list of str
        Labels that reach beyond the edge of their drawing.
    overlapping : list of str
        Pairs of labels of a drawing that lie on each other.
    faint : list of str
        Texts whose colour is close to what lies behind them, with their contrast (W3C: 1 is none, 21 black on white).
    hovered : list of str
        What the pointer shows on each drawing, in the middle of its first curve.
    """

    scroll_width: int
    outside: list[str]
    cut: list[str]
    empty: list[str]
    clipped: list[str]
    overlapping: list[str]
    faint: list[str]
    hovered: list[str]


def browser() -> str | None:
    """Where the browser is; None if there is none."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def layouts(
    pages: Mapping[str, str | Path], widths: tuple[int, ...], folder: Path, *, dark: bool = False
) -> dict[tuple[str, int], Layout]:
    """Open every page at every width, in frames of one window: a window itself is never narrower than 500 pixels.

    A page is its text, or the file that holds it where it needs other files.
    """
    frames = [
        f'<iframe data-name="{html.escape(name)}" style="border: 0; width: {width}px; height: 900px" '
        + (f'src="{page.as_uri()}"' if isinstance(page, Path) else f'srcdoc="{html.escape(page)}"')
        + "></iframe>"
        for name, page in pages.items()
        for width in widths
    ]
    probe = folder / "probe.html"
    head = '<!DOCTYPE html><meta charset="utf-8">'
    probe.write_text(f"{head}<body>{''.join(frames)}<script>{_PROBE}</script></body>", encoding="utf-8")
    command = [str(browser()), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--dump-dom"]
    command += ["--blink-settings=preferredColorScheme=0"] if dark else []
    command += ["--allow-file-access-from-files"]
    done = subprocess.run(
        [*command, f"--user-data-dir={folder / 'profile'}", probe.as_uri()],
        check=True,
        capture_output=True,
        timeout=300,
    )
    told = re.search(rb"@@([A-Za-z0-9+/=]+)@@", done.stdout)
    assert told is not None, done.stderr.decode()[-500:]
    return {(each.pop("name"), each.pop("width")): Layout(**each) for each in json.loads(base64.b64decode(told[1]))}
