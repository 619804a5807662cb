# SPDX-License-Identifier: Apache-2.0
"""Which files of a source folder an installation puts where: install() of CMakeLists.txt, data_files of setup.py.

The files are read as text and never executed.
"""

from __future__ import annotations

import ast
import os
import re
from fnmatch import fnmatchcase
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

from coframe._files.existence import is_dir
from coframe._files.regular_files import read_regular_text
from coframe.workspace.packages import _console_scripts
from coframe.workspace.packages._console_scripts import short

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["contents", "installed_files"]

_CALL = re.compile(r"\b(set|list|file|install|foreach|endforeach)\s*\(([^()]*)\)", re.IGNORECASE)
_PROJECT = re.compile(r"\bproject\s*\(\s*([\w.\-]{1,255})(?![\w.\-])", re.IGNORECASE)
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
    "RENAME",
    "COMPONENT",
    "TYPE",
}
_MAX_RULES = 10_000
_MAX_CALLS = 10_000  # commands of a CMakeLists.txt; those in loops count each time
_MAX_DEPTH = 50  # folders of a destination
_MAX_LOOPS = 20  # inside each other
_MAX_SEARCHED = 50_000  # files and folders for all patterns of a package


def installed_files(package: Path, name: str) -> dict[str, Path]:
    """Return the source of each file and folder that is installed below ``share/NAME``, by its path there.

    Args:
        package: The source folder.
        name: Name of the package.
    """
    rules: dict[str, Path] = {}
    for destination, source in [*_of_cmake(package, name), *_of_setup(package, name)]:
        relative = _below_share(destination, name)
        if relative is not None and _is_inside(source, package):
            _add(rules, relative, source)
    return rules


def _add(rules: dict[str, Path], relative_path: str, source: Path) -> None:
    """Add a rule. As in CMake, folders that are installed to the same place are merged; the first file applies."""
    if len(rules) >= _MAX_RULES:
        return
    first = rules.setdefault(relative_path, source)
    if first == source or not (first.is_dir() and source.is_dir()) or relative_path.count("/") > _MAX_DEPTH:
        return
    for each in contents(source):
        path = f"{relative_path}/{each.name}"
        if is_dir(first / each.name):
            rules.setdefault(path, first / each.name)
        if path in rules or not os.path.lexists(first / each.name):
            _add(rules, path, each)


def _below_share(destination: str, name: str) -> str | None:
    """Return a path of an installation relative to the share folder of the package, or None if it is elsewhere."""
    parts = PurePosixPath(destination).parts
    if parts[:2] != ("share", name) or ".." in parts or not 3 <= len(parts) <= _MAX_DEPTH or "\0" in destination:
        return None
    return str(PurePosixPath(*parts[2:]))


def _is_inside(source: Path, package: Path) -> bool:
    try:
        return source.exists() and source.resolve().is_relative_to(package.resolve())
    except (OSError, ValueError):
        return False


def contents(folder: Path) -> list[Path]:
    """Return what a folder contains, sorted, or nothing if it is not a folder or cannot be read."""
    try:
        return sorted(folder.iterdir())
    except (OSError, ValueError):
        return []


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
    calls = [(call[1].lower(), call[2]) for call in _CALL.finditer(text)]
    yield from _Commands(package, variables, calls).run(0, len(calls))


