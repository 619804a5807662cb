# SPDX-License-Identifier: Apache-2.0
"""The widgets that a program has added to the page."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from coframe.viewer.protocol.server_messages import Widget
from coframe.viewer.scripting._arguments import MAX_TEXT
from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.records import Record, RecordStore

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.protocol.client_messages import UseWidget
    from coframe.viewer.protocol.common import WidgetKind
    from coframe.viewer.scripting.callbacks import CallbackThread

__all__ = ["MAX_WIDGETS", "Value", "WidgetRecord", "WidgetStore", "nearest_step"]

MAX_WIDGETS = 500
Value: TypeAlias = "float | str | bool | None"


@dataclass(frozen=True)
class WidgetRecord(Record):
    """A widget.

    Attributes:
        kind: What the widget is, such as a button or a slider.
        label: The text next to it.
        parent: The id of its folder, or None if it is in no folder.
        value: Its value, or None for buttons.
        lower: The smallest number, or None for no limit.
        upper: The largest number, or None for no limit.
        step: The distance of two neighboring numbers, or None for any number.
        is_whole: Whether the value is an int.
        options: The options of a drop-down.
        hint: A longer description.
        disabled: Whether it cannot be used.
        visible: Whether it is shown.
        content: What an image or a plot shows.
    """

    kind: WidgetKind
    label: str
    parent: int | None = None
    value: Value = None
    lower: float | None = None
    upper: float | None = None
    step: float | None = None
    is_whole: bool = False
    options: tuple[str, ...] = ()
    hint: str = ""
    disabled: bool = False
    visible: bool = True
    content: str = ""

    def message(self) -> Widget:
        """Return the message to the pages."""
        value = self.value
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        return Widget(
            type="widget",
            id=self.id,
            kind=self.kind,
            label=self.label,
            parent=self.parent,
            number=float(value) if is_number else None,  # type: ignore[arg-type]
            text=value if isinstance(value, str) else None,
            flag=value if isinstance(value, bool) else None,
            lower=self.lower,
            upper=self.upper,
            step=self.step,
            options=list(self.options),
            hint=self.hint,
            disabled=self.disabled,
            visible=self.visible,
            content=self.content,
        )


class WidgetStore(RecordStore[WidgetRecord]):
    """All widgets. Any thread may use it.

    Args:
        callbacks: The thread in which callbacks run.
    """

    def __init__(self, callbacks: CallbackThread) -> None:
        super().__init__()
        self._callbacks = callbacks
        self._callbacks_by_widget: defaultdict[int, list[Callable[[], object]]] = defaultdict(list)

    def add(self, record: WidgetRecord) -> WidgetRecord:
        """Add a widget.

        Raises:
            SceneError: There are too many widgets, or its folder was removed.
        """
        with self.lock:
            if len(self) >= MAX_WIDGETS:
                raise SceneError(f"the page has the maximum of {MAX_WIDGETS} widgets", hint="Remove other widgets.")
            if record.parent is not None and self.get(record.parent) is None:
                raise SceneError("the folder of this widget was removed")
            return self.put(record)

    def update(self, number: int, **fields: Any) -> None:
        """Change a widget.

        Raises:
            SceneError: The widget was removed.
        """
        if self.change(number, **fields) is None:
            raise SceneError("this widget was removed")

    def remove(self, number: int) -> None:
        """Remove a widget if it exists, and the contents of a folder."""
        with self.lock:
            for record in self.all():
                if record.parent == number:
                    self.remove(record.id)
            self._callbacks_by_widget.pop(number, None)
            self.drop([number])

    def reset(self) -> None:
        """Remove all widgets."""
        with self.lock:
            self._callbacks_by_widget.clear()
            self.drop(record.id for record in self.all())

    def on_use(self, number: int, callback: Callable[[], object]) -> None:
        """Call a function when a user presses a button or changes a value.

        Raises:
            SceneError: The widget was removed.
        """
        with self.lock:
            if self.get(number) is None:
                raise SceneError("this widget was removed")
            self._callbacks_by_widget[number].append(callback)

    def used(self, use: UseWidget) -> str:
        """Apply a user's input and run the callbacks, and return why it is not valid, or ""."""
        with self.lock:
            record = self.get(use.id)
            if record is None:
                return ""  # The page does not know yet that it was removed.
            value = None if record.disabled else _value_of(record, use)
            # All pages receive the value that is valid now, including the one that sent another.
            self.change(record.id, value=record.value if value is None else value)
            if record.disabled:
                return f"{record.label!r} is disabled"
            if value is None and record.kind != "button":
                return f"{record.label!r} cannot have this value"
            callbacks = list(self._callbacks_by_widget.get(record.id, ()))
        for index, callback in enumerate(callbacks):
            # Only the newest value of a slider matters, but each press of a button.
            subject = None if record.kind == "button" else (record.id, index)
            self._callbacks.submit(callback, subject)
        return ""


def nearest_step(value: float, lower: float | None, upper: float | None, step: float | None) -> float:
    """Return the nearest number between two limits that is a whole number of steps from the lower one."""
    if step is not None:
        start = 0.0 if lower is None else lower
        # Without the rounding, 0.1 steps would give 0.30000000000000004.
        value = round(start + round((value - start) / step) * step, 12)
    value = value if lower is None else max(value, lower)
    return value if upper is None else min(value, upper)


def _value_of(record: WidgetRecord, use: UseWidget) -> Value:
    """Return the new value of a widget, or None if the request is not valid for it."""
    if record.kind in {"slider", "number"}:
        if use.number is None or not math.isfinite(use.number):
            return None
        number = nearest_step(use.number, record.lower, record.upper, record.step)
        return round(number) if record.is_whole else number
    if record.kind == "dropdown":
        return use.text if use.text in record.options else None
    if record.kind == "text":
        return use.text if use.text is not None and len(use.text) <= MAX_TEXT else None
    return use.flag if record.kind == "checkbox" else None
