# SPDX-License-Identifier: Apache-2.0
"""Application of remapping rules to the names of a node."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rclpy.expand_topic_name import expand_topic_name
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_topic_name import validate_topic_name

if TYPE_CHECKING:
    from rclpy._arguments import Remap


def remap_node(name: str, namespace: str, rules: list[Remap]) -> tuple[str, str]:
    """Return a node's name and namespace after `__node:=` and `__ns:=`. The first matching rule applies."""
    new_name = _first_match(rules, "name", name) or name
    new_namespace = _first_match(rules, "namespace", new_name) or namespace
    return new_name, new_namespace


def _first_match(rules: list[Remap], kind: str, node_name: str) -> str | None:
    for rule in rules:
        if rule.kind == kind and rule.node in {None, node_name}:
            return rule.replacement
    return None


@dataclass(frozen=True)
class NameResolver:
    """Resolver that expands and remaps the topic and service names of one node."""

    node_name: str
    namespace: str
    rules: list[Remap]

    @property
    def full_name(self) -> str:
        """The name of the node with its namespace, for example "/robot1/arm"."""
        return f"{self.namespace.rstrip('/')}/{self.node_name}"

    def resolve(self, name: str, *, is_service: bool = False, only_expand: bool = False) -> str:
        """Return the fully qualified name, remapped by the first matching rule.

        Raises:
            InvalidTopicNameException: The topic name is not valid.
            InvalidServiceNameException: The service name is not valid.
        """
        full = self._expand(name, is_service=is_service)
        if not only_expand:
            full = self._remap(full, is_service=is_service)
        validate_full_topic_name(full, is_service=is_service)
        return full

    def _expand(self, name: str, *, is_service: bool) -> str:
        validate_topic_name(name, is_service=is_service)
        return expand_topic_name(name, self.node_name, self.namespace)

    def _remap(self, full: str, *, is_service: bool) -> str:
        kinds = {"any", "service" if is_service else "topic"}
        for rule in self.rules:
            applies = rule.kind in kinds and rule.node in {None, self.node_name}
            if applies and self._expand(rule.match, is_service=is_service) == full:
                return self._expand(rule.replacement, is_service=is_service)
        return full
