# SPDX-License-Identifier: Apache-2.0
"""The pages of the ROS packages that coframe provides: which modules, classes and functions exist, and which do not."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import griffe

from rclpy._absent import ABSENT, ABSENT_ATTRIBUTES

if TYPE_CHECKING:
    from collections.abc import Iterator

_FOLDER = Path(__file__).resolve().parents[2] / "src" / "ros"
_MESSAGES = re.compile(
    r"^(?!tf2_\w+_msgs).*_msgs$|^tf2_msgs$|_interfaces$|_srvs$|^rmw_"
)  # tf2_geometry_msgs and the like have code
_PAGE = "reference/ros-packages"
_INDEX = """# ROS packages without ROS

`import rclpy`, `import tf2_ros` and the packages below work without a ROS installation: see [Coming from
tf2](../../how-to/coming-from-tf2.md). Each page lists the modules, classes and functions that exist; they have the
names and arguments of ROS 2 Humble, Jazzy and Kilted, and the additions of Lyrical. Message packages are listed in
[your own messages](../../how-to/own-messages.md#what-coframe-contains).

| package | contents |
|---|---|
"""
_ABSENT = """
## Names that do not exist { #absent }

Using one of these names of ROS 2 raises an error with the sentence on its right.

| name in ROS 2 | instead |
|---|---|
"""


def pages() -> dict[str, str]:
    """Return the pages, by their paths."""
    loader = griffe.GriffeLoader(search_paths=[str(_FOLDER), str(_FOLDER.parent)], allow_inspection=False)
    loader.load("coframe")  # some of the names are defined there
    packages = {name: loader.load(name) for name in _names()}
    rows = "".join(f"| [`{name}`]({name}.md) | {_summary(package)} |\n" for name, package in packages.items())
    pages = {f"{_PAGE}/{name}.md": _package_page(package) for name, package in packages.items()}
    pages["reference/ros-packages/index.md"] = _INDEX + rows
    pages[f"{_PAGE}/rclpy.md"] += _ABSENT + "".join(f"| {names} | {text} |\n" for names, text in _absent_rows())
    return pages


def _names() -> list[str]:
    """Return the packages with code of their own, without those of messages."""
    return sorted(file.parent.name for file in _FOLDER.glob("*/__init__.py") if not _MESSAGES.search(file.parent.name))


def _package_page(package: griffe.Module) -> str:
    head = f"# {package.name}\n\n{_summary(package)}\n"
    sections = [_section(module) for module in _modules(package)]
    return head + "".join(section for section in sections if section)


def _modules(package: griffe.Module) -> Iterator[griffe.Module]:
    yield package
    for _, module in sorted(package.modules.items()):
        if not module.is_alias and not module.name.startswith("_"):  # a package that imports itself has an alias
            yield from _modules(module)


def _section(module: griffe.Module) -> str:
    rows = [_row(name, member) for name, member in sorted(module.members.items()) if _is_listed(module, member)]
    return f"\n## {module.path}\n\n| name | kind | what it is |\n|---|---|---|\n" + "".join(rows) if rows else ""


def _is_listed(module: griffe.Module, member: griffe.Object | griffe.Alias) -> bool:
    if member.name.startswith("_"):
        return False
    if member.is_alias:
        # A name from a private module of the package, or one that the package names in __all__.
        package = module.path.partition(".")[0]
        exported = member.name in (module.exports or ())
        is_own = member.target_path.startswith(f"{package}.") and (exported or f"{package}._" in member.target_path)
        return is_own and _is_known(member)
    return not member.is_module and (not member.is_attribute or member.name.isupper() or member.has_docstring)


def _is_known(alias: griffe.Alias) -> bool:
    """Return whether a name is defined in a package that was loaded: those of messages are not."""
    try:
        return alias.final_target is not None
    except griffe.AliasResolutionError:
        return False


def _row(name: str, member: griffe.Object | griffe.Alias) -> str:
    target = member.final_target if member.is_alias else member
    summary = _summary(target)
    if target.is_class:
        methods = [each for each in target.members if not each.startswith("_")]
        if methods:
            summary += " Members: " + ", ".join(f"`{each}`" for each in methods)
    return f"| `{name}` | {target.kind.value} | {summary} |\n"


def _summary(thing: griffe.Object) -> str:
    """Return the first paragraph of the docstring as one line of a table."""
    text = thing.docstring.value.split("\n\n")[0] if thing.docstring else ""
    return " ".join(text.split()).replace("|", r"\|").replace("``", "`")


def _absent_rows() -> Iterator[tuple[str, str]]:
    reasons: dict[str, list[str]] = {}
    for name, reason in ABSENT.items():
        reasons.setdefault(reason, []).append(f"`{name}`")
    for owner, (attributes, reason) in ABSENT_ATTRIBUTES.items():
        reasons.setdefault(reason, []).extend(f"`{owner}.{attribute}`" for attribute in sorted(attributes))
    for reason, names in reasons.items():
        yield ", ".join(names), reason
