# SPDX-License-Identifier: Apache-2.0
"""The names that launch and launch_ros of Humble and Jazzy export; all of them import."""

import importlib

import pytest

NAMES = {
    "launch": "Action Condition Event EventHandler InvalidLaunchFileError LaunchContext LaunchDescription "
    "LaunchDescriptionEntity LaunchDescriptionSource LaunchIntrospector LaunchService SomeActionsType "
    "SomeActionsType_types_tuple SomeEntitiesType SomeEntitiesType_types_tuple SomeSubstitutionsType "
    "SomeSubstitutionsType_types_tuple Substitution actions conditions descriptions event_handlers events frontend "
    "launch_description_sources logging substitutions",
    "launch.actions": "AppendEnvironmentVariable DeclareLaunchArgument EmitEvent ExecuteLocal ExecuteProcess ForEach "
    "ForLoop GroupAction IncludeLaunchDescription LogInfo OpaqueCoroutine OpaqueFunction PopEnvironment "
    "PopLaunchConfigurations PushEnvironment PushLaunchConfigurations RegisterEventHandler ResetEnvironment "
    "ResetLaunchConfigurations SetEnvironmentVariable SetLaunchConfiguration Shutdown TimerAction "
    "UnregisterEventHandler UnsetEnvironmentVariable UnsetLaunchConfiguration",
    "launch.actions.append_environment_variable": "AppendEnvironmentVariable",
    "launch.actions.declare_launch_argument": "DeclareLaunchArgument",
    "launch.actions.emit_event": "EmitEvent",
    "launch.actions.execute_local": "ExecuteLocal",
    "launch.actions.execute_process": "ExecuteProcess",
    "launch.actions.group_action": "GroupAction",
    "launch.actions.include_launch_description": "IncludeLaunchDescription",
    "launch.actions.log_info": "LogInfo",
    "launch.actions.opaque_coroutine": "OpaqueCoroutine",
    "launch.actions.opaque_function": "OpaqueFunction",
    "launch.actions.pop_environment": "PopEnvironment",
    "launch.actions.pop_launch_configurations": "PopLaunchConfigurations",
    "launch.actions.push_environment": "PushEnvironment",
    "launch.actions.push_launch_configurations": "PushLaunchConfigurations",
    "launch.actions.register_event_handler": "RegisterEventHandler",
    "launch.actions.reset_environment": "ResetEnvironment",
    "launch.actions.reset_launch_configurations": "ResetLaunchConfigurations",
    "launch.actions.set_environment_variable": "SetEnvironmentVariable",
    "launch.actions.set_launch_configuration": "SetLaunchConfiguration",
    "launch.actions.shutdown_action": "Shutdown",
    "launch.actions.timer_action": "TimerAction",
    "launch.actions.unregister_event_handler": "UnregisterEventHandler",
    "launch.actions.unset_environment_variable": "UnsetEnvironmentVariable",
    "launch.actions.unset_launch_configuration": "UnsetLaunchConfiguration",
    "launch.conditions": "IfCondition InvalidConditionExpressionError LaunchConfigurationEquals "
    "LaunchConfigurationNotEquals UnlessCondition evaluate_condition_expression",
    "launch.conditions.if_condition": "IfCondition",
    "launch.conditions.unless_condition": "UnlessCondition",
    "launch.conditions.launch_configuration_equals": "LaunchConfigurationEquals",
    "launch.conditions.launch_configuration_not_equals": "LaunchConfigurationNotEquals",
    "launch.descriptions": "Executable",
    "launch.event_handlers": "OnActionEventBase OnExecutionComplete OnIncludeLaunchDescription OnProcessExit "
    "OnProcessIO OnProcessStart OnShutdown",
    "launch.event_handlers.on_process_exit": "OnProcessExit",
    "launch.event_handlers.on_process_start": "OnProcessStart",
    "launch.event_handlers.on_process_io": "OnProcessIO",
    "launch.event_handlers.on_shutdown": "OnShutdown",
    "launch.events": "ExecutionComplete IncludeLaunchDescription Shutdown TimerEvent matches_action process",
    "launch.events.process": "ProcessExited ProcessIO ProcessStarted ProcessStderr ProcessStdin ProcessStdout "
    "ProcessTargetedEvent RunningProcessEvent ShutdownProcess SignalProcess matches_executable matches_name "
    "matches_pid",
    "launch.frontend": "Entity InvalidFrontendLaunchFileError Parser expose_action expose_substitution",
    "launch.launch_context": "LaunchContext",
    "launch.launch_description": "LaunchDescription",
    "launch.launch_description_sources": "AnyLaunchDescriptionSource FrontendLaunchDescriptionSource "
    "InvalidPythonLaunchFileError PythonLaunchDescriptionSource get_launch_description_from_any_launch_file "
    "get_launch_description_from_frontend_launch_file get_launch_description_from_python_launch_file "
    "load_python_launch_file_as_module",
    "launch.launch_service": "LaunchService",
    "launch.logging": "get_logger get_output_loggers launch_config reset",
    "launch.some_actions_type": "SomeActionsType SomeActionsType_types_tuple",
    "launch.some_entities_type": "SomeEntitiesType SomeEntitiesType_types_tuple",
    "launch.some_substitutions_type": "SomeSubstitutionsType SomeSubstitutionsType_types_tuple",
    "launch.substitutions": "AllSubstitution AndSubstitution AnonName AnySubstitution BooleanSubstitution Command "
    "EnvironmentVariable EqualsSubstitution FileContent FindExecutable ForEachVar ForLoopIndex IfElseSubstitution "
    "LaunchConfiguration LaunchLogDir LocalSubstitution NotEqualsSubstitution NotSubstitution OrSubstitution "
    "PathJoinSubstitution PythonExpression SubstitutionFailure TextSubstitution ThisLaunchFile ThisLaunchFileDir",
    "launch.substitutions.path_join_substitution": "PathJoinSubstitution",
    "launch.substitutions.substitution_failure": "SubstitutionFailure",
    "launch.utilities": "create_future ensure_argument_type is_a is_a_subclass isclassinstance "
    "normalize_to_list_of_entities normalize_to_list_of_substitutions perform_substitutions "
    "visit_all_entities_and_collect_futures",
    "launch.utilities.type_utils": "AllowedTypesType AllowedValueType SomeValueType coerce_list coerce_to_type "
    "extract_type get_typed_value is_instance_of is_normalized_substitution is_substitution is_typing_list "
    "normalize_typed_substitution perform_typed_substitution",
    "launch_xml": "Entity Parser",
    "launch_xml.launch_description_sources": "XMLLaunchDescriptionSource",
    "launch_yaml": "Entity Parser",
    "launch_yaml.launch_description_sources": "YAMLLaunchDescriptionSource",
    "launch_ros": "actions descriptions event_handlers events parameter_descriptions substitutions utilities",
    "launch_ros.actions": "ComposableNodeContainer LifecycleNode LifecycleTransition LoadComposableNodes Node "
    "PushROSNamespace PushRosNamespace ROSTimer RosTimer SetParameter SetParametersFromFile SetROSLogDir SetRemap "
    "SetUseSimTime",
    "launch_ros.actions.node": "Node",
    "launch_ros.descriptions": "ComposableNode Parameter ParameterFile ParameterValue",
    "launch_ros.event_handlers": "OnStateTransition",
    "launch_ros.events": "lifecycle matches_node_name",
    "launch_ros.events.lifecycle": "ChangeState StateTransition matches_node_name",
    "launch_ros.parameter_descriptions": "Parameter ParameterFile ParameterValue",
    "launch_ros.parameters_type": "Parameters ParametersDict ParameterName ParameterValue SomeParameters "
    "SomeParametersDict SomeParameterValue EvaluatedParameters EvaluatedParameterValue",
    "launch_ros.remap_rule_type": "RemapRule RemapRules SomeRemapRule SomeRemapRules",
    "launch_ros.ros_adapters": "ROSAdapter get_ros_adapter get_ros_node",
    "launch_ros.substitutions": "ExecutableInPackage FindPackage FindPackagePrefix FindPackageShare Parameter",
    "launch_ros.utilities": "add_node_name evaluate_parameter_dict evaluate_parameters get_node_name_count "
    "is_namespace_absolute is_root_namespace make_namespace_absolute normalize_parameter_dict normalize_parameters "
    "normalize_remap_rule normalize_remap_rules prefix_namespace",
}


@pytest.mark.parametrize("module", NAMES)
def test_names_import(module):
    found = importlib.import_module(module)
    assert [name for name in NAMES[module].split() if not hasattr(found, name)] == []


def test_names_of_a_recorded_humble(shared):
    """All attributes of the classes that a real Humble has are there, too."""
    import json

    recorded = json.loads((shared / "interop" / "api_humble.json").read_text())["launch"]
    launch = importlib.import_module("launch")
    missing = [
        f"{name}.{attribute}"
        for name, (attributes, _) in recorded.items()
        for attribute in attributes or []
        if not hasattr(getattr(launch, name), attribute)
    ]
    assert missing == []
