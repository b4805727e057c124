"""The page of references holds what is cited by author and year, and nothing else."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/references.md"

NAME = r"(?:(?:Le|van) )?[A-Z](?:[^\W\d_]|['-])*[^\W\d_](?<!'s)"
CITATION = re.compile(
    rf"(?P<first>{NAME})(?:, (?:Le )?{NAME})*(?:,? (?:&|and|et) (?:Le Tallec|{NAME}|others|al\.))?(?:'s)? "
    r"\(?(?P<year>1[6-9]\d\d|20\d\d)\b"
)
NO_NAMES = {"November"}


def _text(path):
    """As it reads: strings over several lines joined, no comment signs."""
    text = path.read_text(encoding="utf-8").replace("\u2019", "'")
    if path.suffix != ".md":
        text = re.sub(r'"\s*\n\s*f?"', "", text)
    return re.sub(r"\s*\n\s*(?:/{2,}|#)?\s*", " ", text)


def _cited(paths):
    """(first author, year) and the file."""
    for path in paths:
        for found in CITATION.finditer(_text(path)):
            if found["first"] not in NO_NAMES:
                yield (found["first"], found["year"]), path.relative_to(ROOT).as_posix()


def _listed():
    """First authors and years of the page, in its order."""
    heads = re.findall(r"^- \*\*([^*]+)\s(\d{4})\*\*", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    return [(re.split(r",? & |, | et al", " ".join(names.split()))[0], year) for names, year in heads]


def _sources():
    yield from (ROOT / "python" / "probation").rglob("*.py")
    yield from (path for path in (ROOT / "docs").glob("*.md") if path != PAGE)
    yield from (ROOT / "cpp").rglob("*.hpp")


def test_every_work_that_is_cited_by_author_and_year_is_on_the_page():
    listed = set(_listed())
    assert [f"{where}: {name} {year}" for (name, year), where in _cited(_sources()) if (name, year) not in listed] == []


def test_every_work_on_the_page_is_cited_somewhere():
    studies = (ROOT / "python" / "probation_studies").rglob("*.py")
    cited = {work for work, _ in _cited((*_sources(), *studies))}
    assert [work for work in _listed() if work not in cited] == []


def test_the_page_is_sorted():
    keys = [(name.replace("'", "").lower(), year) for name, year in _listed()]
    assert keys == sorted(keys)
