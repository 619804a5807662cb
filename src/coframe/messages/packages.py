# SPDX-License-Identifier: Apache-2.0
"""Interface packages whose classes are created from their definitions when they are first used."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages import archive, registry

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Exports", "InterfacePackage", "exports", "shipped", "shipped_exports"]

_SHIPPED = Path(__file__).parent / "shipped"


class InterfacePackage:
    """The definitions of one package.

    Attributes:
        name: The name of the package.
        definitions: The text of each definition, by a name such as ``msg/Pose``.
    """

    def __init__(self, name: str, definitions: dict[str, str]) -> None:
        self.name = name
        self.definitions = definitions

    def kinds(self) -> list[str]:
        """Return the kinds of definitions that the package has: some of ``msg``, ``srv`` and ``action``."""
        return list(dict.fromkeys(name.partition("/")[0] for name in self.definitions))

    def names(self, kind: str) -> list[str]:
        """Return the names of the messages, services or actions."""
        return [name.partition("/")[2] for name in self.definitions if name.startswith(f"{kind}/")]

    def create(self, kind: str, name: str) -> None:
        """Create and register the classes of a definition; do nothing if the package does not have it.

        Args:
            kind: ``msg``, ``srv`` or ``action``.
            name: The name of a definition, or of a message that belongs to it, such as ``Trigger_Request``.
        """
        from coframe.messages.class_factory import create_classes  # noqa: PLC0415 - until a class is used, not needed
        from coframe.messages.compounds import PARTS  # noqa: PLC0415
        from coframe.messages.parser import parse  # noqa: PLC0415

        main = name.partition("_")[0]
        text = self.definitions.get(f"{kind}/{main}")
        if text is not None:
            create_classes(self.name, kind, main, parse(text, self.name, PARTS[kind]))


@functools.cache
def shipped(package: str) -> InterfacePackage | None:
    """Return an interface package that coframe contains, None if coframe does not have it."""
    path = _SHIPPED / f"{package}.txt"
    if not path.is_file():
        return None
    return InterfacePackage(package, archive.unpack(path.read_text("utf-8")))


class Exports(NamedTuple):
    """What a module needs to create its classes when they are first used."""

    names: list[str]
    getattr: Callable[[str], Any]
    dir: Callable[[], list[str]]


def exports(package: InterfacePackage, kind: str) -> Exports:
    """Return ``__all__``, ``__getattr__`` and ``__dir__`` of the module with the classes of one kind."""
    names = package.names(kind)

    def get(name: str) -> Any:
        ros_type = f"{package.name}/{kind}/{name}"
        if ros_type not in registry.classes:
            package.create(kind, name)
        if ros_type not in registry.classes:
            raise AttributeError(f"module '{package.name}.{kind}' has no attribute '{name}'")
        return registry.classes[ros_type]

    return Exports(names, get, lambda: names)


def shipped_exports(package: str, kind: str) -> Exports:
    """Return the exports of a package that coframe contains."""
    found = shipped(package)
    assert found is not None, package
    return exports(found, kind)
