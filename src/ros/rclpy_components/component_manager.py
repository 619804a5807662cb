# SPDX-License-Identifier: Apache-2.0
"""The node of a container: its services load, unload and list composable nodes in Python."""

from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import PackageError
from coframe.workspace.packages.components import find_component
from coframe.workspace.packages.executables import module_folders
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.node import Node
from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.executors import Executor

__all__ = ["ComponentManager"]

_LOG_LEVELS = frozenset(range(10, 60, 10))  # debug to fatal; 0 is the default


class ComponentManager(Node):
    """A node with the services of a container: load_node, unload_node and list_nodes.

    Args:
        name: Name of the node.
        add_node: Is called with each loaded node, and lets an executor spin it.
        remove_node: Is called with each node before it is destroyed.
        options: Keyword arguments of Node.
    """

    def __init__(
        self,
        name: str = "ComponentManager",
        *,
        add_node: Callable[[Node], Any],
        remove_node: Callable[[Node], Any],
        **options: Any,
    ) -> None:
        super().__init__(name, **options)
        self.__add_node = add_node
        self.__remove_node = remove_node
        self.__nodes: dict[int, Node] = {}
        self.__next_id = 1
        self.create_service(LoadNode, "~/_container/load_node", self.__on_load)
        self.create_service(UnloadNode, "~/_container/unload_node", self.__on_unload)
        self.create_service(ListNodes, "~/_container/list_nodes", self.__on_list)

    @classmethod
    def in_executor(cls, executor: Executor, **options: Any) -> ComponentManager:
        """Return a manager whose nodes are spun by an executor, which spins the manager as well."""
        manager = cls(add_node=executor.add_node, remove_node=executor.remove_node, **options)
        executor.add_node(manager)
        return manager

    def __on_load(self, request: LoadNode.Request, response: LoadNode.Response) -> LoadNode.Response:
        try:
            node = self.__create(request)
        except PackageError as error:
            self.get_logger().error(str(error))
            response.error_message = error_text(error)
            return response
        # A node is the user's code: its exception is the response, as in C++ containers.
        except Exception as error:  # noqa: BLE001 - the response contains it
            self.get_logger().error(f"Component constructor threw an exception: {error}")
            response.error_message = f"Component constructor threw an exception: {type(error).__name__}: {error}"
            return response
        self.__nodes[self.__next_id] = node
        response.unique_id = self.__next_id
        response.full_node_name = node.get_fully_qualified_name()
        response.success = True
        self.__next_id += 1
        self.__add_node(node)
        return response

    def __create(self, request: LoadNode.Request) -> Node:
        target = find_component(request.package_name, request.plugin_name)
        for folder in module_folders():
            if folder not in sys.path:
                sys.path.append(folder)
        module_name, _, class_name = target.partition(":")
        cls = getattr(importlib.import_module(module_name), class_name, None)
        if not (isinstance(cls, type) and issubclass(cls, Node)):
            raise PackageError(f"{target} of {request.plugin_name!r} is not a subclass of rclpy.node.Node.")
        self.get_logger().info(f"Found class: {request.plugin_name}")
        self.get_logger().info(f"Instantiate class: {request.plugin_name}")
        with Node._Coframe__composed(cls, _options_of(request)):  # noqa: SLF001 - of coframe
            node: Node = cls()  # type: ignore[call-arg]  # a subclass, which needs no name
        if request.log_level in _LOG_LEVELS:
            node.get_logger().set_level(request.log_level)
        return node

    def __on_unload(self, request: UnloadNode.Request, response: UnloadNode.Response) -> UnloadNode.Response:
        node = self.__nodes.pop(request.unique_id, None)
        if node is None:
            response.error_message = f"No node found with unique_id: {request.unique_id}"
            self.get_logger().warning(response.error_message)
            return response
        self.__remove_node(node)
        node.destroy_node()
        response.success = True
        return response

    def __on_list(self, _request: ListNodes.Request, response: ListNodes.Response) -> ListNodes.Response:
        response.unique_ids = list(self.__nodes)
        response.full_node_names = [node.get_fully_qualified_name() for node in self.__nodes.values()]
        return response


def _options_of(request: LoadNode.Request) -> Any:
    """Return the options of the node that a request describes."""
    rules = [*request.remap_rules]
    if request.node_name:
        rules.append(f"__node:={request.node_name}")
    if request.node_namespace:
        rules.append(f"__ns:=/{request.node_namespace.lstrip('/')}")
    extra = {each.name: Parameter.from_parameter_msg(each).value for each in request.extra_arguments}
    return Node._Coframe__composed_options(  # noqa: SLF001 - of coframe
        ["--ros-args", *(word for rule in rules for word in ("-r", rule))],
        [Parameter.from_parameter_msg(each) for each in request.parameters],
        extra.get("forward_global_arguments") is True,
    )
