"""On what machine, with what build, was it measured?"""

import os
import platform
import re
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
    forced = " (forced)" if os.environ.get("PROBATION_KERNELS") == "baseline" else ""
    return f"{_core.kernel_build()}{forced}"


def _cpu_fields() -> dict[str, str]:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return {}
    pairs = (line.split(":", 1) for line in text.split("\n\n")[0].splitlines() if ":" in line)
    return {key.strip(): value.strip() for key, value in pairs}


def _build() -> dict[str, object]:
    """Compiler and flags of the newest build tree, if it is there."""
    trees = sorted(ROOT.glob("build/*/build.ninja"), key=lambda path: path.stat().st_mtime)
    if not trees:
        return {"compiler": "unknown (no build tree)", "kernel_flags": {}}
    text = trees[-1].read_text(encoding="utf-8")
    flags = re.findall(r"kernels_(\w+)\.dir/src/kernels/modal_sweep\.cpp\.o:.*?\n(?:.*\n)*?\s+FLAGS = (.*)", text)
    cache = trees[-1].with_name("CMakeCache.txt").read_text(encoding="utf-8")
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE)
    says = _run(compiler.group(1), "--version").splitlines() if compiler else []
    return {"compiler": says[0] if says else "unknown", "kernel_flags": dict(flags)}


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
