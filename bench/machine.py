"""On what machine, with what build, was it measured?"""

import os
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from probation import _core

ROOT = Path(__file__).resolve().parent.parent

PACKAGES = ("probation", "numpy", "scipy", "numba", "scikit-sundae", "pybind11")


def describe() -> dict[str, object]:
    python = f"{platform.python_implementation()} {platform.python_version()}"
    return {
        "commit": _git("rev-parse", "--short", "HEAD") or "unknown",
        "modified": bool(_git("status", "--porcelain", "--untracked-files=no", "--", "cpp", "python", "bench/*.py")),
        "cpu": cpu(),
        "processors": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}, {python}",
        "kernels": kernels(),
        **_build(),
        "versions": {name: _version(name) for name in PACKAGES},
    }


def cpu() -> str:
    """The processor's name, and its family and model where the name says little."""
    fields = _cpu_fields()
    name = fields.get("model name", platform.processor() or platform.machine())
    numbers = [f"{key} {fields[key]}" for key in ("cpu family", "model") if key in fields]
    return ", ".join([name, *numbers])


def kernels() -> str:
    """Which build of the kernels the engine chose here."""
    forced = " (forced)" if os.environ.get("PROBATION_KERNELS") else ""
    return f"{_core.kernel_build()}{forced}"


def _cpu_fields() -> dict[str, str]:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return {}
    pairs = (line.split(":", 1) for line in text.split("\n\n")[0].splitlines() if ":" in line)
    return {key.strip(): value.strip() for key, value in pairs}


def build_tree() -> Path | None:
    """The newest build tree, if there is one."""
    trees = sorted(ROOT.glob("build/*/build.ninja"), key=lambda path: path.stat().st_mtime)
    return trees[-1].parent if trees else None


def _build() -> dict[str, object]:
    """Compiler and flags, as the engine itself tells them."""
    told = _core.build_information()
    kernels = dict(part.split(": ", 1) for part in told["kernel_flags"].split(" | ") if part)
    return {"compiler": told["compiler"], "flags": told["flags"], "kernel_flags": kernels}


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _git(*arguments: str) -> str:
    return _run("git", "-C", str(ROOT), *arguments).strip()


def _run(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""
