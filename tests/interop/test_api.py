# SPDX-License-Identifier: Apache-2.0
"""Every public name of each distribution's packages exists with a compatible signature, or is listed as absent."""

import ast
import importlib
import inspect
import json
import re
import types
import typing
import weakref
from enum import Enum
from pathlib import Path

import pytest

import rclpy

pytest.importorskip("rclpy._absent", reason="the names are those of coframe's rclpy, and a ROS is sourced")
from rclpy._absent import ABSENT, ABSENT_ATTRIBUTES

PACKAGES = ("rclpy", "tf2_py", "tf2_ros", "tf2_geometry_msgs", "sensor_msgs_py")
INTERFACES = (".msg", ".srv", ".action")
# What modules import from Python's standard library.
STANDARD = {*dir(typing), "Enum", "IntEnum", "IntFlag", "ABC", "Path", "Condition", "Lock", "RLock", "ExitStack"}
STANDARD |= {
    "contextmanager",
    "ContextManager",
    "namedtuple",
    "partial",
    "deepcopy",
    "dataclass",
    "ismethod",
    "ContextVar",
    "annotations",
    "deprecated",
}
STANDARD |= {*dir(types), *dir(weakref)}
DISTRIBUTIONS = ("humble", "jazzy", "kilted")
# Messages for tests of ROS 2 itself, which no program uses.
NOT_INSTALLED = {"test_msgs.msg"}
# What Lyrical's release notes add, by module; there is no recording of its names.
LYRICAL = {
    "rclpy.experimental": ("AsyncNode",),
    "rclpy.experimental.async_node.AsyncNode": (
        *("create_client", "create_publisher", "create_service", "create_subscription", "create_timer"),
        *("get_clock", "run", "wait_for_node"),
    ),
    "rclpy.node.Node": (
        *("get_action_client_names_and_types_by_node", "get_action_names_and_types"),
        *("get_action_server_names_and_types_by_node", "get_clients_info_by_service", "get_servers_info_by_service"),
    ),
    "rclpy.service_endpoint_info": ("ServiceEndpointInfo", "ServiceEndpointTypeEnum"),
    "message_filters": ("Chain", "ComparisonFilter", "DeltaFilter", "InputAligner", "PathDeltaFilter", "TimeSequencer"),
    "message_filters.delta_filter": ("DeltaFilter",),
    "message_filters.input_aligner": ("InputAligner",),
    "message_filters.simple_filter": ("SimpleFilter",),
    "rosbag2_py": ("Player", "PlayOptions", "Recorder", "RecordOptions", "bag_rewrite"),
    "rosbag2_py.Player": (
        *("get_playback_duration", "get_starting_time", "is_paused", "pause", "play", "play_next", "resume", "seek"),
        *("start_spin", "stop", "stop_spin", "wait_for_playback_to_finish", "wait_for_playback_to_start"),
    ),
    "rosbag2_py.Recorder": ("is_paused", "pause", "record", "resume", "start_spin", "stop", "stop_spin"),
    "launch.actions": (
        *("DeclareBooleanLaunchArgument", "ForEach", "ForLoop", "Log", "LogDebug", "LogError", "LogInfo", "LogWarning"),
        "ReplaceEnvironmentVariables",
    ),
    "launch.substitutions": ("PathSubstitution", "StringJoinSubstitution"),
    "tf2_ros": ("StaticTransformListener",),
    "nav_msgs.msg": ("Goals", "Trajectory", "TrajectoryPoint"),
    "rosgraph_msgs.msg": ("Graph",),
}
# Classes whose objects methods of a node create; their constructors take the parts of an implementation.
CREATED_BY_NODES = {"Client", "Publisher", "Service", "Subscription"}
MIGRATION = Path(__file__).parents[2] / "docs" / "how-to" / "coming-from-tf2.md"


@pytest.fixture(scope="module", params=DISTRIBUTIONS)
def api(shared, request) -> dict[str, dict]:
    """Return the names of the modules of a distribution, with the attributes of classes and the signatures."""
    recorded = json.loads((shared / "interop" / f"api_{request.param}.json").read_text(encoding="utf-8"))
    return {
        module: names
        for module, names in recorded.items()
        if isinstance(names, dict)
        and module not in NOT_INSTALLED
        and (module.split(".")[0] in PACKAGES or module.endswith(INTERFACES))
    }


def test_every_module_exists(api):
    for module in api:
        importlib.import_module(module)


def test_every_name_exists_or_is_listed_as_absent(api):
    missing = [
        f"{module}.{name}"
        for module, names in api.items()
        for name in names
        if name not in STANDARD and f"{module}.{name}" not in ABSENT and not _has(importlib.import_module(module), name)
    ]
    assert missing == []


def test_every_attribute_of_a_class_exists_or_is_listed_as_absent(api):
    missing = {}
    for module, name, thing, (attributes, _) in _things(api):
        if not attributes or not isinstance(thing, type) or thing is typing.Any:
            continue
        absent, _ = ABSENT_ATTRIBUTES.get(name, (set(), ""))
        if gone := [attribute for attribute in attributes if attribute not in absent and not _offers(thing, attribute)]:
            missing[f"{module}.{name}"] = gone
    assert missing == {}


