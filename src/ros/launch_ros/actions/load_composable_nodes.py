# SPDX-License-Identifier: Apache-2.0
"""The action that loads composable nodes into a container."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import launch.logging
from coframe.workspace.packages.components import IN_CPP
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions.lifecycle_transition import LifecycleTransition
from launch_ros.actions.node_parsing import parse_parameters, parse_remappings
from launch_ros.descriptions.composable_lifecycle_node import ComposableLifecycleNode
from launch_ros.descriptions.composable_node import ComposableNode
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    prefix_namespace,
    to_parameters_list,
)

if TYPE_CHECKING:
    from composition_interfaces.srv import LoadNode
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch_ros.actions.composable_node_container import ComposableNodeContainer

__all__ = ["LoadComposableNodes", "get_composable_node_load_request", "parse_composable_nodes"]

_CHECK_PERIOD = 1.0  # seconds between two checks whether the container is there
_ANSWER = 0.05  # seconds between two checks whether the container has answered


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Load composable nodes in order. Nodes that cannot be loaded are logged as errors.

    Args:
        composable_node_descriptions: The composable nodes.
        target_container: Name of the container, or the action that runs it.
        condition: Load them only if this condition holds.
    """

    def __init__(
        self,
        *,
        composable_node_descriptions: list[ComposableNode],
        target_container: SomeSubstitutionsType | ComposableNodeContainer,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__descriptions = composable_node_descriptions
        self.__container = target_container if isinstance(target_container, Action) else None
        self.__target = (
            [] if isinstance(target_container, Action) else normalize_to_list_of_substitutions(target_container)
        )
        self.__logger = launch.logging.get_logger("launch_ros.actions.load_composable_nodes")
        self.__task: asyncio.Task[None] | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<load_composable_node target=...>`` with its ``<composable_node>``."""
        _, options = super().parse(entity, parser)
        options["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        return cls, options | {"composable_node_descriptions": parse_composable_nodes(entity, parser) or []}

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start to load the nodes as soon as the container is there."""
        container = self.__name_of_container(context)
        if container is None:
            self.__logger.error("The target container has no name: its nodes are not loaded.")
            return None
        requests = [
            (each, get_composable_node_load_request(each, context))
            for each in self.__descriptions
            if each.condition is None or each.condition.evaluate(context)
        ]
        if requests:
            self.__task = asyncio.ensure_future(self.__load(context, container, requests))
            context.add_completion_future(self.__task)
        return None

    def __name_of_container(self, context: LaunchContext) -> str | None:
        if self.__container is not None:
            is_known = self.__container.is_node_name_fully_specified()
            return self.__container.node_name if is_known else None
        base = context.launch_configurations.get("ros_namespace")
        name = prefix_namespace(base, perform_substitutions(context, self.__target))
        return make_namespace_absolute(name)

    async def __load(
        self, context: LaunchContext, container: str, requests: list[tuple[ComposableNode, LoadNode.Request]]
    ) -> None:
        """Load the nodes; this waits for the container as long as the system is not shut down."""
        from composition_interfaces.srv import LoadNode  # noqa: PLC0415 - slow to import

        service = f"{container}/_container/load_node"
        client = get_ros_node(context).create_client(LoadNode, service)
        loop = asyncio.get_running_loop()
        while not await loop.run_in_executor(None, client.wait_for_service, _CHECK_PERIOD):
            if self.__has_ended(context):
                self.__logger.warning(
                    f"Abandoning wait for the '{service}' service, due to the end of the container or of the launch."
                )
                return
            if reason := getattr(client, "_Coframe__refusal", ""):  # not in the rclpy of a sourced ROS
                self.__logger.error(reason)
                return
        in_cpp: list[str] = []
        try:
            for description, request in requests:
                if self.__has_ended(context):
                    return
                name = await self.__load_one(context, container, client.call_async(request), request, in_cpp)
                if name and isinstance(description, ComposableLifecycleNode):
                    await self.__start(context, description, name)
        finally:
            if in_cpp:
                self.__logger.error(
                    f"{container}: {IN_CPP}; not loaded: {', '.join(in_cpp)}. Use nodes in Python, or source a ROS 2 "
                    "for this launch file."
                )

    async def __load_one(
        self, context: LaunchContext, container: str, future: Any, request: LoadNode.Request, in_cpp: list[str]
    ) -> str:
        """Wait for the response, and return the name of the node; "" if it is not loaded."""
        while not future.done():
            if self.__has_ended(context):
                self.__logger.warning(f"Abandoning wait for '{request.plugin_name}' in '{container}', due to shutdown.")
                return ""
            await asyncio.sleep(_ANSWER)
        response = future.result()
        if response is not None and IN_CPP in response.error_message:
            in_cpp.append(request.plugin_name)
            return ""
        return self.__report(context, container, request, response)

    async def __start(self, context: LaunchContext, description: ComposableLifecycleNode, name: str) -> None:
        """Let events change the state of a loaded node, and activate it if its description says so."""
        container = self.__container
        description.start_events(context, name, lambda: None if container is None else container.return_code)
        if not description.node_autostart:
            return
        transition = LifecycleTransition(lifecycle_node_names=[name], transition_ids=["configure", "activate"])
        for action in transition.execute(context) or ():
            action.visit(context)

    def __has_ended(self, context: LaunchContext) -> bool:
        return context.is_shutdown or (self.__container is not None and self.__container.return_code is not None)

    def __report(
        self,
        context: LaunchContext,
        container: str,
        request: LoadNode.Request,
        response: LoadNode.Response | None,
    ) -> str:
        name = request.node_name or request.plugin_name
        if response is None or not response.success:
            reason = "no response" if response is None else response.error_message
            self.__logger.error(
                f"Failed to load node '{name}' of type '{request.plugin_name}' in container '{container}': {reason}"
            )
            return ""
        loaded = response.full_node_name or name
        self.__logger.info(f"Loaded node '{loaded}' in container '{container}'")
        add_node_name(context, loaded)
        count = get_node_name_count(context, loaded)
        if count > 1:
            self.__logger.warning(
                f"there are now at least {count} nodes with the name {loaded} created within this launch context"
            )
        return loaded


def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: LaunchContext
) -> LoadNode.Request:
    """Return the request that loads a composable node, with all substitutions performed."""
    from composition_interfaces.srv import LoadNode  # noqa: PLC0415 - slow to import

    node = composable_node_description
    request = LoadNode.Request()
    request.package_name = perform_substitutions(context, node.package)
    request.plugin_name = perform_substitutions(context, node.node_plugin)
    if node.node_name is not None:
        request.node_name = perform_substitutions(context, node.node_name)
    own = None if node.node_namespace is None else perform_substitutions(context, node.node_namespace)
    combined = make_namespace_absolute(prefix_namespace(context.launch_configurations.get("ros_namespace"), own))
    request.node_namespace = combined or ""
    remaps = list(context.launch_configurations.get("ros_remaps", []))
    for source, target in node.remappings or ():
        remaps.append((perform_substitutions(context, source), perform_substitutions(context, target)))
    request.remap_rules = [f"{before}:={after}" for before, after in remaps]
    given = [
        {each[0]: each[1]} if isinstance(each, tuple) else each
        for each in context.launch_configurations.get("global_params", [])
    ]
    given += evaluate_parameters(context, node.parameters or ())
    request.parameters = to_parameters_list(context, request.node_name, request.node_namespace, given)
    if node.extra_arguments is not None:
        extra = evaluate_parameters(context, node.extra_arguments)
        request.extra_arguments = to_parameters_list(context, request.node_name, request.node_namespace, extra)
    return request


