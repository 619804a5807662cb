# SPDX-License-Identifier: Apache-2.0
"""Which files of a source folder an installation puts where: install() of CMakeLists.txt, data_files of setup.py.

The files are read as text and never executed.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

from coframe._files.regular_files import read_regular_text
from coframe.workspace.packages import _console_scripts

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["installed_files"]

_CALL = re.compile(r"\binstall\s*\(([^()]*)\)", re.IGNORECASE)
_PROJECT = re.compile(r"\bproject\s*\(\s*([\w.\-]+)", re.IGNORECASE)
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_WORD = re.compile(r'"([^"]*)"|([^\s"]+)')
_KINDS = {"DIRECTORY", "FILES", "PROGRAMS"}
# Words of install() that end the list of files.
_KEYWORDS = {
    "DESTINATION",
    "PATTERN",
    "REGEX",
    "USE_SOURCE_PERMISSIONS",
    "PERMISSIONS",
    "OPTIONAL",
    "COMPONENT",
    "TYPE",
}
_MAX_RULES = 10_000


def installed_files(package: Path, name: str) -> dict[str, Path]:
    """Return the source of each file and folder that is installed below ``share/NAME``, by its path there.

    Args:
        package: The source folder.
        name: Name of the package.
    """
    rules: dict[str, Path] = {}
    for destination, source in [*_of_cmake(package, name), *_of_setup(package, name)]:
        relative = _below_share(destination, name)
        if relative is not None and len(rules) < _MAX_RULES and _is_inside(source, package):
            rules.setdefault(relative, source)
    return rules


def _below_share(destination: str, name: str) -> str | None:
    """Return a path of an installation relative to the share folder of the package; None if it is elsewhere."""
    parts = PurePosixPath(destination).parts
    if parts[:2] != ("share", name) or ".." in parts or len(parts) < 3:
        return None
    return str(PurePosixPath(*parts[2:]))


def _is_inside(source: Path, package: Path) -> bool:
    try:
        return source.exists() and source.resolve().is_relative_to(package.resolve())
    except OSError:
        return False


def _text(path: Path) -> str:
    try:
        return read_regular_text(path, _console_scripts.MAX_BYTES)
    except (OSError, UnicodeDecodeError):
        return ""


def _of_cmake(package: Path, name: str) -> Iterator[tuple[str, Path]]:
    text = re.sub(r"#.*", "", _text(package / "CMakeLists.txt"))
    project = _PROJECT.search(text)
    variables = {
        "PROJECT_NAME": project[1] if project else name,
        "CMAKE_PROJECT_NAME": project[1] if project else name,
        "CMAKE_CURRENT_SOURCE_DIR": ".",
        "CMAKE_SOURCE_DIR": ".",
        "PROJECT_SOURCE_DIR": ".",
        "CMAKE_INSTALL_DATADIR": "share",
        "CMAKE_INSTALL_DATAROOTDIR": "share",
    }
    for call in _CALL.finditer(text):
        words = [quoted or bare for quoted, bare in _WORD.findall(call[1])]
        yield from _of_install([_expanded(word, variables) for word in words], package)


def _expanded(word: str, variables: dict[str, str]) -> str:
    return _VARIABLE.sub(lambda match: variables.get(match[1], match[0]), word)


def _of_install(words: list[str], package: Path) -> Iterator[tuple[str, Path]]:
    """Yield the paths in the installation and their sources for the arguments of one install()."""
    keys = [word.upper() for word in words]
    if keys[:1] == [] or keys[0] not in _KINDS or "DESTINATION" not in keys:
        return
    destination = "".join(words[keys.index("DESTINATION") + 1 :][:1])
    end = next(index for index, key in enumerate(keys) if index and key in _KEYWORDS)
    for word in words[1:end]:
        source = package / word
        if keys[0] == "DIRECTORY" and word.endswith("/"):  # The contents of the folder, not the folder.
            for each in sorted(source.iterdir()) if source.is_dir() else ():
                yield f"{destination}/{each.name}", each
        else:
            yield f"{destination}/{PurePosixPath(word).name}", source


def _of_setup(package: Path, name: str) -> Iterator[tuple[str, Path]]:
    try:
        tree = ast.parse(_text(package / "setup.py"))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    names: dict[str, Any] = {"package_name": name}
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            names[statement.targets[0].id] = _value(statement.value, names, package)
    calls = (each for each in ast.walk(tree) if isinstance(each, ast.Call) and _called(each) == "setup")
    keywords = (keyword for call in calls for keyword in call.keywords if keyword.arg == "data_files")
    for keyword in keywords:
        for rule in _value(keyword.value, names, package) or ():
            if isinstance(rule, list) and len(rule) == 2 and isinstance(rule[0], str) and isinstance(rule[1], list):
                for file in rule[1]:
                    if isinstance(file, str):
                        yield f"{rule[0]}/{PurePosixPath(file).name}", package / file


def _called(call: ast.Call) -> str:
    return call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")


def _value(node: ast.expr, names: dict[str, Any], package: Path) -> Any:
    """Return the value of an expression of literals, variables, ``os.path.join()`` and ``glob()``; else None."""
    if isinstance(node, ast.List | ast.Tuple):
        return [_value(item, names, package) for item in node.elts]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _value(node.left, names, package), _value(node.right, names, package)
        is_same = type(left) is type(right) and isinstance(left, str | list)
        return left + right if is_same and len(left) + len(right) <= _console_scripts.MAX_BYTES else None
    if isinstance(node, ast.Call) and node.args:
        arguments = [_value(argument, names, package) for argument in node.args]
        if _called(node) == "join" and all(isinstance(argument, str) for argument in arguments):
            return str(PurePosixPath(*arguments))
        if _called(node) in {"glob", "iglob"} and isinstance(arguments[0], str):
            return _matches(package, arguments[0])
        return None
    return _console_scripts.value_of(node, names)


def _matches(package: Path, pattern: str) -> list[str]:
    """Return the files in a package that match a pattern, relative to it."""
    if pattern.startswith("/") or ".." in PurePosixPath(pattern).parts:
        return []
    try:
        found = sorted(package.glob(pattern))
    except (ValueError, NotImplementedError, OSError):
        return []
    return [each.relative_to(package).as_posix() for each in found[:_MAX_RULES]]
