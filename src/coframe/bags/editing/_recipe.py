# SPDX-License-Identifier: Apache-2.0
"""Recipes: lists of rules that are applied to recordings, as YAML files and in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from coframe._files.bounded_yaml import read_yaml
from coframe._files.complete_files import write_complete
from coframe._files.os_errors import reason
from coframe._files.regular_files import UnsuitableFileError, read_regular
from coframe._output.formatting import did_you_mean
from coframe._process.optional_imports import pip_install
from coframe.bags._writer import yaml_dump
from coframe.bags.editing.rules.clock import Clock
from coframe.bags.editing.rules.dedupe import Dedupe
from coframe.bags.editing.rules.drop_invalid import DropInvalid
from coframe.bags.editing.rules.drop_publisher import DropPublisher
from coframe.bags.editing.rules.drop_topic import DropTopic
from coframe.bags.editing.rules.prefix import Prefix
from coframe.bags.editing.rules.rate import Rate
from coframe.bags.editing.rules.rename_frame import RenameFrame
from coframe.bags.editing.rules.rename_topic import RenameTopic
from coframe.bags.editing.rules.replace_mount import ReplaceMount
from coframe.bags.editing.rules.set_static import SetStatic
from coframe.bags.editing.rules.shift import Shift
from coframe.bags.editing.rules.shift_log import ShiftLog
from coframe.bags.editing.rules.static_first import StaticFirst
from coframe.bags.editing.rules.strip_slashes import StripSlashes
from coframe.bags.editing.rules.time_range import TimeRange
from coframe.errors import EditError, RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Iterator

    from typing_extensions import Self

    from coframe.bags.editing._rule import Rule

__all__ = ["RULES", "Recipe"]

RULES: Final[dict[str, type[Rule]]] = {
    rule.name: rule
    for rule in (
        RenameFrame,
        Prefix,
        StripSlashes,
        RenameTopic,
        DropTopic,
        Shift,
        ShiftLog,
        Clock,
        SetStatic,
        ReplaceMount,
        StaticFirst,
        DropPublisher,
        DropInvalid,
        Dedupe,
        TimeRange,
        Rate,
    )
}
"""The rules by their names."""

_MAX_BYTES = 1 << 20
_MAX_RULES = 1000
_RULES_KEY = "edit"  # of the list in a recipe
_HEADING = "# Recipe for `coframe bag edit BAG --recipe FILE -o OUT`.\n"


class Recipe:
    """Rules in the order in which they are applied. Each rule is a name and a value, as on the command line.

    Args:
        rules: Pairs of a name and a value, such as ``("rename-frame", "Lidar=lidar")``, or both in one string.

    Raises:
        EditError: There is no such rule, or its value cannot be understood.

    Example:
        >>> recipe = Recipe([("rename-frame", "Lidar=lidar"), "shift /points=+35ms"])
        >>> [str(each) for each in recipe]
        ['rename-frame Lidar=lidar', 'shift /points=+35ms']
    """

    def __init__(self, rules: Iterable[str | tuple[str, str]] = ()) -> None:
        self._values: list[tuple[str, str]] = []
        for rule in rules:
            name, _, value = rule.partition(" ") if isinstance(rule, str) else (rule[0], "", rule[1])
            self.add(name, value)

    def add(self, name: str, value: str = "") -> Self:
        """Add a rule at the end, and return the recipe.

        Args:
            name: The name, such as "rename-frame".
            value: The value, such as "Lidar=lidar", or "" for rules without one.

        Raises:
            EditError: There is no such rule, or its value cannot be understood.
        """
        if len(self._values) >= _MAX_RULES:
            raise EditError(f"a recipe has at most {_MAX_RULES} rules")
        _rule(name, value)
        self._values.append((name, value.strip()))
        return self

    def rules(self) -> list[Rule]:
        """Return new rules, which count what they change."""
        return [_rule(name, value) for name, value in self._values]

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read a recipe from a YAML file.

        Raises:
            RecordingError: The file cannot be read.
            EditError: It is not a recipe.
        """
        try:
            content = read_yaml(read_regular(path, _MAX_BYTES), _MAX_BYTES)
        except ModuleNotFoundError:
            raise RecordingError(
                "recipes need the package PyYAML, which is not installed", hint=pip_install("bags")
            ) from None
        except (OSError, UnsuitableFileError) as error:
            raise RecordingError(f"{path} cannot be read: {reason(error)}") from None
        except ValueError as error:
            raise EditError(f"{path} is not valid YAML: {' '.join(str(error).split())[:200]}") from None
        return cls(_entries(path, content))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the recipe to a YAML file.

        Raises:
            RecordingError: The file cannot be written.
        """
        try:
            write_complete(path, str(self).encode())
        except OSError as error:
            raise RecordingError(f"{path} cannot be written: {reason(error)}") from None

    def __str__(self) -> str:
        """Return the recipe as YAML."""
        return _HEADING + yaml_dump()({_RULES_KEY: [{name: value} if value else name for name, value in self._values]})

    def __iter__(self) -> Iterator[Rule]:
        return iter(self.rules())

    def __len__(self) -> int:
        return len(self._values)


def _rule(name: str, value: str) -> Rule:
    if name not in RULES:
        raise EditError(f"No rule named {name[:60]!r}. Rules: {', '.join(RULES)}.", hint=did_you_mean(name, RULES))
    if not RULES[name].form and value.strip():
        raise EditError(f"{name} has no value, but {value[:60]!r} is given")
    try:
        return RULES[name](value.strip())
    except EditError as error:
        raise EditError(f"{name}: {error}", hint=error.hint) from None


def _entries(path: str | os.PathLike[str], content: Any) -> Iterator[tuple[str, str]]:
    """Yield names and values: ``- rename-frame: a=b``, ``- rename-frame: [a=b, c=d]`` or ``- dedupe``."""
    entries = content.get(_RULES_KEY) if isinstance(content, dict) else None
    if not isinstance(entries, list):
        raise EditError(
            f"{path} is not a recipe: it has no list with the key {_RULES_KEY!r}",
            hint="Write `edit:` and below it one line for each rule, such as `- rename-frame: Lidar=lidar`.",
        )
    for entry in entries:
        pairs = entry if isinstance(entry, dict) else {entry: ""}
        for name, values in pairs.items():
            for value in values if isinstance(values, list) else [values]:
                yield str(name), "" if value is None else str(value)
