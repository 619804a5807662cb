# SPDX-License-Identifier: Apache-2.0
"""Read and write configuration files of RViz 2 and RViz 1, preserving unknown parts."""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.regular_files import read_regular_text, reading_hint
from coframe.errors import ViewerError
from coframe.viewer.displays.rows import DISPLAYS
from coframe.viewer.protocol.server_messages import RvizConfiguration, RvizGlobalOptions, UnknownRvizPart
from coframe.viewer.rviz._reading import MAX_FILE_BYTES, read_yaml, yaml_module
from coframe.viewer.rviz._tools import merge_tools, read_tools
from coframe.viewer.rviz._values import OWN_KEYS, is_number, plain, plain_class, set_topic, topic_of, update

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from coframe.viewer.protocol.common import RvizDisplay, RvizTool, RvizView

__all__ = ["RvizConfig"]

VIEW_CLASSES = frozenset({"FPS", "FrameAligned", "Orbit", "ThirdPersonFollower", "TopDownOrtho", "XYOrbit"})

_MANAGER = "Visualization Manager"
_NEW_CONFIGURATION: dict[str, Any] = {
    "Panels": [{"Class": "rviz_common/Displays", "Name": "Displays"}, {"Class": "rviz_common/Views", "Name": "Views"}],
    _MANAGER: {
        "Class": "",
        "Displays": [],
        "Enabled": True,
        "Global Options": {},
        "Name": "root",
        "Tools": [{"Class": f"rviz_default_plugins/{name}"} for name in ("MoveCamera", "Select", "FocusCamera")],
        "Views": {"Current": {}},
    },
}


class _Found(NamedTuple):
    """A display of a file, with the list that contains it."""

    path: str
    siblings: list[Any]
    display: dict[str, Any]

    @property
    def plain_class(self) -> str:
        return plain_class(self.display.get("Class"))

    @property
    def name(self) -> str:
        return str(self.display.get("Name") or self.plain_class)