def test_signatures_accept_what_upstream_accepts(api):
    faults = []
    for module, name, thing, (_, signature) in _things(api):
        is_ours = getattr(thing, "__module__", "").split(".")[0] in (*PACKAGES, "coframe")
        if (
            not signature
            or not is_ours
            or name in CREATED_BY_NODES
            or (isinstance(thing, type) and issubclass(thing, Enum))
        ):
            continue
        try:
            ours = inspect.signature(thing)
        except (TypeError, ValueError):
            continue
        if fault := _fault(signature, ours):
            faults.append(f"{module}.{name}{ours}: {fault}")
    assert faults == []


@pytest.mark.parametrize("owner", LYRICAL)
def test_names_that_lyrical_has_added(owner):
    module, _, name = owner.rpartition(".") if owner.rpartition(".")[2][0].isupper() else (owner, "", "")
    thing = getattr(importlib.import_module(module), name) if name else importlib.import_module(module)
    assert [each for each in LYRICAL[owner] if not _has(thing, each)] == []


def test_absent_names_say_what_to_use_instead(shared):
    files = [shared / "interop" / f"api_{name}.json" for name in DISTRIBUTIONS]
    apis = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    text = MIGRATION.read_text(encoding="utf-8")
    for name, reason in ABSENT.items():
        module, _, attribute = name.rpartition(".")
        assert any(attribute in api.get(module, {}) for api in apis), f"{name} does not exist upstream either"
        assert reason.endswith(".")
        assert re.search(r"\b(Use|Pass|Override)\b", reason), f"{name}: the sentence names no replacement"
        with pytest.raises(ImportError, match=re.escape(f"{name} does not exist in coframe. {reason}")):
            getattr(importlib.import_module(module), attribute)
        assert f"`{attribute}`" in text, f"docs/how-to/coming-from-tf2.md does not list {attribute}"


def test_handles_are_opaque():
    timer = rclpy.timer.Timer(None, rclpy.callback_groups.ReentrantCallbackGroup(), 1, rclpy.clock.Clock())
    with timer.handle as handle:
        assert handle == timer.handle
        assert isinstance(handle.pointer, int)
    with pytest.raises(AttributeError, match=r"The handle of a Timer has no attribute 'call_timer'\. coframe has no C"):
        timer.handle.call_timer()
    timer.handle.destroy_when_not_in_use()
    with pytest.raises(rclpy.handle.InvalidHandle):
        timer.reset()


def test_names_that_upstream_modules_merely_import():
    from rclpy.client import QoSProfile
    from rclpy.node import Executor, ParameterDescriptor

    assert QoSProfile is rclpy.qos.QoSProfile
    assert Executor is rclpy.executors.Executor
    assert ParameterDescriptor().name == ""
    with pytest.raises(AttributeError, match=r"module 'rclpy\.node' has no attribute 'Nothing'"):
        _ = rclpy.node.Nothing
    with pytest.raises(ImportError, match="cannot import name 'Nothing'"):
        from rclpy.node import Nothing  # noqa: F401


def _things(api):
    for module, names in api.items():
        for name, recorded in names.items():
            if name not in STANDARD and f"{module}.{name}" not in ABSENT:
                yield module, name, getattr(importlib.import_module(module), name, None), recorded


def _has(module, name: str) -> bool:
    try:
        return hasattr(module, name)
    except ImportError:
        return False


def _offers(thing: type, attribute: str) -> bool:
    if issubclass(thing, Enum) and attribute in {"name", "value"}:
        return True  # of the members, not of the class
    annotations = {name for kind in thing.__mro__ for name in vars(kind).get("__annotations__", {})}
    if hasattr(thing, attribute) or attribute in annotations:
        return True
    return inspect.isfunction(thing.__init__) and f"self.{attribute} =" in inspect.getsource(thing.__init__)


def _fault(recorded: str, ours: inspect.Signature) -> str:
    """Return which argument of the recorded signature ours does not accept, or an empty string."""
    positional, keywords = _arguments(recorded)
    kinds = [parameter.kind for parameter in ours.parameters.values()]
    if inspect.Parameter.VAR_KEYWORD in kinds and inspect.Parameter.VAR_POSITIONAL in kinds:
        return ""
    plain = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.POSITIONAL_ONLY)
    names = [parameter.name for parameter in ours.parameters.values() if parameter.kind in plain]
    if names[: len(positional)] != positional and inspect.Parameter.VAR_POSITIONAL not in kinds:
        return f"expected the positional arguments {positional}"
    unknown = [name for name in keywords if name not in ours.parameters]
    return f"expected the arguments {unknown}" if unknown and inspect.Parameter.VAR_KEYWORD not in kinds else ""


def _arguments(signature: str) -> tuple[list[str], list[str]]:
    """Return the names of the positional arguments and of those that are passed by keyword only."""
    text = re.sub(r"<[^<>]*(<[^<>]*>)?[^<>]*>", "None", signature)
    function = ast.parse(f"def f{text}: ...").body[0]
    assert isinstance(function, ast.FunctionDef)
    arguments = function.args
    return [item.arg for item in (*arguments.posonlyargs, *arguments.args)], [item.arg for item in arguments.kwonlyargs]
