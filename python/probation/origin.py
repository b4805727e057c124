"""Version and commit of the running program."""

from __future__ import annotations

import subprocess
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from probation._core import __version__


@cache
def commit() -> str:
    """Of the source tree that the package runs from, "+" if it was changed since; empty outside of one."""
    folder = Path(__file__).parent
    head = _git(folder, "rev-parse", "--short=12", "HEAD")
    if not head or not _git(folder, "ls-files", "--error-unmatch", Path(__file__).name):
        return ""
    return head + ("+" if _git(folder, "status", "--porcelain", "--untracked-files=no", ".") else "")


def _git(folder: Path, *arguments: str) -> str:
    try:
        done = subprocess.run(
            ["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=False, timeout=20
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def origin() -> dict[str, str]:
    """Version, commit and the time of now."""
    return {"version": __version__, "commit": commit(), "at": now()}


def now() -> str:
    """Universal time, to the microsecond."""
    return datetime.now(UTC).isoformat(timespec="microseconds")
