# SPDX-License-Identifier: Apache-2.0
"""Read one column from the messages on a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._output.formatting import did_you_mean, join_names
from coframe.bags.tables import _leaves
from coframe.bags.tables._leaves import MAX_LEAVES, Leaf, MissingElementError, at_path
from coframe.bags.tables.columns import Key
from coframe.errors import RecordingError
from coframe.messages.definition import AbstractNestedType, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.bags.tables.columns import FieldSource

__all__ = ["FieldReader"]

_MAX_LISTED_NAMES = 12


class FieldReader:
    """Reads the values of one column from messages of one type.

    Attributes:
        leaves: The values.
        name_lists: The fields that name the elements which become values of their own, below the base of the column.

    Args:
        label: The name of the column, for error messages.
        source: The field.
        sample: A message. If it is not one of ROS, its values determine the fields.
        names: The names of elements, by the field in ``name_lists``.

    Raises:
        RecordingError: The field does not exist, or the type of the messages is unknown.
    """

    def __init__(
        self, label: str, source: FieldSource, sample: Any, names: dict[tuple[str, ...], list[str]] | None = None
    ) -> None:
        self._label = label
        self._topic, self._base = source.topic, source.path
        if isinstance(sample, bytes):
            raise RecordingError(f"{label}: the definition of the messages on {source.topic} is unknown")
        is_ros = hasattr(type(sample), "SLOT_TYPES")
        self.name_lists: list[tuple[str, ...]] = []
        found = list(self._class_leaves(type(sample), names or {}) if is_ros else self._value_leaves(sample))
        if len(found) > MAX_LEAVES:
            raise RecordingError(
                f"{label} has {len(found)} values; the limit is {MAX_LEAVES}", hint="Choose some of its fields."
            )
        self.leaves: list[Leaf] = [leaf for leaf, _ in found]
        self._read_values: Callable[[Any], tuple[Any, ...]] = _leaves.reader(
            [getter for _, getter in found], is_ros=is_ros
        )

    @property
    def has_elements(self) -> bool:
        """Whether the path contains an index or a name, which do not exist in every message."""
        return any(not isinstance(step, str) or isinstance(step, Key) for step in self._base)

    def read(self, message: Any) -> tuple[Any, ...] | None:
        """Return the values in a message, None for those that do not exist, or None if none of them exists."""
        try:
            return self._read_values(at_path(message, self._base))
        except MissingElementError:
            return None

    def element_names(self, message: Any) -> list[list[str]]:
        """Return the names of elements in a message, for each of ``name_lists``."""
        try:
            base = at_path(message, self._base)
        except MissingElementError:
            return [[] for _ in self.name_lists]
        return [list(at_path(base, path)) for path in self.name_lists]

    def names_beside(self, message: Any) -> list[str]:
        """Return the names of the elements among which the path names one, in a message."""
        place = next((number for number, step in enumerate(self._base) if isinstance(step, Key)), None)
        if place is None:
            return []
        try:
            owner = at_path(message, self._base[: place - 1])
            return list(getattr(owner, _leaves.names_beside(_leaves.class_fields(type(owner)))))
        except (MissingElementError, AttributeError):
            return []

    def _class_leaves(self, cls: Any, names: dict[tuple[str, ...], list[str]]) -> _leaves.Found:
        """Yield the values below the path in a message class."""
        type_, owner, written = cls, cls, self._topic
        for step in self._base:
            if isinstance(step, int | Key):
                self._check_element(type_, owner, step, written)
                type_, written = type_.value_type, f"{written}[{step}]"
            else:
                fields = self._fields(type_, step, written)
                owner, type_, written = type_, fields[step], f"{written}.{step}"
        beside = _leaves.names_beside(_leaves.class_fields(owner))
        last = self._base[-1] if self._base else 0
        if beside and _leaves.is_named(type_) and isinstance(last, str) and not isinstance(last, Key):
            self._base = self._base[:-1]  # The names are next to the sequence, so both are read from their message.
            self.name_lists = [(beside,)]
            return _leaves.named_leaves(type_, (), (last,), (beside,), names)
        self.name_lists = list(_leaves.name_lists(type_))
        return _leaves.class_leaves(type_, (), (), names)

    def _fields(self, type_: Any, name: str, written: str) -> dict[str, Any]:
        """Return the fields of a type, which must include a name."""
        if isinstance(type_, AbstractNestedType):
            raise RecordingError(
                f"{self._label}: {written} is a sequence, which has no field {name!r}",
                hint=f"Choose an element: {written}[0].{name}.",
            )
        fields = _leaves.class_fields(type_) if isinstance(type_, NamespacedType | type) else {}
        if name not in fields:
            raise self._no_field(written, name, fields)
        return fields

    def _check_element(self, type_: Any, owner: Any, step: int | Key, written: str) -> None:
        if not isinstance(type_, AbstractNestedType):
            raise RecordingError(f"{self._label}: {written} is not a sequence, so it has no element {step}")
        if isinstance(step, Key) and not _leaves.names_beside(_leaves.class_fields(owner)):
            hint = f"Write an index: {written}[0]."
            raise RecordingError(f"{self._label}: the elements of {written} have no names", hint=hint)

    def _value_leaves(self, message: Any) -> _leaves.Found:
        """Yield the values below the path in a message that is not one of ROS."""
        value, written = message, self._topic
        for step in self._base:
            is_name = isinstance(step, str) and not isinstance(step, Key)
            if is_name and step not in (names := _leaves.value_fields(value)):
                raise self._no_field(written, str(step), names)
            written += f".{step}" if is_name else f"[{step}]"
            try:
                value = at_path(value, (step,))
            except MissingElementError:
                raise RecordingError(f"{self._label}: {written} does not exist in the first message") from None
        return _leaves.value_leaves(value)

    def _no_field(self, written: str, name: str, fields: Iterable[str]) -> RecordingError:
        known = list(fields)
        there = f"Fields: {join_names(known, limit=_MAX_LISTED_NAMES)}." if known else "It has no fields."
        return RecordingError(
            f"{self._label}: {written} has no field {name!r}", hint=f"{did_you_mean(name, known)} {there}".strip()
        )
