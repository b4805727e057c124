"""Do the types we publish for the compiled module tell the truth about it?"""

import ast
import inspect
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from probation import _core

ROOT = Path(__file__).parents[2]
STUB = ROOT / "python" / "probation" / "_core.pyi"

Signatures = dict[str, list[list[str]]]  # dotted name -> argument names of each overload

# What pybind11 adds to a class and no stub needs to repeat.
MACHINERY = re.compile(
    r"\.__init__ is inconsistent, stub does not have \*args parameter"  # a class without a constructor
    r"|\.__init__ is inconsistent, stub does not have \*\*kwargs parameter"
    r"| is inconsistent, metaclass differs"
)
ENUM_MACHINERY = {"__init__", "__index__", "__int__", "__members__", "__pybind11_native_enum__", "name", "value"}


def split_arguments(text: str) -> Iterator[str]:
    """Split at the commas that are in no bracket and in no string."""
    depth, quote, start = 0, "", 0
    for position, character in enumerate(text):
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        elif character in "([{<":
            depth += 1
        elif character in ")]}>" and text[position - 1] != "-":
            depth -= 1
        elif character == "," and depth == 0:
            yield text[start:position]
            start = position + 1
    if text[start:].strip():
        yield text[start:]


def argument_names(arguments: str) -> list[str]:
    names = [re.match(r"\s*([*/]*\w*)", part).group(1) for part in split_arguments(arguments)]  # type: ignore[union-attr]
    return [name for name in names if name not in ("self", "/", "*")]


def documented(name: str, docstring: str) -> list[list[str]]:
    """Argument names from the signature lines that pybind11 puts into a docstring."""
    lines = re.findall(rf"^(?:\d+\. )?{re.escape(name)}\((.*)\)(?: -> .*)?$", docstring, flags=re.MULTILINE)
    return [argument_names(line) for line in lines if line != "*args, **kwargs"]


def is_machinery(dotted: str) -> bool:
    owner, _, member = dotted.rpartition(".")
    return member in ENUM_MACHINERY and hasattr(getattr(_core, owner, None), "__members__")


def compiled_signatures() -> Signatures:
    found: Signatures = {}
    for name, thing in public_members(_core):
        if inspect.isclass(thing):
            for method, function in vars(thing).items():
                if is_machinery(f"{name}.{method}"):
                    continue
                if callable(function) and (not method.startswith("_") or method == "__init__"):
                    found[f"{name}.{method}"] = documented(method, function.__doc__ or "")
        elif callable(thing):
            found[name] = documented(name, thing.__doc__ or "")
    return {name: signatures for name, signatures in found.items() if signatures}


def stub_signatures() -> Signatures:
    found: Signatures = {}

    def visit(body: list[ast.stmt], prefix: str) -> None:
        for node in body:
            if isinstance(node, ast.ClassDef):
                visit(node.body, f"{node.name}.")
            elif isinstance(node, ast.FunctionDef):
                arguments = node.args
                names = [a.arg for a in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
                found.setdefault(prefix + node.name, []).append([name for name in names if name != "self"])

    visit(ast.parse(STUB.read_text(encoding="utf-8")).body, "")
    return found


def public_members(module: object) -> list[tuple[str, object]]:
    return [(name, thing) for name, thing in vars(module).items() if not name.startswith("_")]


def test_every_public_name_is_in_the_stub_and_back():
    stubbed = set()
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            stubbed.add(node.name)
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            stubbed.add(node.target.id)
    compiled = {name for name, _ in public_members(_core)}
    assert {name for name in stubbed if not name.startswith("_")} == compiled


def test_arguments_have_the_names_that_the_stub_gives_them():
    """Overloads that differ by type alone may be more or fewer in the stub."""
    stubbed = stub_signatures()
    wrong = {}
    for name, signatures in compiled_signatures().items():
        if set(map(tuple, signatures)) != set(map(tuple, stubbed.get(name, []))):
            wrong[name] = {"compiled": signatures, "_core.pyi": stubbed.get(name)}
    assert not wrong


def test_mypy_finds_the_stub_true():
    run = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "probation._core", "--concise", "--ignore-disjoint-bases"],
        cwd=ROOT,
        env={**os.environ, "MYPYPATH": str(ROOT / "python")},
        capture_output=True,
        text=True,
        check=False,
    )
    said = []
    for line in (run.stdout + run.stderr).splitlines():
        missing = re.match(r"probation\._core\.(\S+) is not present in stub", line)
        if line.strip() and not MACHINERY.search(line) and not (missing and is_machinery(missing[1])):
            said.append(line)
    assert not said, "\n".join(said)


@pytest.mark.parametrize(
    ("signature", "names"),
    [
        ("f() -> None", []),
        ("f(self: m.C, a: typing.Annotated[x, 'p, q'], b: dict[str, int] = {'k': 1}) -> int", ["a", "b"]),
        ("f(a: typing.Callable[[float, int], float], *, b: m.C = <m.C object at 0x7f>) -> m.C", ["a", "b"]),
    ],
)
def test_signatures_are_read_past_brackets_strings_and_defaults(signature, names):
    assert documented("f", signature) == [names]