class _Commands:
    """Follows the commands of a CMakeLists.txt that define variables, repeat commands or install files.

    Args:
        package: The source folder.
        variables: The variables that CMake defines.
        calls: The commands with their arguments.
    """

    def __init__(self, package: Path, variables: dict[str, str], calls: Sequence[tuple[str, str]]) -> None:
        self._package = package
        self._variables = variables
        self._calls = calls
        self._ends = _ends_of_loops(calls)
        self._search = _Search(package)
        self._calls_left = _MAX_CALLS
        self._loops = 0
        self._bytes_left = _console_scripts.MAX_BYTES  # A few lines can double a variable any number of times.

    def run(self, start: int, end: int) -> Iterator[tuple[str, Path]]:
        """Yield the paths in the installation and their sources for the commands from `start` to before `end`."""
        index = start
        while index < end:
            command, arguments = self._calls[index]
            self._calls_left -= 1
            self._bytes_left -= sum(len(self._variables.get(each, "")) for each in _VARIABLE.findall(arguments))
            if self._calls_left < 0 or self._bytes_left < 0:
                return
            words = self._words(arguments)
            if command == "foreach":
                yield from self._repeat(words, index)
                index = self._ends[index]
            elif command == "install":
                yield from _of_install(words, self._package)
            else:
                self._define(command, words)
            index += 1

    def _words(self, arguments: str) -> list[str]:
        given = [
            _expand_variables(quoted or unquoted, self._variables) for quoted, unquoted in _WORD.findall(arguments)
        ]
        return [word for each in given for word in each.split(";") if word]

    def _define(self, command: str, words: list[str]) -> None:
        if command == "set" and words:
            self._variables[words[0]] = ";".join(words[1:])
        elif command == "list" and words[:1] == ["APPEND"] and len(words) > 2:
            self._variables[words[1]] = ";".join(filter(None, [self._variables.get(words[1], ""), *words[2:]]))
        elif command == "file" and words[:1] in (["GLOB"], ["GLOB_RECURSE"]) and len(words) > 2:
            self._variables[words[1]] = _glob_files(words, self._search)

    def _repeat(self, words: list[str], index: int) -> Iterator[tuple[str, Path]]:
        """Run the loop ``foreach(NAME VALUE...)`` or ``foreach(NAME IN LISTS LIST... ITEMS VALUE...)`` at an index."""
        if self._loops == _MAX_LOOPS or not words:
            return
        name, *values = words
        before = self._variables.get(name)
        self._loops += 1
        for value in self._values(values[1:]) if values[:1] == ["IN"] else values:
            self._variables[name] = value
            yield from self.run(index + 1, self._ends[index])
        self._loops -= 1
        self._variables.pop(name, None)
        if before is not None:
            self._variables[name] = before

    def _values(self, words: list[str]) -> list[str]:
        values: list[str] = []
        kind = ""
        for word in words:
            if word in {"LISTS", "ITEMS"}:
                kind = word
            elif kind == "ITEMS":
                values.append(word)
            else:
                values += filter(None, self._variables.get(word, "").split(";"))
        return values


def _ends_of_loops(calls: Sequence[tuple[str, str]]) -> dict[int, int]:
    """Return the index of the ``endforeach()`` of each loop by that of its ``foreach()``; the end if there is none."""
    ends: dict[int, int] = {}
    started: list[int] = []
    for index, (command, _) in enumerate(calls):
        if command == "foreach":
            started.append(index)
        elif command == "endforeach" and started:
            ends[started.pop()] = index
    return ends | dict.fromkeys(started, len(calls))


def _expand_variables(word: str, variables: dict[str, str]) -> str:
    return _VARIABLE.sub(lambda match: variables.get(match[1], match[0]), word)


def _glob_files(words: list[str], search: _Search) -> str:
    """Return the files that ``file(GLOB NAME PATTERN...)`` finds, separated by semicolons."""
    found: list[str] = []
    for word in words[2:]:
        pattern = PurePosixPath(word)
        if words[0] == "GLOB_RECURSE":
            pattern = pattern.parent / "**" / pattern.name
        found += search.matches(str(pattern))
    return ";".join(found)


def _of_install(words: list[str], package: Path) -> Iterator[tuple[str, Path]]:
    """Yield the paths in the installation and their sources for the arguments of one install()."""
    keys = [word.upper() for word in words]
    if keys[:1] == [] or keys[0] not in _KINDS or "DESTINATION" not in keys:
        return
    destination = "".join(words[keys.index("DESTINATION") + 1 :][:1])
    end = next(index for index, key in enumerate(keys) if index and key in _KEYWORDS)
    name = "".join(words[keys.index("RENAME") + 1 :][:1]) if "RENAME" in keys else ""
    for word in words[1:end]:
        source = package / word
        if keys[0] == "DIRECTORY" and word.endswith("/"):  # The contents of the folder, not the folder.
            for each in contents(source):
                yield f"{destination}/{each.name}", each
        else:
            yield f"{destination}/{name or PurePosixPath(word).name}", source


