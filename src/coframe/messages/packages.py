# SPDX-License-Identifier: Apache-2.0
"""Interface packages whose classes are created from their definitions when they are first used.

They are the user's own packages, and those that coframe contains as data. A user's package takes precedence.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.distributions import removal
from coframe.interfaces import sources
from coframe.interfaces.definition_files import Definition, definitions_in, read
from coframe.messages import _archive, registry

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe.messages._parser import MessageStructure

__all__ = [
    "Exports",
    "InterfacePackage",
    "exports",
    "find_package",
    "find_shipped",
    "is_generated",
    "load_package",
    "shipped_exports",
]

_SHIPPED = Path(__file__).parent / "shipped"
_GENERATED = Path(__file__).parent / "generated"


class InterfacePackage:
    """The definitions of one package.

    Attributes:
        name: The name of the package.
        folder: The folder of the package, or None for a package that coframe contains.
    """

    def __init__(self, name: str, definitions: Mapping[str, Definition | Path], folder: Path | None = None) -> None:
        self.name = name
        self.folder = folder
        self._definitions = definitions

    def kinds(self) -> list[str]:
        """Return the kinds of definitions that the package has: some of ``msg``, ``srv`` and ``action``."""
        return list(dict.fromkeys(name.partition("/")[0] for name in self._definitions))

    def names(self, kind: str) -> list[str]:
        """Return the names of the messages, services or actions."""
        return [name.partition("/")[2] for name in self._definitions if name.startswith(f"{kind}/")]

    def definition(self, kind: str, name: str) -> Definition:
        """Return the definition of a message, service or action.

        Raises:
            InterfaceError: Its file cannot be read.
            KeyError: The package does not have it.
        """
        definition = self._definitions[f"{kind}/{name}"]
        return read(definition) if isinstance(definition, Path) else definition

    def parse(self, kind: str, name: str) -> list[MessageStructure]:
        """Return the structures of a message, service or action.

        Raises:
            InterfaceError: The definition is invalid.
            KeyError: The package does not have it.
        """
        from coframe.errors import InterfaceError  # noqa: PLC0415 - until a class is used, none of these is needed
        from coframe.messages._idl import parse_idl  # noqa: PLC0415
        from coframe.messages._parser import check_message_name, parse  # noqa: PLC0415
        from coframe.messages.compounds import NUMBER_OF_PARTS  # noqa: PLC0415

        definition = self.definition(kind, name)
        try:
            check_message_name(name)
        except ValueError as error:
            raise InterfaceError(str(error), file=definition.file) from None
        if definition.is_idl:
            return parse_idl(definition.text, self.name, kind, name, file=definition.file)
        return parse(definition.text, self.name, NUMBER_OF_PARTS[kind], file=definition.file)

    def create(self, kind: str, name: str) -> None:
        """Create and register the classes of a definition. Do nothing if the package does not have it.

        Args:
            kind: ``msg``, ``srv`` or ``action``.
            name: The name of a definition, or of a message that belongs to it, such as ``Trigger_Request``.

        Raises:
            InterfaceError: The definition, or one that it uses, is invalid.
        """
        from coframe.errors import InterfaceError  # noqa: PLC0415
        from coframe.messages._class_factory import FieldError, create_classes  # noqa: PLC0415

        if f"{kind}/{name}" not in self._definitions:
            name = name.partition("_")[0]
        if f"{kind}/{name}" not in self._definitions:
            return
        parts = self.parse(kind, name)
        try:
            create_classes(self.name, kind, name, parts)
        except FieldError as error:
            text, file = self.definition(kind, name)
            raise InterfaceError(
                f"field {error.field!r}: {error.problem}",
                file=file,
                line=_find_line(error.field, text),
                hint=_other_packages_hint(error.missing),
            ) from None


def _other_packages_hint(ros_type: str) -> str:
    """Return a hint about packages that contain a type with the name of a missing one, or "" if there are none."""
    _, _, name = ros_type.rpartition("/")
    found = [package for package in map(find_shipped, shipped_names()) if package and name in package.names("msg")]
    names = " or ".join(f"{package.name}/{name}" for package in found[:3])
    return f"Did you mean {names}?" if names else ""


def _find_line(field: str, text: str) -> int | None:
    word = re.compile(rf"\s{field}\b")
    return next((number for number, line in enumerate(text.splitlines(), 1) if word.search(line)), None)


_found_packages: dict[str, InterfacePackage | None] = {}


def find_package(name: str) -> InterfacePackage | None:
    """Return the user's package with a name, otherwise coframe's, or None if neither exists."""
    if name not in _found_packages:
        folder = sources.find_folder(name)
        _found_packages[name] = find_shipped(name) if folder is None else load_package(name, folder)
    return _found_packages[name]


def load_package(name: str, folder: Path) -> InterfacePackage:
    """Return the package in a folder, whose types are found by their names from now on."""
    known = _found_packages.get(name)
    if known is None or known.folder != folder:
        known = _found_packages[name] = InterfacePackage(name, definitions_in(folder), folder)
    return known


def forget() -> None:
    """Clear the cache of packages, because files or settings may have changed."""
    _found_packages.clear()
    sources.forget()


def is_generated(name: str) -> bool:
    """Return whether the classes of a package are generated, so that users' files cannot define it."""
    return (_GENERATED / name).is_dir()


@functools.cache
def find_shipped(name: str) -> InterfacePackage | None:
    """Return an interface package that coframe contains, None if coframe does not have it."""
    path = _SHIPPED / f"{name}.txt"
    if not path.is_file():
        return None
    texts = _archive.unpack(path.read_text("utf-8"))
    return InterfacePackage(name, {key: Definition(text) for key, text in texts.items()})


def shipped_other_form(ros_type: str) -> str | None:
    """Return the definition that other distributions have of a type of coframe, or None if all have the same one."""
    package, _, name = ros_type.partition("/")
    path = _SHIPPED / f"{package}.txt"
    return _archive.other_forms(path.read_text("utf-8")).get(name) if path.is_file() else None


def shipped_names() -> list[str]:
    """Return the names of all interface packages that coframe contains."""
    return sorted(path.stem for path in _SHIPPED.glob("*.txt"))


class Exports(NamedTuple):
    """The attributes that let a module create its classes on first use."""

    names: list[str]
    getattr: Callable[[str], Any]
    dir: Callable[[], list[str]]


def exports(package: InterfacePackage, kind: str) -> Exports:
    """Return ``__all__``, ``__getattr__`` and ``__dir__`` of the module with the classes of one kind."""
    names = package.names(kind)
    if package.folder is None:
        names = [name for name in names if not removal(f"{package.name}/{kind}/{name}")]

    def get(name: str) -> Any:
        ros_type = f"{package.name}/{kind}/{name}"
        if package.folder is None and (reason := removal(ros_type)):
            raise ImportError(reason)
        from coframe.messages.events import create_event_class  # noqa: PLC0415 - no class is used before

        if ros_type not in registry.classes:
            package.create(kind, name)
        if ros_type not in registry.classes and not (name.endswith("_Event") and create_event_class(ros_type)):
            raise AttributeError(f"module '{package.name}.{kind}' has no attribute '{name}'")
        return registry.classes[ros_type]

    return Exports(names, get, lambda: names)


def shipped_exports(package: str, kind: str) -> Exports:
    """Return the exports of a package that coframe contains, or of the user's package with the same name."""
    found = find_package(package)
    if found is None or kind not in found.kinds():
        found = find_shipped(package)
    assert found is not None, package
    return exports(found, kind)