def parse_composable_nodes(entity: Entity, parser: Parser) -> list[ComposableNode] | None:
    """Return the composable nodes of an element, those with a life cycle after the others, or None."""
    children = entity.get_attr("composable_node", data_type=list, optional=True)
    managed = entity.get_attr("composable_lifecycle_node", data_type=list, optional=True)
    if children is None and managed is None:
        return None
    found = [ComposableNode(**_options_of(child, parser)) for child in children or ()]
    for child in managed or ():
        autostart = child.get_attr("autostart", data_type=bool, optional=True)
        found.append(ComposableLifecycleNode(autostart=bool(autostart), **_options_of(child, parser)))
    return found


def _options_of(child: Entity, parser: Parser) -> dict[str, Any]:
    """Return the arguments of ComposableNode that an element has."""
    _, options = Action.parse(child, parser)  # if and unless
    for name, keyword in (
        ("pkg", "package"),
        ("plugin", "plugin"),
        ("name", "name"),
        ("namespace", "namespace"),
    ):
        text = child.get_attr(name, optional=name not in {"pkg", "plugin"})
        if text is not None:
            options[keyword] = parser.parse_substitution(text)
    parameters = child.get_attr("param", data_type=list, optional=True)
    if parameters is not None:
        options["parameters"] = parse_parameters(parameters, parser)
    options["remappings"] = parse_remappings(child, parser)
    extra = child.get_attr("extra_arg", data_type=list, optional=True)
    if extra is not None:
        options["extra_arguments"] = parse_parameters(extra, parser)
    return options
