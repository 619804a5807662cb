# SPDX-License-Identifier: Apache-2.0
"""``--ros-args`` of commands that replace ROS 2's tools, such as ``coframe static``.

The names of the node and of the topics of transforms can be remapped, and commands can read parameters that are true or
false, such as use_sim_time. Other arguments are accepted because ROS 2's tools accept them, but have no effect. rclpy's
parser is not used, because a sourced ROS has no public one.
"""

from __future__ import annotations

import re
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, TypedDict

from coframe.cli.declaration import Command

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["NodeCommand", "NodeIdentity", "node_identity", "parameter_flag"]

_START, _END = "--ros-args", "--"
_FLAGS_WITH_ARGUMENT = {"-p", "--param", "--params-file", "--log-level", "--log-config-file", "-e", "--enclave"}
_SWITCH = re.compile(r"--(?:enable|disable)-(?:rosout|stdout|external-lib)-logs")
_RULE = re.compile(r"(?:(?P<node>[A-Za-z_]\w*):(?!/))?(?P<match>[^:]+):=(?P<replacement>.*)")
_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_NAMESPACE = re.compile(r"/|(?:/[A-Za-z_]\w*)+", re.ASCII)
_TOPIC = re.compile(r"[~/]?[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*", re.ASCII)
_OPTIONS = {"/tf": "--tf-topic", "/tf_static": "--tf-static-topic"}


class NodeIdentity(TypedDict):
    """The name of a node, as keyword arguments of `coframe.connect`."""

    node_name: str
    node_namespace: str


class _Rule(NamedTuple):
    """A remapping rule, for one node or, if `node` is None, for any."""

    node: str | None
    match: str
    replacement: str


_rules: ContextVar[tuple[_Rule, ...]] = ContextVar("rules", default=())
_parameters: ContextVar[dict[str, str]] = ContextVar("parameters", default={})  # noqa: B039 - it is never changed


class NodeCommand(Command):
    """A command whose node can be renamed by remapping rules after ``--ros-args``."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Remove ``--ros-args ... --`` from the arguments, and parse the others with the remapped topics."""
        own, rules, parameters = _split(args)
        _rules.set(rules)
        _parameters.set(parameters)
        namespace = node_identity("")["node_namespace"]
        for rule in rules:
            option = _OPTIONS.get(_full_name(rule.match, namespace))
            if option is not None and option not in own:
                own += [option, _full_name(rule.replacement, namespace)]
        return super().parse_args(ctx, own)


def node_identity(default: str) -> NodeIdentity:
    """Return the name and the namespace of the node of this command after remapping.

    Args:
        default: The name without a rule.
    """
    found = {"__node": default, "__ns": "/"}
    for rule in reversed(_rules.get()):  # The first matching rule applies.
        match = "__node" if rule.match == "__name" else rule.match
        if match in found and rule.node in {None, default}:
            found[match] = rule.replacement
    return NodeIdentity(node_name=found["__node"], node_namespace=found["__ns"])


def parameter_flag(name: str) -> bool | None:
    """Return the value of a parameter that is true or false, or None if it is not given or has another value."""
    return {"true": True, "false": False}.get(_parameters.get().get(name, "").lower())


def _full_name(topic: str, namespace: str) -> str:
    return topic if topic.startswith("/") else f"{namespace.rstrip('/')}/{topic}"


def _split(args: list[str]) -> tuple[list[str], tuple[_Rule, ...], dict[str, str]]:
    """Return the arguments outside of ``--ros-args ... --``, and the remapping rules and the parameters inside."""
    own: list[str] = []
    rules: list[_Rule] = []
    parameters: dict[str, str] = {}
    words = iter(args)
    for word in words:
        if word == _START:
            rules += _section(words, parameters)
        else:
            own.append(word)
    return own, tuple(rules), parameters


def _section(words: Iterator[str], parameters: dict[str, str]) -> Iterator[_Rule]:
    for word in words:
        if word == _END:
            return
        if word in {"-r", "--remap"}:
            yield _parse(_argument(word, words))
        elif word in {"-p", "--param"}:
            name, _, value = _argument(word, words).partition(":=")
            parameters[name] = value
        elif word in _FLAGS_WITH_ARGUMENT:
            _argument(word, words)
        elif ":=" in word and not word.startswith("-"):
            yield _parse(word)
        elif word != _START and not _SWITCH.fullmatch(word):
            _fail(
                f"{word!r} is not a ROS argument.",
                "Write the command's own options before --ros-args, and remapping rules as -r FROM:=TO.",
            )


def _argument(flag: str, words: Iterator[str]) -> str:
    word = next(words, None)
    if word is None:
        _fail(f"{flag} requires an argument.", "For example: --ros-args -r __node:=my_node")
    return word


def _parse(rule: str) -> _Rule:
    parts = _RULE.fullmatch(rule)
    if parts is None:
        _fail(f"{rule!r} is not a remapping rule.", "Write FROM:=TO, for example: -r /tf:=/robot1/tf")
    match, replacement = parts["match"], parts["replacement"]
    pattern = {"__node": _NAME, "__name": _NAME, "__ns": _NAMESPACE}.get(match, _TOPIC)
    if not pattern.fullmatch(replacement):
        _fail(f"{rule!r}: {replacement!r} is not a valid name.", "Namespaces begin with a slash: __ns:=/robot1")
    return _Rule(parts["node"], match, replacement)


def _fail(text: str, hint: str) -> NoReturn:
    from coframe.cli.output import fail  # noqa: PLC0415 - imports NumPy, which `coframe --help` does not need

    fail(text, hint, code=2)
