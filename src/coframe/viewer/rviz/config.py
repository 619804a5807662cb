"""RViz's configuration files, of RViz 2 and RViz 1: read, and written such that what was not understood is kept."""

from __future__ import annotations

import copy
import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import ViewerError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import TypeGuard

__all__ = ["DISPLAY_CLASSES", "RvizConfig"]

LARGEST_FILE = 1 << 20
DEEPEST = 100
MOST_VALUES = 1 << 18

DISPLAY_CLASSES = frozenset(
    {
        "Axes",
        "Camera",
        "CameraInfo",
        "Grid",
        "Image",
        "LaserScan",
        "Map",
        "Marker",
        "MarkerArray",
        "Odometry",
        "Path",
        "PointCloud2",
        "Pose",
        "PoseArray",
        "PoseWithCovariance",
        "Range",
        "RobotModel",
        "TF",
    }
)
"""RViz's displays that the page has, by the name of their class without its package."""

VIEW_CLASSES = frozenset({"FPS", "FrameAligned", "Orbit", "ThirdPersonFollower", "TopDownOrtho", "XYOrbit"})

_MANAGER = "Visualization Manager"
_NEW: dict[str, Any] = {
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
_TOPIC_KEYS = ("Topic", "Description Topic", "Marker Topic", "Image Topic")


class _Found(NamedTuple):
    """A display of a file, in its group."""

    path: str
    siblings: list[Any]
    display: dict[str, Any]

    @property
    def plain_class(self) -> str:
        return _plain_class(self.display.get("Class"))

    @property
    def name(self) -> str:
        return str(self.display.get("Name") or self.plain_class)


class RvizConfig:
    """A configuration: what the page understands of it, and all the rest.

    Args:
        document: What the YAML holds.
    """

    def __init__(self, document: dict[str, Any] | None = None) -> None:
        self._document = copy.deepcopy(_NEW) if document is None else document

    @classmethod
    def parse(cls, text: str, source: str = "the file") -> RvizConfig:
        """From the text of a file.

        Raises:
            ViewerError: It is no YAML, or none of RViz; or PyYAML is missing.
        """
        document = _load(text, source)
        if not isinstance(document, dict) or not isinstance(document.get(_MANAGER), dict):
            raise ViewerError(
                f"{source} is no configuration of RViz: it has no {_MANAGER!r}",
                hint="RViz writes one by File, Save Config As.",
            )
        return cls(document)

    @property
    def fixed_frame(self) -> str:
        """The fixed frame; "" where there is none."""
        value = self._global.get("Fixed Frame")
        return value if isinstance(value, str) and value != "<Fixed Frame>" else ""

    @property
    def frame_rate(self) -> float | None:
        """Pictures a second; None where nothing sensible is said."""
        value = self._global.get("Frame Rate")
        return float(value) if _is_number(value) and 1 <= value <= 1000 else None

    @property
    def description_topics(self) -> list[str]:
        """Where its robots are told."""
        robots = (found for found in _displays(self._manager, "") if found.plain_class == "RobotModel")
        return [topic for robot in robots if (topic := _topic_of(robot.display)) is not None]

    def description(self) -> dict[str, Any]:
        """What the page is told: the fields of an ``rviz`` message."""
        known, unknown = [], []
        for found in _displays(self._manager, ""):
            if found.plain_class in DISPLAY_CLASSES:
                options = {str(key): _plain(value) for key, value in found.display.items() if key not in _OWN_KEYS}
                enabled = found.display.get("Enabled", True) is not False
                known.append(
                    {
                        "class": found.plain_class,
                        "name": found.name,
                        "enabled": enabled,
                        "topic": _topic_of(found.display),
                        "options": options,
                    }
                )
            elif found.plain_class != "Group":
                told = found.display.get("Class")
                unknown.append({"path": found.path, "class": str(told or ""), "name": found.name})
        view = self._view
        view_class = _plain_class(view.get("Class"))
        if view and view_class not in VIEW_CLASSES:
            unknown.append({"path": "Views/Current", "class": str(view.get("Class") or ""), "name": view_class})
        return {
            "displays": known,
            "global": {
                "fixed_frame": self.fixed_frame or None,
                "background": _colour_of(self._global.get("Background Color")),
                "frame_rate": self.frame_rate,
            },
            "view": {"class": view_class, "options": _plain({k: v for k, v in view.items() if k != "Class"})}
            if view
            else None,
            "unknown": unknown,
        }

    def merged(self, displays: list[Any], options: Mapping[str, Any], view: Mapping[str, Any]) -> RvizConfig:
        """This configuration with what the page shows now; all that the page does not understand stays.

        Args:
            displays: As in `description`.
            options: Likewise, what is global.
            view: Likewise.
        """
        changed = RvizConfig(copy.deepcopy(self._document))
        changed._merge_displays(displays)
        changed._merge_global(options)
        changed._merge_view(view)
        return changed

    def text(self) -> str:
        """The text of a file.

        Raises:
            ViewerError: PyYAML is missing.
        """
        return str(_yaml().safe_dump(self._document, sort_keys=False, allow_unicode=True, width=1000))

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
        """What the classes of this file are of: RViz 2's or RViz 1's."""
        classes = [str(found.display.get("Class")) for found in _displays(self._manager, "")]
        return "rviz" if any(name.startswith("rviz/") for name in classes) else "rviz_default_plugins"

    def _merge_displays(self, displays: list[Any]) -> None:
        left = [found for found in _displays(self._manager, "") if found.plain_class in DISPLAY_CLASSES]
        package = self._package
        new = []
        for told in displays:
            if not isinstance(told, dict) or told.get("class") not in DISPLAY_CLASSES:
                continue
            key = (told["class"], str(told.get("name") or told["class"]))
            match = next((found for found in left if (found.plain_class, found.name) == key), None)
            if match is not None:
                left.remove(match)
                _merge_display(match.display, told)
            else:
                display = {"Class": f"{package}/{key[0]}", "Name": key[1]}
                _merge_display(display, told)
                _set_topic(display, told.get("topic"), package)
                new.append(display)
        for found in left:  # the page has it no more
            found.siblings[:] = [one for one in found.siblings if one is not found.display]
        self._manager["Displays"] = [*_sequence(self._manager, "Displays"), *new]

    def _merge_global(self, options: Mapping[str, Any]) -> None:
        values = dict(self._global)
        if isinstance(options.get("fixed_frame"), str):
            values["Fixed Frame"] = options["fixed_frame"]
        background = options.get("background")
        if isinstance(background, list) and len(background) == 3 and all(_is_number(part) for part in background):
            values["Background Color"] = "; ".join(str(min(max(int(part), 0), 255)) for part in background)
        if _is_number(options.get("frame_rate")):
            values["Frame Rate"] = int(options["frame_rate"])
        self._manager["Global Options"] = values

    def _merge_view(self, view: Mapping[str, Any]) -> None:
        if not view:
            return
        current = dict(self._view)
        if isinstance(view.get("class"), str) and _plain_class(current.get("Class")) != view["class"]:
            current["Class"] = f"{self._package}/{view['class']}"
        _update(current, view.get("options"))
        views = dict(_mapping(self._manager, "Views"))
        views["Current"] = current
        self._manager["Views"] = views


_OWN_KEYS = ("Class", "Name", "Enabled")


def _displays(parent: dict[str, Any], path: str) -> Iterator[_Found]:
    """All displays, those in groups behind their group."""
    for display in _sequence(parent, "Displays"):
        if isinstance(display, dict):
            found = _Found("", parent["Displays"], display)
            found = found._replace(path=f"{path}{found.name}")
            yield found
            if found.plain_class == "Group":
                yield from _displays(display, f"{found.path}/")


def _merge_display(display: dict[str, Any], told: Mapping[str, Any]) -> None:
    display["Enabled"] = told.get("enabled") is not False
    _update(display, told.get("options"))


def _mapping(parent: dict[str, Any], key: str) -> dict[str, Any]:
    value = parent.get(key)
    return value if isinstance(value, dict) else {}


def _sequence(parent: dict[str, Any], key: str) -> list[Any]:
    if not isinstance(parent.get(key), list):
        return []
    value: list[Any] = parent[key]
    return value


def _plain_class(name: Any) -> str:
    """Without the package: rviz_default_plugins/TF and rviz/TF are TF."""
    return str(name or "").rpartition("/")[2]


def _topic_of(display: Mapping[str, Any]) -> str | None:
    for key in _TOPIC_KEYS:
        value = display.get(key)
        value = value.get("Value") if isinstance(value, dict) else value
        if isinstance(value, str) and value:
            return value
    return None


def _set_topic(display: dict[str, Any], topic: Any, package: str) -> None:
    if not isinstance(topic, str) or not topic or _topic_of(display) is not None:
        return
    if package == "rviz":
        display["Topic"] = topic
        return
    qos = {"Depth": 5, "Durability Policy": "Volatile", "History Policy": "Keep Last"}
    display["Topic"] = {**qos, "Reliability Policy": "Reliable", "Value": topic}


def _colour_of(value: Any) -> list[int] | None:
    """RViz 2 and 1 write "48; 48; 48"."""
    parts = re.fullmatch(r"\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*[;,]\s*(\d{1,3})\s*", str(value))
    return [min(int(part), 255) for part in parts.groups()] if parts else None


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _plain(value: Any) -> Any:
    """As JSON can say it."""
    if isinstance(value, dict):
        return {str(key): _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple | set):
        return [_plain(part) for part in value]
    if value is None or isinstance(value, bool | str | int) or _is_number(value):
        return value
    return str(value)


def _update(target: dict[str, Any], options: Any) -> None:
    """Takes over what is told; what is not told stays."""
    if not isinstance(options, dict):
        return
    for key, value in options.items():
        if key in _OWN_KEYS:
            continue
        if isinstance(value, dict) and isinstance(target.get(key), dict):
            _update(target[key], value)
        else:
            target[key] = value


def _yaml() -> Any:
    try:
        import yaml  # noqa: PLC0415 - only who reads RViz's files needs it
    except ModuleNotFoundError:
        raise ViewerError("RViz's files need the package PyYAML: pip install 'coframe[viewer]'") from None
    return yaml


def _load(text: str, source: str) -> Any:
    if len(text) > LARGEST_FILE:
        raise ViewerError(f"{source} has more than the {LARGEST_FILE >> 20} MiB that a configuration of RViz may have")
    yaml = _yaml()

    class Loader(yaml.SafeLoader):  # type: ignore[misc,name-defined]
        def fetch_flow_collection_start(self, token: Any) -> None:
            """The more brackets are open, the longer each takes."""
            check_depth(self.flow_level)
            super().fetch_flow_collection_start(token)

        def add_indent(self, column: int) -> Any:
            """Likewise."""
            check_depth(len(self.indents))
            return super().add_indent(column)

    def check_depth(depth: int) -> None:
        if depth > DEEPEST:
            raise yaml.YAMLError("it is nested too deeply")

    def check_measure(size: int, depth: int) -> None:
        check_depth(depth)
        if size > MOST_VALUES:
            raise yaml.YAMLError(f"with its aliases (*) written out it has more than {MOST_VALUES} values")

    loader = None
    try:
        loader = Loader(text)
        root = loader.get_single_node()
        check_measure(*_measure(root, {}))
        # What an alias stands for is its own from here on: a change of one display is none of another.
        return None if root is None else _written_out(loader.construct_document(root))
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        reason = " ".join(str(error).split())
        raise ViewerError(f"{source} is no YAML: {reason}", hint="Is it a .rviz file?") from None
    finally:
        if loader is not None:
            loader.dispose()


def _measure(node: Any, known: dict[int, tuple[int, int]]) -> tuple[int, int]:
    """How many values a YAML node has with its aliases written out, and how deeply they are nested.

    A few aliases of aliases make a small file endless, so that each node is looked at once only.

    Raises:
        ValueError: A node holds itself.
    """
    value = getattr(node, "value", None)
    if not isinstance(value, list):
        return 1, 1
    if id(node) in known:
        size, depth = known[id(node)]
        if not size:
            raise ValueError("an alias (*) stands for what it is in")
        return size, depth
    known[id(node)] = (0, 0)  # being measured
    parts = [part for child in value for part in (child if isinstance(child, tuple) else (child,))]
    measured = [_measure(part, known) for part in parts]
    known[id(node)] = 1 + sum(size for size, _ in measured), 1 + max((depth for _, depth in measured), default=0)
    return known[id(node)]


def _written_out(value: Any) -> Any:
    """A copy in which nothing is there twice."""
    if isinstance(value, dict):
        return {key: _written_out(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_written_out(part) for part in value]
    return value
