# SPDX-License-Identifier: Apache-2.0
"""Generated message definitions are parsed as rosbags parses them, and its messages decoded with its values."""

import random
import re

import numpy as np
import pytest
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from coframe.errors import InterfaceError
from coframe.messages import definition, deserialize
from coframe.messages.schema_classes import ResolvedSchema, SchemaClasses
from coframe.messages.schemas import parse_schema

pytestmark = [pytest.mark.slow, pytest.mark.timeout(1200)]

DEFINITIONS = 10_000
DAMAGED = 10_000
MESSAGES = 3000
NUMBERS = {
    "bool": (0, 1), "byte": (0, 127), "char": (0, 127), "int8": (-128, 127), "uint8": (0, 255),
    "int16": (-(2**15), 2**15 - 1), "uint16": (0, 2**16 - 1), "int32": (-(2**31), 2**31 - 1),
    "uint32": (0, 2**32 - 1), "int64": (-(2**63), 2**63 - 1), "uint64": (0, 2**64 - 1),
}  # fmt: skip
SPECIAL = ["float32", "float64", "string", "string<=7"]
_TITLE = re.compile(r"MSG: \w+/\w+\n.*", re.DOTALL)
SEPARATOR = "=" * 80


def field_type(rng, others):
    kind = rng.choice([*NUMBERS, *SPECIAL, *others, *others])
    array = rng.choice(["", "", "", "[]", f"[{rng.randrange(1, 5)}]", f"[<={rng.randrange(1, 5)}]"])
    return kind + array


def default(rng, type_):
    """Return a default for a field of a type, or ""."""
    if rng.random() < 0.7 or "/" in type_ or "<=" in type_ or "[" in type_:
        return ""
    if type_ in {"float32", "float64"}:
        return rng.choice([" 1.5", " -2", " 1e3", " .5"])
    if type_ == "string":
        return rng.choice([' "a b"', " 'it'", ' "#x"'])
    return rng.choice([" true", " false"]) if type_ == "bool" else f" {rng.randrange(0, 128)}"


def constant(rng, number):
    type_ = rng.choice(["bool", "int8", "uint16", "int32", "uint64", "float64", "string"])
    value = {
        "bool": rng.choice(["true", "false"]),
        "string": rng.choice(['"a b"', "'x'"]),
        "float64": rng.choice(["1.5", "-2.25", "1e-3"]),
    }.get(type_, str(rng.randrange(0, 128)))
    return f"{type_} C{number}{rng.choice(['=', ' = '])}{value}"


def block(rng, others):
    lines = []
    for number in range(rng.randrange(1, 7)):
        type_ = field_type(rng, others)
        space, end = rng.choice([" ", "  ", "\t"]), rng.choice(["", "", "  # note", " "])
        lines.append(f"{type_}{space}f{number}_{rng.choice('abc')}{default(rng, type_)}{end}")
        if rng.random() < 0.2:
            lines.append(constant(rng, number))
        if rng.random() < 0.2:
            lines.append(rng.choice(["", "# a comment", "   ", "#"]))
    return "\n".join(lines) + "\n"


def text_of(rng):
    """Return a definition with up to three nested messages."""
    inner = [f"other_msgs/{name}" for name in rng.sample(["Alpha", "Beta", "Gamma"], rng.randrange(4))]
    text = block(rng, inner)
    for number, name in enumerate(inner):
        text += f"{SEPARATOR}\nMSG: {name}\n{block(rng, inner[number + 1 :])}"
    return text


def plain(type_, package):
    """Return a type of coframe as rosbags describes it; a name without a package is in that of the message."""
    if isinstance(type_, (definition.Array, definition.AbstractSequence)):
        is_array = isinstance(type_, definition.Array)
        size = type_.size if is_array else getattr(type_, "maximum_size", 0)
        return Nodetype.ARRAY if is_array else Nodetype.SEQUENCE, (plain(type_.value_type, package), size)
    if isinstance(type_, definition.NamespacedType):
        return Nodetype.NAME, "/".join((type_.namespaces[0] or package, *type_.namespaces[1:], type_.name))
    if isinstance(type_, definition.AbstractString):
        return Nodetype.BASE, ("string", getattr(type_, "maximum_size", 0))
    names = {"boolean": "bool", "float": "float32", "double": "float64"}
    return Nodetype.BASE, (names.get(type_.typename, type_.typename), 0)


def same(ours, theirs):
    """Return whether two types are equal: ROS calls a byte octet, and rosbags names char by its number."""
    octets = {"octet", "byte", "uint8", "char"}
    (kind, inside), (other, outside) = ours, theirs
    if int(kind) != int(other):
        return False
    if kind in {Nodetype.ARRAY, Nodetype.SEQUENCE}:
        return inside[1] == outside[1] and same(inside[0], outside[0])
    if kind == Nodetype.BASE:
        return inside == tuple(outside) or (inside[0] in octets and outside[0] in octets)
    return inside == outside


