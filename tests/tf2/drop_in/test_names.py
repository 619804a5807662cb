# SPDX-License-Identifier: Apache-2.0
"""Names and signatures of tf2's Python packages."""

import importlib
import inspect

import pytest

import tf2_py
import tf2_ros
from coframe import CoframeError

EXCEPTIONS = """
    TransformException LookupException ConnectivityException ExtrapolationException InvalidArgumentException
    TimeoutException
"""

# Names that programs import from each module, including those that upstream's modules only import.
NAMES = {
    "tf2_py": f"BufferCore {EXCEPTIONS} add_dll_directories_from_env",
    "tf2_py._tf2_py": f"BufferCore {EXCEPTIONS}",
    "tf2_ros": f"""
        {EXCEPTIONS} BufferCore Buffer BufferInterface TransformListener TransformBroadcaster StaticTransformBroadcaster
        StaticTransformListener BufferClient ActionClient TransformRegistration ConvertRegistration TypeException
        NotImplementedException Stamped
        convert MsgStamped PyKDLType TransformableObject TransformableObjectType TransformStamped PointStamped
        PoseStamped PoseWithCovarianceStamped Vector3Stamped PointCloud2 Header TFMessage FrameGraph LookupTransform
        FrameGraphSrvRequest FrameGraphSrvResponse Time Duration Clock Node Future QoSProfile DurabilityPolicy
        HistoryPolicy ReentrantCallbackGroup SingleThreadedExecutor JumpThreshold TimeJump Thread sleep deepcopy
        threading warnings builtin_interfaces rclpy tf2 tf2_ros Any Callable Dict List NoReturn Optional Tuple Type
        TypeVar Union DEFAULT_TF_TOPIC DEFAULT_STATIC_TF_TOPIC add_dll_directories_from_env
        buffer buffer_client buffer_interface transform_listener transform_broadcaster static_transform_broadcaster
        static_transform_listener
    """,
    "tf2_ros.buffer": """
        Buffer BufferInterface TransformStamped FrameGraph FrameGraphSrvRequest FrameGraphSrvResponse Clock
        JumpThreshold TimeJump Duration Future Node Time threading deepcopy sleep rclpy tf2 tf2_ros builtin_interfaces
        Any Callable List Optional Tuple TypeVar Union
    """,
    "tf2_ros.buffer_interface": """
        BufferInterface TransformRegistration ConvertRegistration TypeException NotImplementedException Stamped convert
        MsgStamped PyKDLType TransformableObject TransformableObjectType PointStamped PoseStamped
        PoseWithCovarianceStamped TransformStamped Vector3Stamped PointCloud2 Header Time Duration deepcopy rclpy tf2
        tf2_ros builtin_interfaces Any Callable Optional Tuple Type TypeVar Union
    """,
    "tf2_ros.buffer_client": "BufferClient BufferInterface ActionClient LookupTransform Duration Time TransformStamped",
    "tf2_ros.transform_listener": """
        TransformListener Buffer ReentrantCallbackGroup SingleThreadedExecutor Node DurabilityPolicy HistoryPolicy
        QoSProfile TFMessage Thread rclpy tf2 Optional Union
    """,
    "tf2_ros.transform_broadcaster": """
        TransformBroadcaster Node QoSProfile TFMessage TransformStamped List Optional Union
    """,
    "tf2_ros.static_transform_broadcaster": """
        StaticTransformBroadcaster Node QoSProfile DurabilityPolicy HistoryPolicy TFMessage TransformStamped List
        Optional Union
    """,
    "tf2_ros.static_transform_listener": "StaticTransformListener",
    "tf2_geometry_msgs": """
        do_transform_point do_transform_vector3 do_transform_pose do_transform_pose_stamped
        do_transform_pose_with_covariance_stamped do_transform_polygon_stamped transform_covariance to_msg_msg
        from_msg_msg PointStamped PolygonStamped Pose PoseStamped PoseWithCovarianceStamped TransformStamped
        Vector3Stamped Iterable Optional Tuple np tf2_ros
    """,
    "tf2_geometry_msgs.tf2_geometry_msgs": """
        do_transform_point do_transform_vector3 do_transform_pose do_transform_pose_stamped
        do_transform_pose_with_covariance_stamped do_transform_polygon_stamped transform_covariance to_msg_msg
        from_msg_msg _build_affine _transform_to_affine _get_mat_from_quat _get_quat_from_mat _decompose_affine
    """,
    "tf2_sensor_msgs": "do_transform_cloud transform_points",
    "tf2_sensor_msgs.tf2_sensor_msgs": """
        do_transform_cloud transform_points to_msg_msg from_msg_msg PointCloud2 np tf2_ros
    """,
    "tf2_msgs.msg": "TFMessage TF2Error",
    "tf2_msgs.srv": "FrameGraph",
    "tf2_msgs.action": "LookupTransform",
}


