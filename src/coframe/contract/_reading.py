# SPDX-License-Identifier: Apache-2.0
"""Read a contract from YAML. Errors state the position of each mistake."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeVar, cast

from coframe._files.bounded_yaml import MAX_BYTES, error_position, read_yaml
from coframe._files.regular_files import read_regular, reading_hint
from coframe._output.formatting import did_you_mean, join_quoted
from coframe._process.optional_imports import pip_install
from coframe.contract._contract import (
    AvailabilityRequirement,
    Contract,
    IgnoredCode,
    TopicRequirement,
    TransformRequirement,
)
from coframe.contract._quantities import DEFAULT_TOLERANCE, parse_share, parse_tolerance
from coframe.doctor import Severity, codes
from coframe.errors import ContractError
from coframe.time import duration_ns

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator

    from coframe.contract._contract import Clock

__all__ = ["parse_contract", "read_contract"]

VERSION = 1
_CLOCKS = ("wall", "simulated", "any")
_SEVERITIES: dict[str, Severity | None] = {"error": Severity.ERROR, "warning": Severity.WARNING, "note": Severity.NOTE}
_SEVERITIES["never"] = None
_MAX_SHOWN = 60  # characters of a wrong value
_Value = TypeVar("_Value")


def read_contract(path: str | os.PathLike[str]) -> Contract:
    """Return the contract in a YAML file.

    Raises:
        ContractError: The file cannot be read, or is not a contract; the error names the place.
    """
    try:
        text = read_regular(path, MAX_BYTES)
    except OSError as error:
        raise ContractError(f"{path} cannot be read: {error.strerror or error}", hint=reading_hint(error)) from None
    return parse_contract(text, str(path))


def parse_contract(text: str | bytes, name: str = "the contract") -> Contract:
    """Return the contract in a YAML document.

    Args:
        text: The document.
        name: The name of the document for errors.

    Raises:
        ContractError: The document is not a contract; the error names the place.
    """
    try:
        data = read_yaml(text)
    except ModuleNotFoundError:
        raise ContractError("contracts need the package PyYAML", hint=pip_install("bags")) from None
    except ValueError as error:
        position = error_position(error)
        place = f", line {position[0] + 1}" if position else ""
        raise ContractError(f"{name}{place}: {error}") from None
    return _contract(_MappingReader(data, name, ""))


def _contract(top: _MappingReader) -> Contract:
    version = top.take("version", int, "an integer", VERSION)
    if version != VERSION:
        raise top.error("version", f"is {version}; this version of coframe reads version {VERSION}")
    tolerance = top.parsed("tolerance", parse_tolerance, None) or DEFAULT_TOLERANCE
    findings = top.mapping("findings")
    contract = Contract(
        clock=cast("Clock", top.choice("clock", _CLOCKS, "any")),
        other_frames=top.choice("other_frames", ("allowed", "forbidden"), "allowed") == "allowed",
        transforms=tuple(_transform(each, tolerance) for each in top.mappings("transforms", "parent", "child")),
        topics=tuple(_topic(each) for each in top.mappings("topics", "name")),
        availability=tuple(_availability(each) for each in top.mappings("availability", "target", "source")),
        fail_on=_SEVERITIES[findings.choice("fail_on", tuple(_SEVERITIES), "warning")],
        ignore=tuple(_read_ignored_code(each) for each in findings.mappings("ignore", "code")),
    )
    findings.require_nothing_else()
    top.require_nothing_else()
    return contract


def _transform(entry: _MappingReader, tolerance: tuple[float, float]) -> TransformRequirement:
    requirement = TransformRequirement(
        parent=entry.text("parent"),
        child=entry.text("child"),
        namespace=entry.text("namespace", ""),
        static=entry.take("static", bool, "true or false", False),
        xyz=entry.vector("xyz"),
        rpy=entry.vector("rpy"),
        tolerance=entry.parsed("tolerance", parse_tolerance, None) or tolerance,
        min_rate=entry.positive("min_rate"),
        max_gap=entry.duration("max_gap"),
    )
    entry.require_nothing_else()
    if requirement.static and (requirement.min_rate or requirement.max_gap):
        raise entry.error("static", "is true, and static transforms have no min_rate and no max_gap")
    return requirement


def _topic(entry: _MappingReader) -> TopicRequirement:
    requirement = TopicRequirement(
        name=entry.text("name"),
        type=entry.text("type", ""),
        frame=entry.text("frame", ""),
        min_rate=entry.positive("min_rate"),
        max_gap=entry.duration("max_gap"),
        reliable=entry.take("reliable", bool, "true or false", False),
        transient_local=entry.take("transient_local", bool, "true or false", False),
    )
    entry.require_nothing_else()
    return requirement


def _availability(entry: _MappingReader) -> AvailabilityRequirement:
    requirement = AvailabilityRequirement(
        target=entry.text("target"),
        source=entry.text("source"),
        at=entry.text("at"),
        namespace=entry.text("namespace", ""),
        within=entry.duration("within") or 0,
        share=entry.parsed("share", parse_share, "100%") or 0.0,
    )
    entry.require_nothing_else()
    return requirement


def _read_ignored_code(entry: _MappingReader) -> IgnoredCode:
    ignored = IgnoredCode(entry.text("code").upper(), entry.text("reason"))
    entry.require_nothing_else()
    if ignored.code not in codes():
        raise entry.error(
            "code", f"is {ignored.code!r}, which the doctor does not have; list its codes with `coframe doctor --list`"
        )
    return ignored


class _MappingReader:
    """Reads a mapping of the document key by key."""

    def __init__(self, data: Any, name: str, place: str) -> None:
        self._name, self._place = name, place
        if not isinstance(data, dict):
            raise ContractError(f"{name}: {place or 'the document'} must be a mapping of keys to values")
        self._data: dict[Any, Any] = data
        self._known_keys: list[str] = []

    def error(self, key: str, reason: str) -> ContractError:
        """Return an error about the value of a key."""
        place = f"{self._place}.{key}" if self._place else key
        return ContractError(f"{self._name}: {place} {reason}")

    def require_nothing_else(self) -> None:
        """Raise an error for the first key that was not taken."""
        for key in self._data:
            if key not in self._known_keys:
                meant = (
                    did_you_mean(str(key), self._known_keys) or f"The keys here are {join_quoted(self._known_keys)}."
                )
                raise ContractError(
                    f"{self._name}: {self._place or 'the document'} has an unknown key {key!r:.60}", hint=meant
                )

    def take(self, key: str, kind: type[_Value], description: str, default: Any) -> Any:
        """Return the value of a key, or the default if it is missing."""
        self._known_keys.append(key)
        value = self._data.get(key)
        if value is None:
            return default
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            raise self.error(key, f"must be {description}, not {value!r:.{_MAX_SHOWN}}")
        return value

    def text(self, key: str, default: str | None = None) -> str:
        """Return a string. It is required unless a default is given."""
        value: str | None = self.take(key, str, "a text", default)
        if value is None or (default is None and not value):
            raise self.error(key, "is missing")
        return value

    def choice(self, key: str, values: tuple[str, ...], default: str) -> str:
        """Return one of some words."""
        value = self.text(key, default)
        if value not in values:
            raise self.error(key, f"must be {', '.join(values[:-1])} or {values[-1]}, not {value!r:.{_MAX_SHOWN}}")
        return value

    def positive(self, key: str) -> float | None:
        """Return a number greater than 0, or None if it is missing."""
        value = self.take(key, cast("type[float]", (int, float)), "a number", None)
        if value is not None and not 0 < value < math.inf:
            raise self.error(key, f"must be greater than 0, not {value!r:.{_MAX_SHOWN}}")
        return None if value is None else float(value)

    def vector(self, key: str) -> tuple[float, float, float] | None:
        """Return three numbers, or None if they are missing."""
        values = self.take(key, list, "three numbers", None)
        if values is None:
            return None
        if len(values) != 3 or not all(_is_finite(value) for value in values):
            raise self.error(key, f"must be three numbers, not {values!r:.{_MAX_SHOWN}}")
        return float(values[0]), float(values[1]), float(values[2])

    def duration(self, key: str) -> int | None:
        """Return a duration in nanoseconds, or None if it is missing."""
        return self.parsed(key, duration_ns, None)

    def parsed(self, key: str, parse: Callable[[str], _Value], default: str | None) -> _Value | None:
        """Return the parsed string of a key, or None if it is missing and has no default."""
        text = self.take(key, str, "a text with a unit", default)
        if text is None:
            return None
        try:
            return parse(text)
        except ValueError as error:
            raise self.error(key, f"cannot be used: {error}") from None

    def mapping(self, key: str) -> _MappingReader:
        """Return a mapping; empty if it is missing."""
        return _MappingReader(self.take(key, dict, "a mapping", {}), self._name, f"{self._place}.{key}".lstrip("."))

    def mappings(self, key: str, *labels: str) -> Iterator[_MappingReader]:
        """Yield the mappings of a list. Errors name a mapping by its number and the values of some keys."""
        for number, data in enumerate(self.take(key, list, "a list", [])):
            known = [str(data.get(label))[:_MAX_SHOWN] for label in labels] if isinstance(data, dict) else []
            label = f" ({' -> '.join(known)})" if known else ""
            yield _MappingReader(data, self._name, f"{self._place}.{key}[{number}]".lstrip(".") + label)


def _is_finite(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300
