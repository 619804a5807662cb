# SPDX-License-Identifier: Apache-2.0
"""The definition of a display: one row, next to the function that draws its messages."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from coframe.viewer.displays._drawing import FIXED_FRAME
from coframe.viewer.protocol.client_messages import MAX_QUEUE_DEPTH, DisplayOptions
from coframe.viewer.protocol.schema import record

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe.viewer.displays._renderers import RendererFactory

__all__ = [
    "FIXED_FRAME",
    "QUALITY_OPTIONS",
    "ChoiceOption",
    "ColorOption",
    "DisplayRow",
    "FlagOption",
    "NumberOption",
    "Option",
    "TextOption",
    "value_at",
]


@dataclass(frozen=True, kw_only=True)
class _Details:
    """The properties of all options.

    Attributes:
        label: The label on the page, or "" for the key.
        needs: When the option has an effect; it is hidden otherwise. Conditions are joined by " & ": "Key" is a flag
            that is on, "!Key" one that is off, and "Key=A|B" a choice. "" means always.
        sets: The field of `DisplayOptions` that the option sets, or "" if only the page uses it.
        aliases: Keys under which other .rviz files contain the option, for example files of RViz 1.
    """

    label: str = ""
    needs: str = ""
    sets: str = ""
    aliases: tuple[str, ...] = ()


@dataclass(frozen=True)
class NumberOption(_Details):
    """A number.

    Attributes:
        key: The key in an .rviz file; nested keys are paths such as "Covariance/Value".
        value: The default.
        minimum: The smallest value; smaller ones are set to it.
        maximum: The largest value; larger ones are set to it.
        step: The difference by which the page's buttons change the value.
        unit: The unit, or "" if there is none.
    """

    key: str
    value: float
    minimum: float
    maximum: float
    step: float
    unit: str = ""

    def sent(self, value: object) -> float:
        """Return the value that the server receives for a value in an .rviz file."""
        valid = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        number = min(max(float(value), self.minimum), self.maximum) if valid else self.value  # type: ignore[arg-type]
        return round(number) if self.step.is_integer() else number


@dataclass(frozen=True)
class FlagOption(_Details):
    """A checkbox with its key in an .rviz file and its default."""

    key: str
    value: bool

    def sent(self, value: object) -> bool:
        """Return the value that the server receives for a value in an .rviz file."""
        return value if isinstance(value, bool) else self.value


@dataclass(frozen=True)
class ColorOption(_Details):
    """A color.

    Attributes:
        key: The key in an .rviz file.
        value: The default as "#rrggbb"; "" selects one that suits the background.
    """

    key: str
    value: str

    def sent(self, value: object) -> str:
        """Return the value that the server receives for a value in an .rviz file."""
        return value if isinstance(value, str) else self.value


@dataclass(frozen=True)
class ChoiceOption(_Details):
    """One of several values.

    Attributes:
        key: The key in an .rviz file.
        value: The default.
        choices: The values in an .rviz file.
        meanings: The values that the server receives for each of them; empty if they are the same.
    """

    key: str
    value: str
    choices: tuple[str, ...]
    meanings: tuple[str, ...] = ()

    def sent(self, value: object) -> str:
        """Return the value that the server receives for a value in an .rviz file."""
        index = self.choices.index(value if value in self.choices else self.value)
        return (self.meanings or self.choices)[index]


@dataclass(frozen=True)
class TextOption(_Details):
    """A string option, such as the name of a frame, with its key in an .rviz file and its default."""

    key: str
    value: str

    def sent(self, value: object) -> str:
        """Return the value that the server receives for a value in an .rviz file."""
        return value if isinstance(value, str) else self.value


def value_at(values: Mapping[str, Any], path: str) -> Any:
    """Return the value of an option in an .rviz file, or None if it is missing.

    RViz writes an option that has options of its own as a mapping, with its value as "Value".

    Args:
        values: The options of a display.
        path: The key of the option; nested keys are paths such as "Covariance/Value".
    """
    found: Any = values
    parts = path.split("/")
    for number, part in enumerate(parts):
        if not isinstance(found, dict):
            return found if parts[number:] == ["Value"] else None
        found = found.get(part)
    return found.get("Value") if isinstance(found, dict) else found


def _set_at(values: dict[str, Any], path: str, value: Any) -> None:
    """Set an option that is nested; mappings on the way to it are made, or contain the earlier value as "Value"."""
    *outer, last = path.split("/")
    for part in outer:
        inner = values.get(part)
        if not isinstance(inner, dict):
            inner = values[part] = {} if inner is None else {"Value": inner}
        values = inner
    values[last] = value


Option: TypeAlias = NumberOption | FlagOption | ColorOption | ChoiceOption | TextOption


QUALITY_OPTIONS: tuple[Option, ...] = (
    ChoiceOption(
        "Topic/Reliability Policy",
        "System Default",
        choices=("System Default", "Reliable", "Best Effort"),
        meanings=("automatic", "reliable", "best_effort"),
        label="Reliability",
        sets="reliability",
    ),
    ChoiceOption(
        "Topic/Durability Policy",
        "System Default",
        choices=("System Default", "Volatile", "Transient Local"),
        meanings=("automatic", "volatile", "transient_local"),
        label="Durability",
        sets="durability",
    ),
    NumberOption("Topic/Depth", 10.0, 1.0, float(MAX_QUEUE_DEPTH), 1.0, label="Queue depth", sets="depth"),
)
"""The quality of service of a display, which RViz writes below its topic. System Default follows the publishers."""


def _no_topics(_topic: str, _options: DisplayOptions) -> tuple[str, ...]:
    return ()


@dataclass(frozen=True, kw_only=True)
class DisplayRow:
    """A display.

    Attributes:
        name: Its class in RViz, without the package.
        messages: The message types that it shows, with how each of them is drawn; empty for displays without a topic.
        options: Its options, in the order in which the page lists them.
        shapes: The descriptions that its drawings contain, as TypedDicts; the page's types are generated from them.
        selectable: Whether it is offered for topics of its message types. Other displays come only from .rviz files.
        automatic: Whether the page shows such topics automatically, or False if that needs much bandwidth.
        rank: Its place among the displays that the page shows automatically; those with the lowest rank come first.
        max_automatic: How many topics of its types the page shows automatically at most.
        large_in_replay: Whether a replay records it last, in the remaining space.
        has_surfaces: Whether the page's tools find points on it.
        projected: Whether its lines and meshes can be drawn above images.
        other_topics: Returns the further topics that a display of a topic needs, from the topic and its options.
        has_quality: Whether RViz has options for the quality of service of its topic.
        draws_without_messages: Whether it draws before the first message of its topic.
        guide: What the display shows, for the table in the guide.
        lacks: The properties of RViz's display that it lacks, with the reason; "" if there are none.
    """

    name: str
    messages: Mapping[str, RendererFactory] = field(default_factory=dict)
    options: tuple[Option, ...] = ()
    shapes: tuple[type, ...] = ()
    selectable: bool = True
    automatic: bool = True
    rank: int = 5
    max_automatic: int = 12
    large_in_replay: bool = False
    has_surfaces: bool = True
    projected: bool = False
    other_topics: Callable[[str, DisplayOptions], tuple[str, ...]] = _no_topics
    has_quality: bool = True
    draws_without_messages: bool = False
    guide: str = ""
    lacks: str = ""

    @property
    def option_keys(self) -> frozenset[str]:
        """The keys of its options."""
        return frozenset(option.key for option in self.options)

    def with_usual_keys(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return the options of an .rviz file with the keys of RViz 2; see `aliases`."""
        result = {key: dict(part) if isinstance(part, dict) else part for key, part in values.items()}
        for option in self.options:
            for alias in option.aliases:
                if alias in result and not isinstance(result[alias], dict):
                    _set_at(result, option.key, result.pop(alias))
        return result

    def server_options(self, values: Mapping[str, Any]) -> DisplayOptions:
        """Return the options with which the page would subscribe to a topic.

        Args:
            values: The options in an .rviz file; missing and invalid ones have their defaults.
        """
        chosen = {option.sets: option.sent(value_at(values, option.key)) for option in self.options if option.sets}
        checked: DisplayOptions = record(DisplayOptions).build({**chosen, "display": self.name})
        return checked
