# SPDX-License-Identifier: Apache-2.0
"""`Viewer.gui`: the widgets that a program adds to the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from coframe.viewer.scripting import _arguments
from coframe.viewer.scripting._pictures import image_text, plot_text
from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.widget_handles import (
    ButtonHandle,
    CheckboxHandle,
    DropdownHandle,
    FolderHandle,
    NumberHandle,
    OpenFolders,
    PictureHandle,
    PlotHandle,
    TextFieldHandle,
    checked_options,
)
from coframe.viewer.scripting.widgets import WidgetRecord, nearest_step

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike

    from coframe.viewer.protocol.common import WidgetKind
    from coframe.viewer.scripting.widgets import WidgetStore

__all__ = ["GuiApi"]

N = TypeVar("N", int, float)
_MAX_NUMBER = 1e12


class GuiApi:
    """Adds widgets to the tab *Scene* of the page. Any thread may use it.

    Each method returns a handle: its ``value`` is the value that all pages show. ``on_update`` and ``on_click``
    register callbacks. Widgets are shown in the order in which they were added; in the ``with`` block of a folder they
    are added to the folder.

    All methods raise :class:`SceneError`, a ValueError, if an argument is invalid.

    Args:
        store: All widgets.

    Example:
        >>> import coframe
        >>> with coframe.show(coframe.Buffer(), port=0) as viewer:
        ...     with viewer.gui.add_folder("Camera"):
        ...         pitch = viewer.gui.add_slider("Pitch", min=-0.5, max=0.5, step=0.01, initial_value=0.0)
        ...
        ...     @pitch.on_update
        ...     def _(event):
        ...         print(event.target.value)
        ...
        ...     pitch.value = 0.1
        ...     pitch.value
        0.1
    """

    def __init__(self, store: WidgetStore) -> None:
        self._store = store
        self._open_folders = OpenFolders()

    def add_button(self, label: str, *, hint: str = "", disabled: bool = False, visible: bool = True) -> ButtonHandle:
        """Add a button.

        Args:
            label: The text on it.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be pressed.
            visible: Whether it is shown.
        """
        return ButtonHandle(self._store, self._add("button", label, hint, disabled, visible))

    def add_slider(
        self,
        label: str,
        min: N,  # noqa: A002 - viser's names
        max: N,  # noqa: A002
        step: N,
        initial_value: N,
        *,
        hint: str = "",
        disabled: bool = False,
        visible: bool = True,
    ) -> NumberHandle[N]:
        """Add a slider.

        Args:
            label: The text next to it.
            min: The smallest value.
            max: The largest value.
            step: The distance of two neighboring values.
            initial_value: The first value.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be moved.
            visible: Whether it is shown.
        """
        low = _arguments.number_of(min, "min", -_MAX_NUMBER, _MAX_NUMBER)
        high = _arguments.number_of(max, "max", -_MAX_NUMBER, _MAX_NUMBER)
        if high <= low:
            raise SceneError(f"max: expected a number above min, {low:g}, not {high:g}")
        return self._add_number("slider", label, initial_value, low, high, step, (min, max), hint, disabled, visible)

    def add_number(
        self,
        label: str,
        initial_value: N,
        min: N | None = None,  # noqa: A002
        max: N | None = None,  # noqa: A002
        step: N | None = None,
        *,
        hint: str = "",
        disabled: bool = False,
        visible: bool = True,
    ) -> NumberHandle[N]:
        """Add a field for a number.

        Args:
            label: The text next to it.
            initial_value: The first value.
            min: The smallest value, or None for no limit.
            max: The largest value, or None for no limit.
            step: The distance of two neighboring values, or None for any number, or 1 if all numbers are ints.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be changed.
            visible: Whether it is shown.
        """
        low = None if min is None else _arguments.number_of(min, "min", -_MAX_NUMBER, _MAX_NUMBER)
        high = None if max is None else _arguments.number_of(max, "max", -_MAX_NUMBER, _MAX_NUMBER)
        if low is not None and high is not None and high < low:
            raise SceneError(f"max: expected a number of at least min, {low:g}, not {high:g}")
        return self._add_number("number", label, initial_value, low, high, step, (min, max), hint, disabled, visible)

    def add_dropdown(
        self,
        label: str,
        options: Sequence[str],
        initial_value: str | None = None,
        *,
        hint: str = "",
        disabled: bool = False,
        visible: bool = True,
    ) -> DropdownHandle:
        """Add a drop-down.

        Args:
            label: The text next to it.
            options: The strings to choose from.
            initial_value: The first value, or None for the first option.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be changed.
            visible: Whether it is shown.
        """
        known = checked_options(options)
        value = known[0] if initial_value is None else initial_value
        if value not in known:
            raise SceneError(f"initial_value: {value!r} is not one of the options {', '.join(known)}")
        number = self._add("dropdown", label, hint, disabled, visible, value=value, options=known)
        return DropdownHandle(self._store, number)

    def add_text(
        self,
        label: str,
        initial_value: str = "",
        *,
        hint: str = "",
        disabled: bool = False,
        visible: bool = True,
    ) -> TextFieldHandle:
        """Add a text field; callbacks are called when the user leaves it or presses Enter.

        Args:
            label: The text next to it.
            initial_value: The first value.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be changed, for example to show a result.
            visible: Whether it is shown.
        """
        value = _arguments.parse_text(initial_value, "initial_value")
        return TextFieldHandle(self._store, self._add("text", label, hint, disabled, visible, value=value))

    def add_checkbox(
        self,
        label: str,
        initial_value: bool = False,
        *,
        hint: str = "",
        disabled: bool = False,
        visible: bool = True,
    ) -> CheckboxHandle:
        """Add a checkbox.

        Args:
            label: The text next to it.
            initial_value: Whether it is checked at first.
            hint: A longer description, shown as a tooltip.
            disabled: Whether it is grayed out and cannot be changed.
            visible: Whether it is shown.
        """
        value = _arguments.parse_flag(initial_value, "initial_value")
        return CheckboxHandle(self._store, self._add("checkbox", label, hint, disabled, visible, value=value))

    def add_image(self, label: str, image: ArrayLike, *, hint: str = "", visible: bool = True) -> PictureHandle:
        """Add an image; assign to ``image`` of the handle to show another one.

        Args:
            label: The text above it.
            image: Gray values (rows, columns), or colors (rows, columns, 3 or 4), as integers from 0 to 255 or floats
                from 0 to 1.
            hint: A longer description, shown as a tooltip.
            visible: Whether it is shown.
        """
        return PictureHandle(self._store, self._add("image", label, hint, False, visible, content=image_text(image)))

    def add_plot(
        self,
        label: str,
        x: ArrayLike,
        curves: Mapping[str, ArrayLike],
        *,
        x_label: str = "",
        hint: str = "",
        visible: bool = True,
    ) -> PlotHandle:
        """Add a plot; call ``update`` of the handle to show other values.

        Args:
            label: The title.
            x: The horizontal positions, shape (N,).
            curves: The values of each curve by its name, shape (N,); NaN is a gap.
            x_label: The text below the horizontal axis.
            hint: A longer description, shown as a tooltip.
            visible: Whether it is shown.
        """
        content = plot_text(x, curves, x_label)
        return PlotHandle(self._store, self._add("plot", label, hint, False, visible, content=content))

    def add_folder(self, label: str, *, expand: bool = True, visible: bool = True) -> FolderHandle:
        """Add a folder; widgets that are added in its ``with`` block are in the folder.

        Args:
            label: The title.
            expand: Whether it is open at first.
            visible: Whether it is shown.
        """
        value = _arguments.parse_flag(expand, "expand")
        return FolderHandle(
            self._store, self._add("folder", label, "", False, visible, value=value), self._open_folders
        )

    def reset(self) -> None:
        """Remove all widgets."""
        self._store.reset()

    def _add_number(
        self,
        kind: WidgetKind,
        label: str,
        initial: Any,
        low: float | None,
        high: float | None,
        step: Any,
        limits: tuple[Any, Any],
        hint: str,
        disabled: bool,
        visible: bool,
    ) -> NumberHandle[Any]:
        first = _arguments.number_of(initial, "initial_value", -_MAX_NUMBER, _MAX_NUMBER)
        is_whole = all(isinstance(one, int) for one in (initial, *limits, step) if one is not None)
        size = 1.0 if step is None and is_whole else None if step is None else _arguments.number_of(step, "step", 1e-12)
        if (low is not None and first < low) or (high is not None and first > high):
            raise SceneError(f"initial_value: {first:g} is not in the range from {low} to {high}")
        value = nearest_step(first, low, high, size)
        fields = {"lower": low, "upper": high, "step": size, "is_whole": is_whole}
        whole_value = round(value) if is_whole else value
        return NumberHandle(self._store, self._add(kind, label, hint, disabled, visible, value=whole_value, **fields))

    def _add(self, kind: WidgetKind, label: str, hint: str, disabled: bool, visible: bool, **fields: Any) -> int:
        folders = self._open_folders.ids
        record = WidgetRecord(
            id=self._store.next_id(),
            version=0,
            kind=kind,
            label=_arguments.parse_text(label, "label", _arguments.MAX_NAME),
            parent=folders[-1] if folders else None,
            hint=_arguments.parse_text(hint, "hint"),
            disabled=_arguments.parse_flag(disabled, "disabled"),
            visible=_arguments.parse_flag(visible, "visible"),
            **fields,
        )
        return self._store.add(record).id