class RvizConfig:
    """A configuration, with the parts that the page supports and all others.

    Args:
        document: The content of the YAML file, or None for an empty configuration.
    """

    def __init__(self, document: dict[str, Any] | None = None) -> None:
        self._document = copy.deepcopy(_NEW_CONFIGURATION) if document is None else document

    @classmethod
    def parse(cls, text: str, source: str = "the file") -> RvizConfig:
        """Parse the text of a configuration file.

        Args:
            text: The YAML text of a configuration file.
            source: The name of the file, for error messages.

        Raises:
            ViewerError: The text is not YAML or not a configuration of RViz, or PyYAML is missing.
        """
        document = read_yaml(text, source)
        if not isinstance(document, dict) or not isinstance(document.get(_MANAGER), dict):
            raise ViewerError(
                f"{source} is not an RViz configuration: it has no {_MANAGER!r}",
                hint="Save one in RViz with File > Save Config As.",
            )
        return cls(document)

    @classmethod
    def load(cls, file: Path) -> RvizConfig:
        """Read a configuration file.

        Raises:
            ViewerError: The file cannot be read or is not a configuration of RViz, or PyYAML is missing.
        """
        try:
            text = read_regular_text(file, MAX_FILE_BYTES)
        except OSError as error:
            reason = error.strerror or type(error).__name__
            raise ViewerError(f"{file} cannot be read: {reason}", hint=reading_hint(error)) from None
        except UnicodeDecodeError:
            raise ViewerError(f"{file} is not a text file", hint="Is it an .rviz file?") from None
        return cls.parse(text, str(file))

    @property
    def fixed_frame(self) -> str:
        """The fixed frame, or "" if the file does not contain one."""
        value = self._global.get("Fixed Frame")
        return value if isinstance(value, str) and value != "<Fixed Frame>" else ""

    @property
    def frame_rate(self) -> float | None:
        """Frames per second, or None if the file contains no valid rate."""
        value = self._global.get("Frame Rate")
        return float(value) if is_number(value) and 1 <= value <= 1000 else None

    @property
    def description_topics(self) -> list[str]:
        """The topics of its robot descriptions."""
        robots = (found for found in _displays(self._manager, "") if found.plain_class == "RobotModel")
        return [topic for robot in robots if (topic := topic_of(robot.display)) is not None]

    def description(self) -> RvizConfiguration:
        """Return the supported parts, and a list of the unsupported ones."""
        known: list[RvizDisplay] = []
        unknown: list[UnknownRvizPart] = []
        for found in _displays(self._manager, ""):
            if found.plain_class in DISPLAYS:
                options = {str(key): plain(value) for key, value in found.display.items() if key not in OWN_KEYS}
                enabled = found.display.get("Enabled", True) is not False
                known.append(
                    {
                        "class": found.plain_class,
                        "name": found.name,
                        "enabled": enabled,
                        "topic": topic_of(found.display),
                        "options": options,
                    }
                )
            elif found.plain_class != "Group":
                full_class = str(found.display.get("Class") or "")
                unknown.append({"path": found.path, "class": full_class, "name": found.name})
        view = self._view
        view_class = plain_class(view.get("Class"))
        if view and view_class not in VIEW_CLASSES:
            unknown.append({"path": "Views/Current", "class": str(view.get("Class") or ""), "name": view_class})
        current: RvizView | None = None
        if view:
            current = {"class": view_class, "options": plain({k: v for k, v in view.items() if k != "Class"})}
        global_options = RvizGlobalOptions(
            fixed_frame=self.fixed_frame or None,
            background=_color_of(self._global.get("Background Color")),
            frame_rate=self.frame_rate,
        )
        return RvizConfiguration(
            {
                "displays": known,
                "global": global_options,
                "view": current,
                "tools": read_tools(self._manager),
                "unknown": unknown,
            }
        )

    def with_fixed_frame(self, frame: str) -> RvizConfig:
        """Return a copy with another fixed frame."""
        manager = self._document.get(_MANAGER) or {}
        options = {**(manager.get("Global Options") or {}), "Fixed Frame": frame}
        return RvizConfig({**self._document, _MANAGER: {**manager, "Global Options": options}})

    def merged(
        self,
        displays: Sequence[RvizDisplay],
        options: Mapping[str, Any],
        view: Mapping[str, Any],
        tools: Sequence[RvizTool] = (),
    ) -> RvizConfig:
        """Return a copy updated with the contents of the page; unsupported parts are preserved.

        Args:
            displays: The displays, as in `description`.
            options: The global options, as in `description`.
            view: The view, as in `description`.
            tools: The tools that publish, as in `description`.
        """
        changed = RvizConfig(copy.deepcopy(self._document))
        changed._merge_displays(displays)
        changed._merge_global(options)
        changed._merge_view(view)
        merge_tools(changed._manager, tools, changed._package)
        return changed

    def text(self) -> str:
        """Return the text of a file.

        Raises:
            ViewerError: PyYAML is missing.
        """
        return str(yaml_module().safe_dump(self._document, sort_keys=False, allow_unicode=True, width=1000))

    @property
    def _manager(self) -> dict[str, Any]:
        manager: dict[str, Any] = self._document[_MANAGER]
        return manager

    @property
    def _global(self) -> dict[str, Any]:
        return _mapping(self._manager, "Global Options")

    @property
    def _view(self) -> dict[str, Any]:
        return _mapping(_mapping(self._manager, "Views"), "Current")

    @property
    def _package(self) -> str:
        """The package prefix of the file's classes, which differs between RViz 2 and RViz 1."""
        classes = [str(found.display.get("Class")) for found in _displays(self._manager, "")]
        return "rviz" if any(name.startswith("rviz/") for name in classes) else "rviz_default_plugins"

    def _merge_displays(self, displays: Sequence[RvizDisplay]) -> None:
        left = [found for found in _displays(self._manager, "") if found.plain_class in DISPLAYS]
        package = self._package
        new = []
        for shown in displays:
            if shown["class"] not in DISPLAYS:
                continue
            key = (shown["class"], shown["name"] or shown["class"])
            match = next((found for found in left if (found.plain_class, found.name) == key), None)
            if match is not None:
                left.remove(match)
                _merge_display(match.display, shown)
            else:
                display = {"Class": f"{package}/{key[0]}", "Name": key[1]}
                _merge_display(display, shown)
                set_topic(display, shown["topic"], package)
                new.append(display)
        for found in left:  # The user removed it from the page.
            found.siblings[:] = [one for one in found.siblings if one is not found.display]
        self._manager["Displays"] = [*_sequence(self._manager, "Displays"), *new]

    def _merge_global(self, options: Mapping[str, Any]) -> None:
        values = dict(self._global)
        if isinstance(options.get("fixed_frame"), str):
            values["Fixed Frame"] = options["fixed_frame"]
        background = options.get("background")
        if isinstance(background, list) and len(background) == 3 and all(is_number(part) for part in background):
            values["Background Color"] = "; ".join(str(min(max(int(part), 0), 255)) for part in background)
        if is_number(options.get("frame_rate")):
            values["Frame Rate"] = int(options["frame_rate"])
        self._manager["Global Options"] = values

    def _merge_view(self, view: Mapping[str, Any]) -> None:
        if not view:
            return
        current = dict(self._view)
        if isinstance(view.get("class"), str) and plain_class(current.get("Class")) != view["class"]:
            current["Class"] = f"{self._package}/{view['class']}"
        update(current, view.get("options"))
        views = dict(_mapping(self._manager, "Views"))
        views["Current"] = current
        self._manager["Views"] = views


def _displays(parent: dict[str, Any], path: str) -> Iterator[_Found]:
    """Yield all displays. The displays of a group follow the group."""
    for display in _sequence(parent, "Displays"):
        if isinstance(display, dict):
            found = _Found("", parent["Displays"], display)
            found = found._replace(path=f"{path}{found.name}")
            yield found
            if found.plain_class == "Group":
                yield from _displays(display, f"{found.path}/")


def _merge_display(display: dict[str, Any], shown: RvizDisplay) -> None:
    display["Enabled"] = shown["enabled"]
    update(display, shown["options"])


def _mapping(parent: dict[str, Any], key: str) -> dict[str, Any]:
    value = parent.get(key)
    return value if isinstance(value, dict) else {}


def _sequence(parent: dict[str, Any], key: str) -> list[Any]:
    if not isinstance(parent.get(key), list):
        return []
    value: list[Any] = parent[key]
    return value


def _color_of(value: Any) -> list[int] | None:
    """Return red, green and blue of a color such as "48; 48; 48"."""
    parts = re.fullmatch(r"\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*", str(value))
    return [min(int(part), 255) for part in parts.groups()] if parts else None
