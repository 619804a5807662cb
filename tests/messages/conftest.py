# SPDX-License-Identifier: Apache-2.0
"""Fixtures that build random messages of any type, and the same messages in the classes of rosbags."""

import random
import re
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from coframe.messages import find
from coframe.messages.definition import (
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

INTERFACES = Path(__file__).resolve().parents[2] / "interfaces"
TEXTS = ["", "a", "map", "base_link", "wörld", "机器人", "🤖" * 3, "x" * 70]
# The messages that belong to services and actions, as the ROS 2 design describes them.
PARTS = {"msg": ("",), "srv": ("_Request", "_Response"), "action": ("_Goal", "_Result", "_Feedback")}
PROTOCOL = {
    "_SendGoal_Request": "unique_identifier_msgs/UUID goal_id\n{name}_Goal goal",
    "_SendGoal_Response": "bool accepted\nbuiltin_interfaces/Time stamp",
    "_GetResult_Request": "unique_identifier_msgs/UUID goal_id",
    "_GetResult_Response": "int8 status\n{name}_Result result",
    "_FeedbackMessage": "unique_identifier_msgs/UUID goal_id\n{name}_Feedback feedback",
}


def message_texts() -> dict[str, str]:
    """Return the definition of every message in `interfaces/`, of those of services and actions too."""
    texts = {}
    for path in sorted(INTERFACES.glob("*/*/*.*")):
        package, kind = path.parts[-3:-1]
        name = f"{package}/{kind}/{path.stem}"
        # rosbags expects the package in front of types that the file of a service or action uses.
        text = re.sub(r"(?m)^([A-Z]\w*(\[.*\])? )", rf"{package}/\1", path.read_text("utf-8"))
        parts = re.split(r"(?m)^---$", text)
        texts |= {f"{name}{part}": text for part, text in zip(PARTS[kind], parts, strict=True)}
        if kind == "action":
            texts |= {f"{name}{part}": text.format(name=name) for part, text in PROTOCOL.items()}
    return texts


# rosbags does not know wstring; the tests of the codec compare its bytes with recorded ones.
MESSAGE_TEXTS = {name: text for name, text in message_texts().items() if not text.startswith("wstring")}


def random_value(type_: Any, rng: random.Random) -> Any:
    if isinstance(type_, AbstractNestedType):
        most = 3 if not isinstance(type_, BoundedSequence) else type_.maximum_size
        count = type_.size if isinstance(type_, Array) else rng.randint(0, most)
        return [random_value(type_.value_type, rng) for _ in range(count)]
    if isinstance(type_, NamespacedType):
        return build(find("/".join(type_.namespaced_name())), rng)
    if not isinstance(type_, BasicType):
        return rng.choice(TEXTS)[: getattr(type_, "maximum_size", None)]
    return random_basic(type_.typename, rng)


def random_basic(typename: str, rng: random.Random) -> Any:
    if typename == "boolean":
        return rng.random() < 0.5
    if typename == "octet":
        return bytes([rng.randrange(256)])
    if typename in {"float", "double"}:
        value = rng.choice([0.0, -0.0, float("inf"), rng.uniform(-1e9, 1e9), rng.gauss(0.0, 1.0)])
        return struct.unpack("<f", struct.pack("<f", value))[0] if typename == "float" else value
    bits = int(typename.partition("int")[2])
    low = 0 if typename.startswith("u") else -(2 ** (bits - 1))
    return rng.choice([low, low + 2**bits - 1, rng.randrange(low, low + 2**bits)])


def build(cls: Any, rng: random.Random) -> Any:
    return cls(
        **{slot[1:]: random_value(type_, rng) for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)}
    )


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Run every test with the argument `ros_type` for every message type."""
    if "ros_type" in metafunc.fixturenames:
        metafunc.parametrize("ros_type", sorted(MESSAGE_TEXTS))


@pytest.fixture(scope="session")
def random_message() -> Callable[[Any, random.Random], Any]:
    """Return a function that builds a message with random values in all fields."""
    return build


@pytest.fixture(scope="session")
def store() -> Any:
    """Return rosbags' types of the default distribution, Jazzy, and those that it reads from our definitions."""
    store = get_typestore(Stores.ROS2_JAZZY)
    types: dict[str, Any] = {}
    for name, text in MESSAGE_TEXTS.items():
        if name not in store.fielddefs:
            (types[name],) = get_types_from_msg(text, name).values()
    store.register(types)
    return store


@pytest.fixture
def to_rosbags(store: Any) -> Callable[[Any], Any]:
    def value(ours: Any, type_: Any) -> Any:
        if isinstance(type_, NamespacedType):
            return message(ours)
        if isinstance(type_, BasicType):
            return int.from_bytes(ours, "big", signed=True) if type_.typename == "octet" else ours
        if not isinstance(type_, AbstractNestedType):
            return ours
        if isinstance(type_.value_type, BasicType):
            dtypes = {"boolean": "bool", "octet": "uint8", "float": "float32", "double": "float64"}
            dtype = dtypes.get(type_.value_type.typename, type_.value_type.typename)
            octets = type_.value_type.typename == "octet"
            return np.array([item[0] if octets else item for item in ours], dtype)
        return [value(item, type_.value_type) for item in ours]

    def message(ours: Any) -> Any:
        fields = {
            slot[1:]: value(getattr(ours, slot), type_)
            for slot, type_ in zip(ours.__slots__, ours.SLOT_TYPES, strict=True)
        }
        return store.types[ours.ROS_TYPE](**fields or {"structure_needs_at_least_one_member": 0})

    return message