def value_of(constant_value):
    return constant_value[0] if isinstance(constant_value, bytes) else constant_value


def compare(text, ours, theirs):
    assert ours.keys() == theirs.keys(), text
    for name, (constants, fields) in theirs.items():
        structure = ours[name]
        found = [field for field in structure.fields if field.name != "structure_needs_at_least_one_member"]
        expected = [field for field in fields if field[0] != "structure_needs_at_least_one_member"]
        assert [field.name for field in found] == [field[0] for field in expected], text
        for field, (_, type_) in zip(found, expected, strict=True):
            assert same(plain(field.type, name.partition("/")[0]), type_), f"{field} {type_} in {text}"
        assert [(c.name, value_of(c.value)) for c in structure.constants] == [(c[0], c[2]) for c in constants], text


def test_definitions_are_parsed_equally():
    rng = random.Random(5)
    for text in dict.fromkeys(text_of(rng) for _ in range(DEFINITIONS + 500)):
        ours = parse_schema(text.encode(), "team_msgs/msg/Thing", "ros2msg").structures
        compare(text, ours, get_types_from_msg(text, "team_msgs/msg/Thing"))


def test_damaged_definitions_are_refused_or_parsed_equally():
    rng = random.Random(6)
    both = 0
    for _ in range(DAMAGED):
        # Without constants: rosbags takes those with invalid names or one quote for fields.
        text = re.sub(r"^.* C\d ?=.*\n", "", text_of(rng), flags=re.MULTILINE)
        at = rng.randrange(len(text))
        text = text[:at] + rng.choice([*"[]<#\n \"'/.1aZ", ""]) + text[at + rng.randrange(3) :]
        try:
            ours = parse_schema(text.encode(), "team_msgs/msg/Thing", "ros2msg").structures
        except InterfaceError:
            continue
        try:
            theirs = get_types_from_msg(text, "team_msgs/msg/Thing")
        except Exception:  # noqa: BLE001 - rosbags refuses more
            continue
        if not all(_TITLE.fullmatch(title) for title in text.split(f"{SEPARATOR}\n")[1:]):
            continue  # The two name a message without a package differently.
        both += 1
        compare(text, ours, theirs)
    assert both > DAMAGED / 5


def filled(rng, store, name):
    """Return a message of rosbags with random values, and the values as coframe has them."""
    values = {}
    for field, type_ in store.FIELDDEFS[name][1] if hasattr(store, "FIELDDEFS") else store.fielddefs[name][1]:
        values[field] = one_value(rng, store, type_)
    return store.types[name](**values)


def one_value(rng, store, type_):
    kind, inside = type_
    if kind == Nodetype.NAME:
        return filled(rng, store, inside)
    if kind == Nodetype.BASE:
        return one_number(rng, *inside)
    inner, size = inside
    number = size if kind == Nodetype.ARRAY else rng.randrange(size + 1 if size else 4)
    parts = [one_value(rng, store, inner) for _ in range(number)]
    is_array = inner[0] == Nodetype.BASE and inner[1][0] != "string"
    return np.array(parts, dtype=dtype(inner[1][0])) if is_array else parts


def one_number(rng, name, size):
    """Return a value of a type that is no message and no array."""
    if name == "string":
        return "".join(rng.choices("abc xyz", k=rng.randrange((size or 9) + 1)))
    if name in {"float32", "float64"}:
        return float(np.float32(rng.uniform(-1e3, 1e3)))
    return rng.random() < 0.5 if name == "bool" else rng.randint(*NUMBERS[{"octet": "byte"}.get(name, name)])


def dtype(name):
    return {"octet": "u1", "byte": "u1", "char": "u1"}.get(name, name)


def equal(ours, theirs):
    if hasattr(theirs, "__msgtype__"):
        slots = [slot[1:] for slot in ours.__slots__]
        return all(equal(getattr(ours, slot), getattr(theirs, slot)) for slot in slots if hasattr(theirs, slot))
    if isinstance(theirs, (list, np.ndarray)):
        return len(ours) == len(theirs) and all(equal(a, b) for a, b in zip(ours, theirs, strict=True))
    if isinstance(ours, bytes):
        return ours[0] == int(theirs)
    return ours == theirs


def test_messages_of_rosbags_are_decoded_with_its_values():
    rng = random.Random(7)
    for _ in range(MESSAGES):
        text = text_of(rng)
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_msg(text, "team_msgs/msg/Thing"))
        message = filled(rng, store, "team_msgs/msg/Thing")
        data = bytes(store.serialize_cdr(message, "team_msgs/msg/Thing"))
        schema = ResolvedSchema(parse_schema(text.encode(), "team_msgs/msg/Thing", "ros2msg"))
        read = deserialize(data, SchemaClasses().of(schema, is_ros1=False))
        assert equal(read, message), f"{text}\n{message}\n{read}"
