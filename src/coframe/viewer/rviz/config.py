# SPDX-License-Identifier: Apache-2.0
"""Read and write configuration files of RViz 2 and RViz 1, preserving unknown parts."""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.regular_files import read_regular_text, reading_hint
from coframe.errors import ViewerError
from coframe.viewer.displays.rows import DISPLAYS
from coframe.viewer.protocol.common import RvizGroup
from coframe.viewer.protocol.server_messages import (
    IgnoredRvizPart,
    RvizConfiguration,
    RvizGlobalOptions,
    SavedRvizView,
    UnknownRvizPart,
)
from coframe.viewer.rviz._ignored import ignored_options, ignored_panels, ignored_tools, ignored_view_options
from coframe.viewer.rviz._reading import MAX_FILE_BYTES, read_yaml, yaml_module
from coframe.viewer.rviz._tools import merge_tools, read_tools
from coframe.viewer.rviz._values import (
    OWN_KEYS,
    changed_values,
    is_number,
    plain_class,
    set_topic,
    to_json,
    topic_of,
    update,
    without_default_quality,
)
from coframe.viewer.sources.topic_names import resolved_topic

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path
    from typing import TypeGuard

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
    """A display of a file.

    Attributes:
        path: Its name after those of its groups.
        source: Its place in the file: the indices of its groups and its own.
        group: The place of the group that contains it, or "".
        in_enabled_groups: Whether all groups that contain it are enabled.
        siblings: The list that contains it.
        display: Its content.
    """

    path: str
    source: str
    group: str
    in_enabled_groups: bool
    siblings: list[Any]
    display: dict[str, Any]

    @property
    def is_checked(self) -> bool:
        """Whether the display itself is enabled."""
        return self.display.get("Enabled", True) is not False

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
        value = self._global_options.get("Fixed Frame")
        return value if isinstance(value, str) and value != "<Fixed Frame>" else ""

    @property
    def frame_rate(self) -> float | None:
        """Frames per second, or None if the file contains no valid rate."""
        value = self._global_options.get("Frame Rate")
        return float(value) if is_number(value) and 1 <= value <= 1000 else None

    @property
    def description_topics(self) -> list[str]:
        """The topics of its robot descriptions."""
        robots = (found for found in _displays(self._manager) if found.plain_class == "RobotModel")
        return [resolved_topic(topic) for robot in robots if (topic := topic_of(robot.display)) is not None]

    def description(self) -> RvizConfiguration:
        """Return the supported parts, and lists of the unsupported ones."""
        known: list[RvizDisplay] = []
        groups: list[RvizGroup] = []
        unknown: list[UnknownRvizPart] = []
        ignored: list[IgnoredRvizPart] = []
        for found in _displays(self._manager):
            if found.plain_class in DISPLAYS:
                described = _describe(found)
                known.append(described)
                keys = DISPLAYS[found.plain_class].option_keys
                ignored += ignored_options(found.path, found.plain_class, keys, described["options"])
            elif found.plain_class == "Group":
                groups.append(_describe_group(found))
            else:
                full_class = str(found.display.get("Class") or "")
                unknown.append({"path": found.path, "class": full_class, "name": found.name})
        view = self._view
        if view and plain_class(view.get("Class")) not in VIEW_CLASSES:
            name = plain_class(view.get("Class"))
            unknown.append({"path": "Views/Current", "class": str(view.get("Class") or ""), "name": name})
        ignored += [*ignored_view_options(view), *ignored_tools(self._manager), *ignored_panels(self._document)]
        global_options = RvizGlobalOptions(
            fixed_frame=self.fixed_frame or None,
            background=_color_of(self._global_options.get("Background Color")),
            frame_rate=self.frame_rate,
        )
        return RvizConfiguration(
            {
                "displays": known,
                "groups": groups,
                "global": global_options,
                "view": _describe_view(view) if view else None,
                "saved_views": self._saved_views(),
                "tools": read_tools(self._manager),
                "unknown": unknown,
                "ignored": ignored,
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
        groups: Sequence[RvizGroup] = (),
    ) -> RvizConfig:
        """Return a copy with what differs from `description`; everything else stays as it is written in the file.

        Args:
            displays: The displays, as in `description`; others are removed.
            options: The global options, as in `description`; missing ones are not changed.
            view: The view, as in `description`; missing options are not changed.
            tools: The tools that publish, as in `description`.
            groups: The groups, as in `description`. New ones contain displays; no group of the file is removed.
        """
        changed = RvizConfig(copy.deepcopy(self._document))
        found = [one for one in _displays(changed._manager) if one.plain_class == "Group"]  # Places before any removal.
        changed._merge_displays(displays, changed._containers(found, displays, groups))
        _merge_groups(found, groups)
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
    def _global_options(self) -> dict[str, Any]:
        return _mapping(self._manager, "Global Options")

    @property
    def _view(self) -> dict[str, Any]:
        return _mapping(_mapping(self._manager, "Views"), "Current")

    @property
    def _package(self) -> str:
        """The package prefix of the file's classes, which differs between RViz 2 and RViz 1."""
        classes = [str(found.display.get("Class")) for found in _displays(self._manager)]
        return "rviz" if any(name.startswith("rviz/") for name in classes) else "rviz_default_plugins"

    def _saved_views(self) -> list[SavedRvizView]:
        views = [view for view in _sequence(_mapping(self._manager, "Views"), "Saved") if isinstance(view, dict)]
        described = [(str(view.get("Name") or f"View {number}"), view) for number, view in enumerate(views, 1)]
        return [
            SavedRvizView(name=name, view=_describe_view(view))
            for name, view in described
            if plain_class(view.get("Class")) in VIEW_CLASSES
        ]

    def _containers(
        self, found: Sequence[_Found], displays: Sequence[RvizDisplay], groups: Sequence[RvizGroup]
    ) -> dict[str, list[Any]]:
        """Return the lists of displays of all groups by their places, "" for the top; and add the page's new groups."""
        self._manager["Displays"] = _sequence(self._manager, "Displays")
        containers: dict[str, list[Any]] = {"": self._manager["Displays"]}
        for one in found:
            containers[one.source] = one.display["Displays"] = _sequence(one.display, "Displays")
        used = {shown.get("group", "") for shown in displays}
        for group in groups:
            if group["source"] in used and group["source"] not in containers:
                package = "rviz" if self._package == "rviz" else "rviz_common"
                inside: list[Any] = []
                made = {
                    "Class": f"{package}/Group",
                    "Displays": inside,
                    "Enabled": group["enabled"],
                    "Name": group["name"],
                }
                containers.get(group["group"], containers[""]).append(made)
                containers[group["source"]] = inside
        return containers

    def _merge_displays(self, displays: Sequence[RvizDisplay], containers: Mapping[str, list[Any]]) -> None:
        remaining = [found for found in _displays(self._manager) if found.plain_class in DISPLAYS]
        by_source = {found.source: found for found in remaining}
        package = self._package
        placed: list[tuple[list[Any], dict[str, Any]]] = []
        for shown in displays:
            if shown["class"] not in DISPLAYS:
                continue
            match = _match(shown, by_source, remaining)
            if match is not None:
                remaining.remove(match)
                _merge_display(match, shown, package)
                container = containers.get(shown.get("group", match.group), match.siblings)
                if container is not match.siblings:
                    _remove(match)
                    container.append(match.display)
                placed.append((container, match.display))
            else:
                container = containers.get(shown.get("group", ""), containers[""])
                container.append(_new_display(shown, package))
                placed.append((container, container[-1]))
        for found in remaining:  # The user removed it from the page.
            _remove(found)
        for container in containers.values():
            _reorder(container, [display for inside, display in placed if inside is container])

    def _merge_global(self, options: Mapping[str, Any]) -> None:
        values = dict(self._global_options)
        fixed, background, rate = (options.get(key) for key in ("fixed_frame", "background", "frame_rate"))
        if isinstance(fixed, str) and fixed != self.fixed_frame:
            values["Fixed Frame"] = fixed
        if _is_color(background) and background != _color_of(values.get("Background Color")):
            values["Background Color"] = "; ".join(str(min(max(int(part), 0), 255)) for part in background)
        if is_number(rate) and rate != self.frame_rate:
            values["Frame Rate"] = int(rate)
        if values != self._global_options:
            self._manager["Global Options"] = values

    def _merge_view(self, view: Mapping[str, Any]) -> None:
        if not view:
            return
        current = copy.deepcopy(self._view)
        before = _describe_view(current)["options"]
        name = view.get("class")
        if isinstance(name, str) and plain_class(current.get("Class")) != name:
            current["Class"] = f"{self._package}/{name}"
            if "Value" in current:
                current["Value"] = f"{name} ({self._package})"
        update(current, changed_values(before, view.get("options")))
        if current != self._view:
            views = dict(_mapping(self._manager, "Views"))
            views["Current"] = current
            self._manager["Views"] = views


def _displays(parent: dict[str, Any], path: str = "", source: str = "", *, enabled: bool = True) -> Iterator[_Found]:
    """Yield all displays. The displays of a group follow the group."""
    for number, display in enumerate(_sequence(parent, "Displays")):
        if isinstance(display, dict):
            own = f"{source}/{number}" if source else str(number)
            found = _Found("", own, source, enabled, parent["Displays"], display)
            found = found._replace(path=f"{path}{found.name}")
            yield found
            if found.plain_class == "Group":
                yield from _displays(display, f"{found.path}/", own, enabled=enabled and found.is_checked)


def _describe(found: _Found) -> RvizDisplay:
    display = found.display
    options = {str(key): to_json(value) for key, value in display.items() if key not in OWN_KEYS}
    return {
        "class": found.plain_class,
        "name": found.name,
        "enabled": found.is_checked and found.in_enabled_groups,
        "topic": _resolve(topic_of(display)),
        "options": DISPLAYS[found.plain_class].with_usual_keys(without_default_quality(options)),
        "checked": found.is_checked,
        "source": found.source,
        "group": found.group,
    }


def _describe_group(found: _Found) -> RvizGroup:
    return RvizGroup(source=found.source, group=found.group, name=found.name, enabled=found.is_checked)


def _describe_view(view: Mapping[str, Any]) -> RvizView:
    options = to_json({key: value for key, value in view.items() if key != "Class"})
    return {"class": plain_class(view.get("Class")), "options": options}


def _merge_groups(groups: Sequence[_Found], shown: Sequence[RvizGroup]) -> None:
    """Write the names and flags of groups that the page has changed."""
    by_source = {group["source"]: group for group in shown}
    for found in groups:
        group = by_source.get(found.source)
        if group is not None and group["name"] and group["name"] != found.name:
            found.display["Name"] = group["name"]
        if group is not None and group["enabled"] != found.is_checked:
            _set_enabled(found.display, enabled=group["enabled"])


def _remove(found: _Found) -> None:
    found.siblings[:] = [one for one in found.siblings if one is not found.display]


def _reorder(container: list[Any], ordered: Sequence[dict[str, Any]]) -> None:
    """Put displays in the order of the page. Others, which the page does not show, keep their places."""
    shown = {id(display) for display in ordered}
    places = [place for place, one in enumerate(container) if id(one) in shown]
    for place, display in zip(places, ordered, strict=True):
        container[place] = display


def _match(shown: RvizDisplay, by_source: Mapping[str, _Found], remaining: Sequence[_Found]) -> _Found | None:
    """Return the display of the file that the page shows, or None for a new one."""
    found = by_source.get(shown.get("source", ""))
    if found is not None and found in remaining and found.plain_class == shown["class"]:
        return found
    key = (shown["class"], shown["name"] or shown["class"])
    return next((found for found in remaining if (found.plain_class, found.name) == key), None)


def _new_display(shown: RvizDisplay, package: str) -> dict[str, Any]:
    display: dict[str, Any] = {"Class": f"{package}/{shown['class']}", "Name": shown["name"] or shown["class"]}
    display["Enabled"] = shown.get("checked", shown["enabled"])
    if shown["topic"]:
        set_topic(display, shown["topic"], package)
    update(display, DISPLAYS[shown["class"]].with_usual_keys(_options_of(shown, package)))
    if shown["topic"]:  # Also in place of an earlier topic in the options.
        set_topic(display, shown["topic"], package)
    return display


def _options_of(shown: RvizDisplay, package: str) -> dict[str, Any]:
    """Return the options of a display; RViz 1 has no quality of service below the topic."""
    return {key: value for key, value in shown["options"].items() if package != "rviz" or key != "Topic"}


def _merge_display(found: _Found, shown: RvizDisplay, package: str) -> None:
    """Write what the page has changed of a display."""
    before, display = _describe(found), found.display
    checked = shown.get("checked", before["checked"])
    if checked == before["checked"] and shown["enabled"] not in {before["enabled"], before["checked"]}:
        checked = shown["enabled"]
    if checked != before["checked"]:
        _set_enabled(display, enabled=checked)
    if shown["name"] and shown["name"] != before["name"]:
        display["Name"] = shown["name"]
    row = DISPLAYS[found.plain_class]
    update(display, changed_values(before["options"], row.with_usual_keys(_options_of(shown, package))))
    if shown["topic"] and shown["topic"] != before["topic"]:
        set_topic(display, shown["topic"], package)


def _set_enabled(display: dict[str, Any], *, enabled: bool) -> None:
    display["Enabled"] = enabled
    if isinstance(display.get("Value"), bool):  # RViz 2 writes both.
        display["Value"] = enabled


def _resolve(topic: str | None) -> str | None:
    return None if topic is None else resolved_topic(topic)


def _mapping(parent: dict[str, Any], key: str) -> dict[str, Any]:
    value = parent.get(key)
    return value if isinstance(value, dict) else {}


def _sequence(parent: dict[str, Any], key: str) -> list[Any]:
    if not isinstance(parent.get(key), list):
        return []
    value: list[Any] = parent[key]
    return value


def _is_color(value: Any) -> TypeGuard[list[float]]:
    return isinstance(value, list) and len(value) == 3 and all(is_number(part) for part in value)


def _color_of(value: Any) -> list[int] | None:
    """Return red, green and blue of a color such as "48; 48; 48"."""
    parts = re.fullmatch(r"\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*", str(value))
    return [min(int(part), 255) for part in parts.groups()] if parts else None