def _of_setup(package: Path, name: str) -> list[tuple[str, Path]]:
    try:
        return list(_of_tree(ast.parse(_text(package / "setup.py")), package, name))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def _of_tree(tree: ast.Module, package: Path, name: str) -> Iterator[tuple[str, Path]]:
    names: dict[str, Any] = {"package_name": name}
    search = _Search(package)
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            names[statement.targets[0].id] = _value(statement.value, names, search)
        elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
            _append(statement.value, names, search)
    calls = (each for each in ast.walk(tree) if isinstance(each, ast.Call) and _called_name(each) == "setup")
    keywords = (keyword for call in calls for keyword in call.keywords if keyword.arg == "data_files")
    for keyword in keywords:
        for rule in _value(keyword.value, names, search) or ():
            if isinstance(rule, list) and len(rule) == 2 and isinstance(rule[0], str) and isinstance(rule[1], list):
                for file in rule[1]:
                    if isinstance(file, str):
                        yield f"{rule[0]}/{PurePosixPath(file).name}", package / file


def _append(call: ast.Call, names: dict[str, Any], search: _Search) -> None:
    """Apply ``NAME.append(VALUE)`` and ``NAME.extend(VALUES)`` to a list."""
    owner = getattr(call.func, "value", None)
    values = names.get(owner.id) if isinstance(owner, ast.Name) else None
    if not isinstance(values, list) or len(call.args) != 1:
        return
    value = _value(call.args[0], names, search)
    if _called_name(call) == "append":
        values.append(value)
    elif _called_name(call) == "extend" and isinstance(value, list) and short([*values, *value]):
        values.extend(value)


def _called_name(call: ast.Call) -> str:
    return call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")


def _value(node: ast.expr, names: dict[str, Any], search: _Search) -> Any:
    """Return the value of an expression of literals, variables, ``os.path.join()`` and ``glob()``; else None."""
    if isinstance(node, ast.List | ast.Tuple):
        return [_value(item, names, search) for item in node.elts]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _value(node.left, names, search), _value(node.right, names, search)
        return short(left + right) if type(left) is type(right) and isinstance(left, str | list) else None
    if isinstance(node, ast.Call) and node.args:
        arguments = [_value(argument, names, search) for argument in node.args]
        if _called_name(node) == "join" and all(isinstance(argument, str) for argument in arguments):
            return short(str(PurePosixPath(*arguments)))
        if _called_name(node) in {"glob", "iglob"} and isinstance(arguments[0], str):
            return search.matches(arguments[0])
        return None
    return _console_scripts.value_of(node, names)


class _Search:
    """A search for the files of a package that match patterns, with a limit for all of them together."""

    def __init__(self, package: Path) -> None:
        self._package = package
        self._steps_left = _MAX_SEARCHED

    def matches(self, pattern: str) -> list[str]:
        """Return the files in the package that match a pattern, relative to it."""
        parts = PurePosixPath(pattern).parts
        if not parts or pattern.startswith("/") or ".." in parts or self._steps_left < 0:
            return []
        found = sorted(set(self._find_below(self._package, parts)))
        return [each.relative_to(self._package).as_posix() for each in found[:_MAX_RULES]]

    def _find_below(self, folder: Path, parts: Sequence[str]) -> Iterator[Path]:
        """Yield what matches the parts of a pattern in a folder, until no steps are left."""
        first, *rest = parts
        if first == "**" and rest:
            yield from self._find_below(folder, rest)
        for each in contents(folder):
            self._steps_left -= 1
            if self._steps_left < 0:
                return
            if first == "**" and each.is_dir() and not each.is_symlink():
                yield from self._find_below(each, parts)
            if not fnmatchcase(each.name, first) or each.name.startswith(".") > first.startswith("."):
                continue
            if not rest:
                yield each
            elif first != "**" and each.is_dir():
                yield from self._find_below(each, rest)
