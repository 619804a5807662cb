# SPDX-License-Identifier: Apache-2.0
"""Read the console scripts and components that a Python package declares, without running its files."""

from __future__ import annotations

import ast
import configparser
import re
import sys
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.regular_files import read_regular_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from pathlib import Path

__all__ = ["PythonPackage", "read", "short", "value_of"]

MAX_BYTES = 1 << 18  # of a file
_MAX_DOTS = 4000  # of pyproject.toml; a key takes quadratic time, and this many dots in one key half a second

_COMPONENTS = "rclpy_components"  # group of the entry points of composable nodes
# Names of components contain colons: demo_nodes_py::Talker
_SCRIPT = re.compile(r"\s*([\w.\-:]+)\s*=\s*([\w.]+\s*:\s*[\w.]+)\s*(?:\[.*\])?\s*", re.ASCII)


class PythonPackage(NamedTuple):
    """The declarations in the files of a Python package.

    Attributes:
        scripts: ``module:function`` of each console script.
        files: Paths of script files, relative to the package.
        root: Folder for PYTHONPATH, relative to the package.
        components: ``module:class`` of each composable node.
    """

    scripts: dict[str, str]
    files: tuple[str, ...] = ()
    root: str = "."
    components: Mapping[str, str] = MappingProxyType({})


def read(package: Path) -> PythonPackage:
    """Read ``setup.py``, ``setup.cfg`` and ``pyproject.toml``. Missing or damaged files are ignored."""
    scripts: dict[str, str] = {}
    components: dict[str, str] = {}
    files: tuple[str, ...] = ()
    root = ""
    for name, reader in (("pyproject.toml", _pyproject), ("setup.cfg", _setup_cfg), ("setup.py", _setup_py)):
        try:
            found = reader(read_regular_text(package / name, MAX_BYTES))
        except (OSError, ValueError, SyntaxError, RecursionError, MemoryError, configparser.Error):
            continue
        scripts |= found.scripts
        components |= found.components
        files += found.files
        root = root or (found.root if found.root != "." else "")
    if (
        not root
        and (package / "src").is_dir()
        and _modules_in(package / "src", [*scripts.values(), *components.values()])
    ):
        root = "src"
    return PythonPackage(scripts, files, root or ".", components)


def _modules_in(folder: Path, targets: Iterable[str]) -> bool:
    tops = {target.partition(":")[0].partition(".")[0] for target in targets}
    return any((folder / top).is_dir() or (folder / f"{top}.py").is_file() for top in tops)


def _parse_lines(lines: Any) -> Iterator[tuple[str, str]]:
    """Yield name and target of lines ``name = module:function``."""
    for line in lines.splitlines() if isinstance(lines, str) else lines or ():
        if isinstance(line, str) and (match := _SCRIPT.fullmatch(line)):
            yield match[1], re.sub(r"\s", "", match[2])


def _setup_cfg(text: str) -> PythonPackage:
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(text)
    scripts, components = (
        dict(_parse_lines(parser.get("options.entry_points", group, fallback="")))
        for group in ("console_scripts", _COMPONENTS)
    )
    folders = parser.get("options", "package_dir", fallback="")
    root = next((line.strip()[1:].strip() for line in folders.splitlines() if line.strip().startswith("=")), ".")
    files = parser.get("options", "scripts", fallback="").split()
    return PythonPackage(scripts, tuple(files), root, components)


def _pyproject(text: str) -> PythonPackage:
    if text.count(".") > _MAX_DOTS:
        return PythonPackage({})
    if sys.version_info >= (3, 11):
        import tomllib  # noqa: PLC0415 - Python 3.10 does not have it

        tables: dict[str, Any] = tomllib.loads(text)
        project = tables.get("project", {})
        declared = project.get("scripts") or tables.get("tool", {}).get("poetry", {}).get("scripts")
        composed = project.get("entry-points", {}).get(_COMPONENTS)
    else:
        declared = _pairs_in(r"(?:project|tool\.poetry)\.scripts", text)
        composed = _pairs_in(rf"project\.entry-points\.{_COMPONENTS}", text)
    scripts, components = (
        dict(_parse_lines([f"{name} = {target}" for name, target in (table or {}).items()]))
        for table in (declared, composed)
    )
    return PythonPackage(scripts, components=components)


def _pairs_in(table: str, text: str) -> dict[str, str]:
    """Return the strings in a table of pyproject.toml; Python 3.10 has no parser."""
    section = re.search(rf"(?ms)^\[{table}\]\s*$(.*?)(?=^\[|\Z)", text)
    pair = re.compile(r"""(?m)^\s*["']?([\w.\-:]+)["']?\s*=\s*["']([^"']+)["']""")
    return dict(pair.findall(section[1] if section else ""))


def _setup_py(text: str) -> PythonPackage:
    tree = ast.parse(text)
    names: dict[str, Any] = {}
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            names[statement.targets[0].id] = value_of(statement.value, names)
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and _called_name(call.func) == "setup":
            arguments = {each.arg: value_of(each.value, names) for each in call.keywords if each.arg}
            return _from_setup_arguments(arguments)
    return PythonPackage({})


def _from_setup_arguments(arguments: dict[str, Any]) -> PythonPackage:
    entry_points = arguments.get("entry_points") or {}
    if isinstance(entry_points, str):  # the format of an .ini file
        parser = configparser.ConfigParser(interpolation=None, delimiters=("=",))
        parser.optionxform = str  # type: ignore[assignment, method-assign]  # names keep their case
        parser.read_string(entry_points)
        entry_points = {
            group: [f"{name} = {target}" for name, target in parser.items(group)] for group in parser.sections()
        }
    scripts, components = (
        dict(_parse_lines(entry_points.get(group))) if isinstance(entry_points, dict) else {}
        for group in ("console_scripts", _COMPONENTS)
    )
    files = arguments.get("scripts")
    folders = arguments.get("package_dir")
    root = folders.get("") if isinstance(folders, dict) else None
    return PythonPackage(
        scripts,
        tuple(file for file in files if isinstance(file, str)) if isinstance(files, list) else (),
        root if isinstance(root, str) and root else ".",
        components,
    )


def short(value: str | list[Any]) -> Any:
    """Return a value, or None if it is too long, because a few lines can double a string any number of times."""
    return value if len(value) <= MAX_BYTES else None


def _is_short(part: Any) -> bool:
    """Return whether a value is a string, or an integer that becomes a short one."""
    return isinstance(part, str) or (isinstance(part, int) and part.bit_length() <= 64)


def _called_name(function: ast.expr) -> str:
    return function.id if isinstance(function, ast.Name) else getattr(function, "attr", "")


def value_of(node: ast.expr, names: dict[str, Any]) -> Any:
    """Return the value of a literal, a variable, or a string composed of these, or None for anything else."""
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.Dict):
        pairs = zip(node.keys, node.values, strict=True)
        named = ((value_of(key, names), value_of(item, names)) for key, item in pairs if key)
        return {key: item for key, item in named if isinstance(key, str)}
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = value_of(node.left, names), value_of(node.right, names)
        return short(left + right) if type(left) is type(right) and isinstance(left, str | list) else None
    if isinstance(node, ast.JoinedStr):
        parts = [value_of(part.value if isinstance(part, ast.FormattedValue) else part, names) for part in node.values]
        return short("".join(map(str, parts))) if all(map(_is_short, parts)) else None
    return [value_of(item, names) for item in node.elts] if isinstance(node, ast.List | ast.Tuple) else None