@pytest.mark.parametrize(("module", "name"), [(module, name) for module in NAMES for name in NAMES[module].split()])
def test_name(module, name):
    assert hasattr(importlib.import_module(module), name)


@pytest.mark.parametrize("module", NAMES)
def test_star_import(module):
    """Star imports include the imported names: `from tf2_ros import *; TransformStamped()`."""
    namespace = {}
    exec(f"from {module} import *", namespace)
    public = {name for name in NAMES[module].split() if not name.startswith("_")}
    submodules = {name for name in public if inspect.ismodule(namespace.get(name)) or f"{module}.{name}" in NAMES}
    assert public - submodules <= namespace.keys()


FIVE = "target_frame, target_time, source_frame, source_time, fixed_frame"

VELOCITY = (
    "tracking_frame, observation_frame, reference_frame, reference_point, reference_point_frame, time, "
    "averaging_interval"
)
LISTENER = "spin_thread=, qos=, static_qos=, tf_topic=, tf_static_topic=, static_only="

# Parameters in order. `/` ends positional-only ones, `*` begins keyword-only ones, `=` marks optional ones.
SIGNATURES = {
    "tf2_py.BufferCore": "cache_time=, /",
    "tf2_py.BufferCore.set_transform": "transform, authority, /",
    "tf2_py.BufferCore.set_transform_static": "transform, authority, /",
    "tf2_py.BufferCore.can_transform_core": "target_frame, source_frame, time",
    "tf2_py.BufferCore.can_transform_full_core": FIVE,
    "tf2_py.BufferCore.lookup_transform_core": "target_frame, source_frame, time",
    "tf2_py.BufferCore.lookup_transform_full_core": FIVE,
    "tf2_py.BufferCore.get_latest_common_time": "target_frame, source_frame, /",
    "tf2_py.BufferCore.lookupVelocityCore": "tracking_frame, observation_frame, time, averaging_interval",
    "tf2_py.BufferCore.lookupVelocityFullCore": f"{VELOCITY}, /",
    "tf2_py.BufferCore.all_frames_as_yaml": "",
    "tf2_py.BufferCore.all_frames_as_string": "",
    "tf2_py.BufferCore._allFramesAsDot": "time=",
    "tf2_py.BufferCore._chain": FIVE,
    "tf2_py.BufferCore._frameExists": "frame, /",
    "tf2_py.BufferCore._getFrameStrings": "",
    "tf2_py.BufferCore.clear": "",
    "tf2_ros.Buffer": "cache_time=, node=",
    "tf2_ros.Buffer.set_transform": "transform, authority",
    "tf2_ros.Buffer.set_transform_static": "transform, authority",
    "tf2_ros.Buffer.lookup_transform": "target_frame, source_frame, time, timeout=",
    "tf2_ros.Buffer.lookup_transform_full": f"{FIVE}, timeout=",
    "tf2_ros.Buffer.lookup_transform_async": "target_frame, source_frame, time",
    "tf2_ros.Buffer.lookup_transform_full_async": FIVE,
    "tf2_ros.Buffer.can_transform": "target_frame, source_frame, time, timeout=, return_debug_tuple=",
    "tf2_ros.Buffer.can_transform_full": f"{FIVE}, timeout=, return_debug_tuple=",
    "tf2_ros.Buffer.wait_for_transform_async": "target_frame, source_frame, time",
    "tf2_ros.Buffer.wait_for_transform_full_async": FIVE,
    "tf2_ros.Buffer.time_jump_callback": "time_jump",
    "tf2_ros.BufferInterface": "",
    "tf2_ros.BufferInterface.transform": "object_stamped, target_frame, timeout=, new_type=",
    "tf2_ros.BufferInterface.transform_full": (
        "object_stamped, target_frame, target_time, fixed_frame, timeout=, new_type="
    ),
    "tf2_ros.BufferInterface.lookup_transform": "target_frame, source_frame, time, timeout=",
    "tf2_ros.BufferInterface.lookup_transform_full": f"{FIVE}, timeout=",
    "tf2_ros.BufferInterface.can_transform": "target_frame, source_frame, time, timeout=",
    "tf2_ros.BufferInterface.can_transform_full": f"{FIVE}, timeout=",
    "tf2_ros.BufferClient": "node, ns, check_frequency=, timeout_padding=",
    "tf2_ros.BufferClient.lookup_transform": "target_frame, source_frame, time, timeout=",
    "tf2_ros.BufferClient.lookup_transform_full": f"{FIVE}, timeout=",
    "tf2_ros.BufferClient.can_transform": "target_frame, source_frame, time, timeout=",
    "tf2_ros.BufferClient.can_transform_full": f"{FIVE}, timeout=",
    "tf2_ros.BufferClient.transform": "object_stamped, target_frame, timeout=, new_type=",
    "tf2_ros.BufferClient.destroy": "",
    "tf2_ros.TransformListener": f"buffer, node, *, {LISTENER}",
    "tf2_ros.TransformListener.unregister": "",
    "tf2_ros.TransformListener.callback": "data",
    "tf2_ros.TransformListener.static_callback": "data",
    "tf2_ros.StaticTransformListener": "buffer, node, *, spin_thread=, static_qos=, tf_static_topic=",
    "tf2_ros.TransformBroadcaster": "node, qos=",
    "tf2_ros.TransformBroadcaster.sendTransform": "transform",
    "tf2_ros.StaticTransformBroadcaster": "node, qos=",
    "tf2_ros.StaticTransformBroadcaster.sendTransform": "transform",
    "tf2_ros.TransformRegistration.add": "key, callback",
    "tf2_ros.TransformRegistration.get": "key",
    "tf2_ros.TransformRegistration.print_me": "",
    "tf2_ros.ConvertRegistration.add_from_msg": "key, callback",
    "tf2_ros.ConvertRegistration.add_to_msg": "key, callback",
    "tf2_ros.ConvertRegistration.add_convert": "key, callback",
    "tf2_ros.ConvertRegistration.get_from_msg": "key",
    "tf2_ros.ConvertRegistration.get_to_msg": "key",
    "tf2_ros.ConvertRegistration.get_convert": "key",
    "tf2_ros.Stamped": "obj, stamp, frame_id",
    "tf2_ros.convert": "a, b_type",
    "tf2_ros.TypeException": "errstr",
    "tf2_ros.NotImplementedException": "",
    "tf2_geometry_msgs.do_transform_point": "point, transform",
    "tf2_geometry_msgs.do_transform_vector3": "vector3, transform",
    "tf2_geometry_msgs.do_transform_pose": "pose, transform",
    "tf2_geometry_msgs.do_transform_pose_stamped": "pose, transform",
    "tf2_geometry_msgs.do_transform_pose_with_covariance_stamped": "pose, transform",
    "tf2_geometry_msgs.do_transform_polygon_stamped": "polygon, transform",
    "tf2_geometry_msgs.transform_covariance": "cov_in, transform",
    "tf2_geometry_msgs.to_msg_msg": "msg",
    "tf2_geometry_msgs.from_msg_msg": "msg",
    "tf2_sensor_msgs.do_transform_cloud": "cloud, transform",
    "tf2_sensor_msgs.transform_points": "point_cloud, transform",
}


