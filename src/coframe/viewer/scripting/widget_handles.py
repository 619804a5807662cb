# SPDX-License-Identifier: Apache-2.0
"""Handles of widgets: assigning to a property updates all pages."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

from coframe.viewer.scripting import _arguments
from coframe.viewer.scripting._pictures import image_text, plot_text
from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.widgets import nearest_step

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import TracebackType

    from numpy.typing import ArrayLike
    from typing_extensions import Self

    from coframe.viewer.scripting.widgets import WidgetRecord, WidgetStore

__all__ = [
    "ButtonHandle",
    "CheckboxHandle",
    "DropdownHandle",
    "FolderHandle",
    "NumberHandle",
    "OpenFolders",
    "PictureHandle",
    "PlotHandle",
    "TextFieldHandle",
    "WidgetEvent",
    "WidgetHandle",
    "checked_options",
]

MAX_OPTIONS = 1000
N = TypeVar("N", int, float)
C = TypeVar("C", bound="Callable[[WidgetEvent], object]")


@dataclass(frozen=True, eq=False)
class WidgetEvent:
    """A use of a widget in a page, passed to callbacks.

    Attributes:
        target: The widget; its ``value`` is the newest one.
    """

    target: Any


class WidgetHandle:
    """A widget of the page; thread-safe.

    Args:
        store: All widgets.
        number: The id of the widget.
    """

    def __init__(self, store: WidgetStore, number: int) -> None:
        self._store = store
        self._number = number

    @property
    def label(self) -> str:
        """The text next to the widget."""
        return self._record.label

    @label.setter
    def label(self, value: str) -> None:
        self._store.update(self._number, label=_arguments.parse_text(value, "label", _arguments.MAX_NAME))

    @property
    def disabled(self) -> bool:
        """Whether the widget is shown, but cannot be used."""
        return self._record.disabled

    @disabled.setter
    def disabled(self, value: bool) -> None:
        self._store.update(self._number, disabled=_arguments.parse_flag(value, "disabled"))

    @property
    def visible(self) -> bool:
        """Whether the widget is shown."""
        return self._record.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._store.update(self._number, visible=_arguments.parse_flag(value, "visible"))

    @property
    def is_removed(self) -> bool:
        """Whether the widget was removed."""
        return self._store.get(self._number) is None

    def remove(self) -> None:
        """Remove the widget. Do nothing if it was removed before."""
        self._store.remove(self._number)

    def __repr__(self) -> str:
        record = self._store.get(self._number)
        kind = type(self).__name__
        return f"<{kind}, removed>" if record is None else f"<{kind} {record.label!r}, value {record.value!r}>"

    @property
    def _record(self) -> WidgetRecord:
        record = self._store.get(self._number)
        if record is None:
            raise SceneError("this widget was removed")
        return record

    def _on_use(self, callback: C) -> C:
        self._store.on_use(self._number, lambda: callback(WidgetEvent(self)))
        return callback


class ButtonHandle(WidgetHandle):
    """A button."""

    def on_click(self, callback: C) -> C:
        """Call a function with a :class:`WidgetEvent` when the button is pressed; usable as a decorator.

        Callbacks of one viewer run in a dedicated thread, one after another. Exceptions are logged.

        Raises:
            SceneError: The widget was removed.
        """
        return self._on_use(callback)


class _ValueHandle(WidgetHandle):
    def on_update(self, callback: C) -> C:
        """Call a function with a :class:`WidgetEvent` when a user changes the value; usable as a decorator.

        Values that the program assigns call nothing. Callbacks of one viewer run in a dedicated thread, one after
        another; a callback that is slower than its slider skips values. Exceptions are logged.

        Raises:
            SceneError: The widget was removed.
        """
        return self._on_use(callback)


class NumberHandle(_ValueHandle, Generic[N]):
    """A slider or a field for a number: an int if all its numbers are ints, otherwise a float."""

    @property
    def value(self) -> N:
        """The number. Numbers beyond the limits are set to the limit, others to the nearest step."""
        return cast("N", self._record.value)

    @value.setter
    def value(self, value: N) -> None:
        number = _arguments.number_of(value, "value")
        with self._store.lock:
            record = self._record
            number = nearest_step(number, record.lower, record.upper, record.step)
            self._store.update(self._number, value=round(number) if record.is_whole else number)


class DropdownHandle(_ValueHandle):
    """A drop-down."""

    @property
    def value(self) -> str:
        """The chosen option."""
        return cast("str", self._record.value)

    @value.setter
    def value(self, value: str) -> None:
        with self._store.lock:
            if value not in self._record.options:
                raise SceneError(f"value: {value!r} is not one of the options {', '.join(self._record.options)}")
            self._store.update(self._number, value=value)

    @property
    def options(self) -> tuple[str, ...]:
        """The options. If new ones do not contain the value, the first one becomes the value."""
        return self._record.options

    @options.setter
    def options(self, options: Sequence[str]) -> None:
        new = checked_options(options)
        with self._store.lock:
            value = self._record.value
            self._store.update(self._number, options=new, value=value if value in new else new[0])


class TextFieldHandle(_ValueHandle):
    """A text field."""

    @property
    def value(self) -> str:
        """The text."""
        return cast("str", self._record.value)

    @value.setter
    def value(self, value: str) -> None:
        self._store.update(self._number, value=_arguments.parse_text(value, "value"))


class CheckboxHandle(_ValueHandle):
    """A checkbox."""

    @property
    def value(self) -> bool:
        """Whether it is checked."""
        return cast("bool", self._record.value)

    @value.setter
    def value(self, value: bool) -> None:
        self._store.update(self._number, value=_arguments.parse_flag(value, "value"))


class PictureHandle(WidgetHandle):
    """An image of the page."""

    @property
    def image(self) -> str:
        """The image as the URL of a PNG; assign an array to show another one."""
        return self._record.content

    @image.setter
    def image(self, value: ArrayLike) -> None:
        self._store.update(self._number, content=image_text(value))


class PlotHandle(WidgetHandle):
    """A plot of the page."""

    def update(self, x: ArrayLike, curves: Mapping[str, ArrayLike], *, x_label: str = "") -> None:
        """Show other values.

        Args:
            x: The horizontal positions, shape (N,).
            curves: The values of each curve by its name, shape (N,); NaN is a gap.
            x_label: The text below the horizontal axis.
        """
        self._store.update(self._number, content=plot_text(x, curves, x_label))


class FolderHandle(WidgetHandle):
    """A folder. In its ``with`` block, this thread adds widgets to the folder; removing it removes them.

    Args:
        store: All widgets.
        number: The id of the folder.
        open_folders: The folders in whose ``with`` blocks each thread is.
    """

    def __init__(self, store: WidgetStore, number: int, open_folders: OpenFolders) -> None:
        super().__init__(store, number)
        self._open_folders = open_folders

    def __enter__(self) -> Self:
        self._open_folders.ids.append(self._number)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._open_folders.ids.pop()


class OpenFolders(threading.local):
    """The ids of the folders in whose ``with`` blocks this thread is, the innermost one last."""

    def __init__(self) -> None:
        self.ids: list[int] = []


def checked_options(options: Any) -> tuple[str, ...]:
    """Return the options of a drop-down."""
    if isinstance(options, str) or not hasattr(options, "__iter__"):
        raise SceneError(f"options: expected a list of strings, not {options!r}")
    new = tuple(_arguments.parse_text(one, "options", _arguments.MAX_NAME) for one in options)
    if not new:
        raise SceneError("options: a drop-down needs at least one option")
    if len(new) > MAX_OPTIONS:
        raise SceneError(f"options: {len(new)} options exceed the maximum of {MAX_OPTIONS}")
    return tuple(dict.fromkeys(new))
