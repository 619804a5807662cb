# Written by scripts/generate_messages.py from interfaces/visualization_msgs/msg; do not edit.
"""Messages of visualization_msgs."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final

from coframe.distributions import follows
from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Duration
from coframe.messages.generated.geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from coframe.messages.generated.sensor_msgs.msg import CompressedImage
from coframe.messages.generated.std_msgs.msg import ColorRGBA, Header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberSequence


class ImageMarker(Message):
    """Message visualization_msgs/msg/ImageMarker."""

    ROS_TYPE = "visualization_msgs/msg/ImageMarker"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        BasicType('int32'),
        BasicType('int32'),
        BasicType('int32'),
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
        BasicType('float'),
        NamespacedType(('std_msgs', 'msg'), 'ColorRGBA'),
        BasicType('uint8'),
        NamespacedType(('std_msgs', 'msg'), 'ColorRGBA'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point')),
        UnboundedSequence(NamespacedType(('std_msgs', 'msg'), 'ColorRGBA')),
    )
    CIRCLE: Final = 0
    LINE_STRIP: Final = 1
    LINE_LIST: Final = 2
    POLYGON: Final = 3
    POINTS: Final = 4
    ADD: Final = 0
    REMOVE: Final = 1

    if TYPE_CHECKING:
        header: Header
        ns: str
        id: int
        type: int
        action: int
        position: Point
        scale: float
        outline_color: ColorRGBA
        filled: int
        fill_color: ColorRGBA
        lifetime: Duration
        points: list[Point]
        outline_colors: list[ColorRGBA]
        def __init__(self, *, header: Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., position: Point = ..., scale: float = ..., outline_color: ColorRGBA = ..., filled: int = ..., fill_color: ColorRGBA = ..., lifetime: Duration = ..., points: list[Point] = ..., outline_colors: list[ColorRGBA] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_ns", "_id", "_type", "_action", "_position", "_scale", "_outline_color", "_filled", "_fill_color", "_lifetime", "_points", "_outline_colors"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._ns = ""
            self._id = 0
            self._type = 0
            self._action = 0
            self._position = fields.get("position") or Point()
            self._scale = 0.0
            self._outline_color = fields.get("outline_color") or ColorRGBA()
            self._filled = 0
            self._fill_color = fields.get("fill_color") or ColorRGBA()
            self._lifetime = fields.get("lifetime") or Duration()
            self._points = []
            self._outline_colors = []
            if fields:
                set_fields(self, fields)


class MenuEntry(Message):
    """Message visualization_msgs/msg/MenuEntry."""

    ROS_TYPE = "visualization_msgs/msg/MenuEntry"
    SLOT_TYPES = (
        BasicType('uint32'),
        BasicType('uint32'),
        UnboundedString(),
        UnboundedString(),
        BasicType('uint8'),
    )
    FEEDBACK: Final = 0
    ROSRUN: Final = 1
    ROSLAUNCH: Final = 2

    if TYPE_CHECKING:
        id: int
        parent_id: int
        title: str
        command: str
        command_type: int
        def __init__(self, *, id: int = ..., parent_id: int = ..., title: str = ..., command: str = ..., command_type: int = ...) -> None: ...
    else:
        __slots__ = ["_id", "_parent_id", "_title", "_command", "_command_type"]

        def __init__(self, **fields: Any) -> None:
            self._id = 0
            self._parent_id = 0
            self._title = ""
            self._command = ""
            self._command_type = 0
            if fields:
                set_fields(self, fields)


class UVCoordinate(Message):
    """Message visualization_msgs/msg/UVCoordinate."""

    ROS_TYPE = "visualization_msgs/msg/UVCoordinate"
    SLOT_TYPES = (
        BasicType('float'),
        BasicType('float'),
    )

    if TYPE_CHECKING:
        u: float
        v: float
        def __init__(self, *, u: float = ..., v: float = ...) -> None: ...
    else:
        __slots__ = ["_u", "_v"]

        def __init__(self, **fields: Any) -> None:
            self._u = 0.0
            self._v = 0.0
            if fields:
                set_fields(self, fields)


class MeshFile(Message):
    """Message visualization_msgs/msg/MeshFile."""

    ROS_TYPE = "visualization_msgs/msg/MeshFile"
    SLOT_TYPES = (
        UnboundedString(),
        UnboundedSequence(BasicType('uint8')),
    )

    if TYPE_CHECKING:
        filename: str
        data = NumberSequence[int]()
        def __init__(self, *, filename: str = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_filename", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._filename = ""
            self._data = array("B")
            if fields:
                set_fields(self, fields)


if TYPE_CHECKING or not follows("humble"):
    class Marker(Message):
        """A shape to draw."""

        ROS_TYPE = "visualization_msgs/msg/Marker"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            UnboundedString(),
            BasicType('int32'),
            BasicType('int32'),
            BasicType('int32'),
            NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
            NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
            NamespacedType(('std_msgs', 'msg'), 'ColorRGBA'),
            NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
            BasicType('boolean'),
            UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point')),
            UnboundedSequence(NamespacedType(('std_msgs', 'msg'), 'ColorRGBA')),
            UnboundedString(),
            NamespacedType(('sensor_msgs', 'msg'), 'CompressedImage'),
            UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'UVCoordinate')),
            UnboundedString(),
            UnboundedString(),
            NamespacedType(('visualization_msgs', 'msg'), 'MeshFile'),
            BasicType('boolean'),
        )
        ARROW: Final = 0
        CUBE: Final = 1
        SPHERE: Final = 2
        CYLINDER: Final = 3
        LINE_STRIP: Final = 4
        LINE_LIST: Final = 5
        CUBE_LIST: Final = 6
        SPHERE_LIST: Final = 7
        POINTS: Final = 8
        TEXT_VIEW_FACING: Final = 9
        MESH_RESOURCE: Final = 10
        TRIANGLE_LIST: Final = 11
        ARROW_STRIP: Final = 12
        ADD: Final = 0
        MODIFY: Final = 0
        DELETE: Final = 2
        DELETEALL: Final = 3

        if TYPE_CHECKING:
            header: Header
            ns: str
            id: int
            type: int
            action: int
            pose: Pose
            scale: Vector3
            color: ColorRGBA
            lifetime: Duration
            frame_locked: bool
            points: list[Point]
            colors: list[ColorRGBA]
            texture_resource: str
            texture: CompressedImage
            uv_coordinates: list[UVCoordinate]
            text: str
            mesh_resource: str
            mesh_file: MeshFile
            mesh_use_embedded_materials: bool
            def __init__(self, *, header: Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., pose: Pose = ..., scale: Vector3 = ..., color: ColorRGBA = ..., lifetime: Duration = ..., frame_locked: bool = ..., points: list[Point] = ..., colors: list[ColorRGBA] = ..., texture_resource: str = ..., texture: CompressedImage = ..., uv_coordinates: list[UVCoordinate] = ..., text: str = ..., mesh_resource: str = ..., mesh_file: MeshFile = ..., mesh_use_embedded_materials: bool = ...) -> None: ...
        else:
            __slots__ = ["_header", "_ns", "_id", "_type", "_action", "_pose", "_scale", "_color", "_lifetime", "_frame_locked", "_points", "_colors", "_texture_resource", "_texture", "_uv_coordinates", "_text", "_mesh_resource", "_mesh_file", "_mesh_use_embedded_materials"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._ns = ""
                self._id = 0
                self._type = 0
                self._action = 0
                self._pose = fields.get("pose") or Pose()
                self._scale = fields.get("scale") or Vector3()
                self._color = fields.get("color") or ColorRGBA()
                self._lifetime = fields.get("lifetime") or Duration()
                self._frame_locked = False
                self._points = []
                self._colors = []
                self._texture_resource = ""
                self._texture = fields.get("texture") or CompressedImage()
                self._uv_coordinates = []
                self._text = ""
                self._mesh_resource = ""
                self._mesh_file = fields.get("mesh_file") or MeshFile()
                self._mesh_use_embedded_materials = False
                if fields:
                    set_fields(self, fields)

else:
    class Marker(Message):
        """A shape to draw."""

        ROS_TYPE = "visualization_msgs/msg/Marker"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            UnboundedString(),
            BasicType('int32'),
            BasicType('int32'),
            BasicType('int32'),
            NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
            NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
            NamespacedType(('std_msgs', 'msg'), 'ColorRGBA'),
            NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
            BasicType('boolean'),
            UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point')),
            UnboundedSequence(NamespacedType(('std_msgs', 'msg'), 'ColorRGBA')),
            UnboundedString(),
            NamespacedType(('sensor_msgs', 'msg'), 'CompressedImage'),
            UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'UVCoordinate')),
            UnboundedString(),
            UnboundedString(),
            NamespacedType(('visualization_msgs', 'msg'), 'MeshFile'),
            BasicType('boolean'),
        )
        ARROW: Final = 0
        CUBE: Final = 1
        SPHERE: Final = 2
        CYLINDER: Final = 3
        LINE_STRIP: Final = 4
        LINE_LIST: Final = 5
        CUBE_LIST: Final = 6
        SPHERE_LIST: Final = 7
        POINTS: Final = 8
        TEXT_VIEW_FACING: Final = 9
        MESH_RESOURCE: Final = 10
        TRIANGLE_LIST: Final = 11
        ADD: Final = 0
        MODIFY: Final = 0
        DELETE: Final = 2
        DELETEALL: Final = 3

        if TYPE_CHECKING:
            header: Header
            ns: str
            id: int
            type: int
            action: int
            pose: Pose
            scale: Vector3
            color: ColorRGBA
            lifetime: Duration
            frame_locked: bool
            points: list[Point]
            colors: list[ColorRGBA]
            texture_resource: str
            texture: CompressedImage
            uv_coordinates: list[UVCoordinate]
            text: str
            mesh_resource: str
            mesh_file: MeshFile
            mesh_use_embedded_materials: bool
            def __init__(self, *, header: Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., pose: Pose = ..., scale: Vector3 = ..., color: ColorRGBA = ..., lifetime: Duration = ..., frame_locked: bool = ..., points: list[Point] = ..., colors: list[ColorRGBA] = ..., texture_resource: str = ..., texture: CompressedImage = ..., uv_coordinates: list[UVCoordinate] = ..., text: str = ..., mesh_resource: str = ..., mesh_file: MeshFile = ..., mesh_use_embedded_materials: bool = ...) -> None: ...
        else:
            __slots__ = ["_header", "_ns", "_id", "_type", "_action", "_pose", "_scale", "_color", "_lifetime", "_frame_locked", "_points", "_colors", "_texture_resource", "_texture", "_uv_coordinates", "_text", "_mesh_resource", "_mesh_file", "_mesh_use_embedded_materials"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._ns = ""
                self._id = 0
                self._type = 0
                self._action = 0
                self._pose = fields.get("pose") or Pose()
                self._scale = fields.get("scale") or Vector3()
                self._color = fields.get("color") or ColorRGBA()
                self._lifetime = fields.get("lifetime") or Duration()
                self._frame_locked = False
                self._points = []
                self._colors = []
                self._texture_resource = ""
                self._texture = fields.get("texture") or CompressedImage()
                self._uv_coordinates = []
                self._text = ""
                self._mesh_resource = ""
                self._mesh_file = fields.get("mesh_file") or MeshFile()
                self._mesh_use_embedded_materials = False
                if fields:
                    set_fields(self, fields)


class InteractiveMarkerControl(Message):
    """Message visualization_msgs/msg/InteractiveMarkerControl."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarkerControl"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
        BasicType('uint8'),
        BasicType('uint8'),
        BasicType('boolean'),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'Marker')),
        BasicType('boolean'),
        UnboundedString(),
    )
    INHERIT: Final = 0
    FIXED: Final = 1
    VIEW_FACING: Final = 2
    NONE: Final = 0
    MENU: Final = 1
    BUTTON: Final = 2
    MOVE_AXIS: Final = 3
    MOVE_PLANE: Final = 4
    ROTATE_AXIS: Final = 5
    MOVE_ROTATE: Final = 6
    MOVE_3D: Final = 7
    ROTATE_3D: Final = 8
    MOVE_ROTATE_3D: Final = 9

    if TYPE_CHECKING:
        name: str
        orientation: Quaternion
        orientation_mode: int
        interaction_mode: int
        always_visible: bool
        markers: list[Marker]
        independent_marker_orientation: bool
        description: str
        def __init__(self, *, name: str = ..., orientation: Quaternion = ..., orientation_mode: int = ..., interaction_mode: int = ..., always_visible: bool = ..., markers: list[Marker] = ..., independent_marker_orientation: bool = ..., description: str = ...) -> None: ...
    else:
        __slots__ = ["_name", "_orientation", "_orientation_mode", "_interaction_mode", "_always_visible", "_markers", "_independent_marker_orientation", "_description"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._orientation = fields.get("orientation") or Quaternion()
            self._orientation_mode = 0
            self._interaction_mode = 0
            self._always_visible = False
            self._markers = []
            self._independent_marker_orientation = False
            self._description = ""
            if fields:
                set_fields(self, fields)


class InteractiveMarker(Message):
    """Message visualization_msgs/msg/InteractiveMarker."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarker"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        UnboundedString(),
        UnboundedString(),
        BasicType('float'),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'MenuEntry')),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'InteractiveMarkerControl')),
    )

    if TYPE_CHECKING:
        header: Header
        pose: Pose
        name: str
        description: str
        scale: float
        menu_entries: list[MenuEntry]
        controls: list[InteractiveMarkerControl]
        def __init__(self, *, header: Header = ..., pose: Pose = ..., name: str = ..., description: str = ..., scale: float = ..., menu_entries: list[MenuEntry] = ..., controls: list[InteractiveMarkerControl] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_pose", "_name", "_description", "_scale", "_menu_entries", "_controls"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or Pose()
            self._name = ""
            self._description = ""
            self._scale = 0.0
            self._menu_entries = []
            self._controls = []
            if fields:
                set_fields(self, fields)


class InteractiveMarkerFeedback(Message):
    """Message visualization_msgs/msg/InteractiveMarkerFeedback."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarkerFeedback"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        UnboundedString(),
        UnboundedString(),
        BasicType('uint8'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        BasicType('uint32'),
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
        BasicType('boolean'),
    )
    KEEP_ALIVE: Final = 0
    POSE_UPDATE: Final = 1
    MENU_SELECT: Final = 2
    BUTTON_CLICK: Final = 3
    MOUSE_DOWN: Final = 4
    MOUSE_UP: Final = 5

    if TYPE_CHECKING:
        header: Header
        client_id: str
        marker_name: str
        control_name: str
        event_type: int
        pose: Pose
        menu_entry_id: int
        mouse_point: Point
        mouse_point_valid: bool
        def __init__(self, *, header: Header = ..., client_id: str = ..., marker_name: str = ..., control_name: str = ..., event_type: int = ..., pose: Pose = ..., menu_entry_id: int = ..., mouse_point: Point = ..., mouse_point_valid: bool = ...) -> None: ...
    else:
        __slots__ = ["_header", "_client_id", "_marker_name", "_control_name", "_event_type", "_pose", "_menu_entry_id", "_mouse_point", "_mouse_point_valid"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._client_id = ""
            self._marker_name = ""
            self._control_name = ""
            self._event_type = 0
            self._pose = fields.get("pose") or Pose()
            self._menu_entry_id = 0
            self._mouse_point = fields.get("mouse_point") or Point()
            self._mouse_point_valid = False
            if fields:
                set_fields(self, fields)


class InteractiveMarkerInit(Message):
    """Message visualization_msgs/msg/InteractiveMarkerInit."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarkerInit"
    SLOT_TYPES = (
        UnboundedString(),
        BasicType('uint64'),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'InteractiveMarker')),
    )

    if TYPE_CHECKING:
        server_id: str
        seq_num: int
        markers: list[InteractiveMarker]
        def __init__(self, *, server_id: str = ..., seq_num: int = ..., markers: list[InteractiveMarker] = ...) -> None: ...
    else:
        __slots__ = ["_server_id", "_seq_num", "_markers"]

        def __init__(self, **fields: Any) -> None:
            self._server_id = ""
            self._seq_num = 0
            self._markers = []
            if fields:
                set_fields(self, fields)


class InteractiveMarkerPose(Message):
    """Message visualization_msgs/msg/InteractiveMarkerPose."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarkerPose"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        header: Header
        pose: Pose
        name: str
        def __init__(self, *, header: Header = ..., pose: Pose = ..., name: str = ...) -> None: ...
    else:
        __slots__ = ["_header", "_pose", "_name"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or Pose()
            self._name = ""
            if fields:
                set_fields(self, fields)


class InteractiveMarkerUpdate(Message):
    """Message visualization_msgs/msg/InteractiveMarkerUpdate."""

    ROS_TYPE = "visualization_msgs/msg/InteractiveMarkerUpdate"
    SLOT_TYPES = (
        UnboundedString(),
        BasicType('uint64'),
        BasicType('uint8'),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'InteractiveMarker')),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'InteractiveMarkerPose')),
        UnboundedSequence(UnboundedString()),
    )
    KEEP_ALIVE: Final = 0
    UPDATE: Final = 1

    if TYPE_CHECKING:
        server_id: str
        seq_num: int
        type: int
        markers: list[InteractiveMarker]
        poses: list[InteractiveMarkerPose]
        erases: list[str]
        def __init__(self, *, server_id: str = ..., seq_num: int = ..., type: int = ..., markers: list[InteractiveMarker] = ..., poses: list[InteractiveMarkerPose] = ..., erases: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_server_id", "_seq_num", "_type", "_markers", "_poses", "_erases"]

        def __init__(self, **fields: Any) -> None:
            self._server_id = ""
            self._seq_num = 0
            self._type = 0
            self._markers = []
            self._poses = []
            self._erases = []
            if fields:
                set_fields(self, fields)


class MarkerArray(Message):
    """Shapes to draw."""

    ROS_TYPE = "visualization_msgs/msg/MarkerArray"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'Marker')),
    )

    if TYPE_CHECKING:
        markers: list[Marker]
        def __init__(self, *, markers: list[Marker] = ...) -> None: ...
    else:
        __slots__ = ["_markers"]

        def __init__(self, **fields: Any) -> None:
            self._markers = []
            if fields:
                set_fields(self, fields)