def parsed(signature: str) -> list[tuple[str, str, bool]]:
    """Return (kind, name, optional) of each parameter."""
    kind, parameters = "any", []
    for word in (word.strip() for word in signature.split(",") if word.strip()):
        if word == "/":
            parameters = [("position", name, optional) for _, name, optional in parameters]
        elif word == "*":
            kind = "keyword"
        else:
            parameters.append((kind, word.rstrip("="), word.endswith("=")))
    return parameters


@pytest.mark.parametrize("path", SIGNATURES)
def test_signature(path):
    module, *attributes = path.split(".")
    thing = importlib.import_module(module)
    for attribute in attributes:
        thing = getattr(thing, attribute)
    parameters = list(inspect.signature(thing).parameters.values())
    if inspect.isfunction(thing) and len(attributes) > 1:
        parameters = parameters[1:]  # self
    found = {parameter.name: (place, parameter) for place, parameter in enumerate(parameters)}
    expected = parsed(SIGNATURES[path])
    for place, (kind, name, is_optional) in enumerate(expected):
        assert name in found, f"{path} has no {name}"
        at, parameter = found.pop(name)
        assert kind == "keyword" or at == place, f"{name} is argument {at}, not {place}"
        assert (
            parameter.kind
            in {
                "position": {inspect.Parameter.POSITIONAL_ONLY},
                "any": {inspect.Parameter.POSITIONAL_OR_KEYWORD},
                "keyword": {inspect.Parameter.KEYWORD_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD},
            }[kind]
        ), f"{name} is {parameter.kind.description}"
        assert not is_optional or parameter.default is not inspect.Parameter.empty, f"{name} is optional upstream"
    # Additional parameters must be optional and keyword-only.
    variadic = {inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD}
    for _, parameter in found.values():
        ours = parameter.kind is inspect.Parameter.KEYWORD_ONLY and parameter.default is not inspect.Parameter.empty
        assert parameter.kind in variadic or ours, f"{path} has {parameter.name}, which upstream has not"


def test_modules_of_classes():
    for name in EXCEPTIONS.split():
        exception = getattr(tf2_py, name)
        assert (exception.__module__, exception.__qualname__) == ("tf2", name)
        assert exception is getattr(tf2_ros, name)
    assert tf2_py.BufferCore.__module__ == "_tf2"


def test_base_classes_of_exceptions():
    for name in EXCEPTIONS.split()[1:]:
        assert getattr(tf2_py, name).__bases__ == (tf2_py.TransformException,)
    assert tf2_py.TransformException.__mro__[1:3] == (CoframeError, Exception)
    assert tf2_ros.TypeException.__bases__ == tf2_ros.NotImplementedException.__bases__ == (Exception,)


@pytest.mark.parametrize(
    "name",
    [
        "BufferCore",
        "Buffer",
        "BufferInterface",
        "TransformListener",
        "TransformBroadcaster",
        "StaticTransformBroadcaster",
        "TransformRegistration",
        "ConvertRegistration",
        "LookupException",
        "TransformException",
    ],
)
def test_classes_can_be_subclassed(name):
    parent = getattr(tf2_ros, name)
    assert issubclass(type("Mine", (parent,), {}), parent)


def test_base_classes_of_buffers():
    assert tf2_ros.Buffer.__bases__ == (tf2_py.BufferCore, tf2_ros.BufferInterface)


def test_velocity_methods_are_in_the_buffer():
    assert hasattr(tf2_ros.Buffer, "lookupVelocityCore")
    assert not any("elocity" in name for name in dir(tf2_ros.BufferInterface))


def test_constants_and_fields_of_messages():
    from tf2_msgs.action import LookupTransform
    from tf2_msgs.msg import TF2Error, TFMessage
    from tf2_msgs.srv import FrameGraph

    codes = "NO_ERROR LOOKUP_ERROR CONNECTIVITY_ERROR EXTRAPOLATION_ERROR INVALID_ARGUMENT_ERROR TIMEOUT_ERROR"
    names = [*codes.split(), "TRANSFORM_ERROR"]
    assert [getattr(TF2Error, name) for name in names] == list(range(7))

    def fields(message):
        return list(message.get_fields_and_field_types())

    assert fields(TFMessage) == ["transforms"]
    assert fields(FrameGraph.Response) == ["frame_yaml"]
    assert fields(LookupTransform.Goal) == [
        "target_frame",
        "source_frame",
        "source_time",
        "timeout",
        "target_time",
        "fixed_frame",
        "advanced",
    ]
    assert fields(LookupTransform.Result) == ["transform", "error"]
