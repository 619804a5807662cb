# SPDX-License-Identifier: Apache-2.0
"""The properties of RViz's displays and views with their defaults, as RViz 2 writes them to .rviz files.

An option that the viewer does not have is reported only if its value differs from the default: RViz writes all of them.
"""

from __future__ import annotations

from typing import Any

__all__ = ["DISPLAY_DEFAULTS", "VIEW_DEFAULTS", "differs_from_default"]

_POINTS: dict[str, Any] = {
    "Alpha": 1,
    "Autocompute Intensity Bounds": True,
    "Autocompute Value Bounds/Max Value": 10,
    "Autocompute Value Bounds/Min Value": -10,
    "Autocompute Value Bounds/Value": True,
    "Axis": "Z",
    "Channel Name": "intensity",
    "Color": "255; 255; 255",
    "Color Transformer": "",
    "Decay Time": 0,
    "Invert Rainbow": False,
    "Max Color": "255; 255; 255",
    "Max Intensity": 4096,
    "Min Color": "0; 0; 0",
    "Min Intensity": 0,
    "Position Transformer": "",
    "Selectable": True,
    "Size (Pixels)": 3,
    "Size (m)": 0.009999999776482582,
    "Style": "Flat Squares",
    "Use Fixed Frame": True,
    "Use rainbow": True,
}
_SCALAR: dict[str, Any] = {**_POINTS, "Autocompute Intensity Bounds": False}
_ARROW: dict[str, Any] = {
    "Alpha": 1,
    "Axes Length": 1,
    "Axes Radius": 0.10000000149011612,
    "Color": "255; 25; 0",
    "Head Length": 0.30000001192092896,
    "Head Radius": 0.10000000149011612,
    "Shaft Length": 1,
    "Shaft Radius": 0.05000000074505806,
}
_COVARIANCE: dict[str, Any] = {
    "Covariance/Orientation/Alpha": 0.5,
    "Covariance/Orientation/Color": "255; 255; 127",
    "Covariance/Orientation/Color Style": "Unique",
    "Covariance/Orientation/Frame": "Local",
    "Covariance/Orientation/Offset": 1,
    "Covariance/Orientation/Scale": 1,
    "Covariance/Orientation/Value": True,
    "Covariance/Position/Alpha": 0.30000001192092896,
    "Covariance/Position/Color": "204; 51; 204",
    "Covariance/Position/Scale": 1,
    "Covariance/Position/Value": True,
    "Covariance/Value": True,
}
_IMAGE: dict[str, Any] = {"Max Value": 1, "Median window": 5, "Min Value": 0, "Normalize Range": True}
_SCREW: dict[str, Any] = {
    "Alpha": 1,
    "Angular Arrow Scale": 2,
    "Angular Color": "204; 204; 51",
    "Arrow Width": 0.5,
    "Hide Small Values": True,
    "History Length": 1,
    "Linear Arrow Scale": 2,
    "Linear Color": "204; 51; 51",
}

DISPLAY_DEFAULTS: dict[str, dict[str, Any]] = {
    "AccelStamped": _SCREW,
    "Axes": {
        "Length": 1,
        "Radius": 0.10000000149011612,
        "Reference Frame": "<Fixed Frame>",
        "Show Trail": False,
        "Alpha": 1,
    },
    "Camera": {
        **_IMAGE,
        "Far Plane Distance": 100,
        "Image Rendering": "background and overlay",
        "Overlay Alpha": 0.5,
        "Zoom Factor": 1,
    },
    "CameraInfo": {
        "Alpha": 0.5,
        "Color": "85; 255; 255",
        "Edge color": "125; 125; 125",
        "Far clip": 1,
        "Not show side polygons": True,
        "Show edges": True,
        "Show polygons": True,
        "Use image topic": False,
    },
    "DepthCloud": {
        **_POINTS,
        "Auto Size/Auto Size Factor": 1,
        "Auto Size/Value": True,
        "Color Image Topic": "",
        "Color Transport Hint": "raw",
        "Depth Map Topic": "",
        "Depth Map Transport Hint": "raw",
        "Occlusion Compensation/Occlusion Time-Out": 30,
        "Occlusion Compensation/Value": False,
        "Topic Filter": True,
    },
    "Effort": {
        "Alpha": 1,
        "History Length": 1,
        "Robot Description": "robot_description",
        "Scale": 1,
        "TF Prefix": "",
        "Width": 0.019999999552965164,
        "All Enabled": True,
    },
    "FluidPressure": {**_SCALAR, "Channel Name": "fluid_pressure", "Max Intensity": 105000, "Min Intensity": 98000},
    "Grid": {
        "Alpha": 0.5,
        "Cell Size": 1,
        "Color": "160; 160; 164",
        "Line Style/Line Width": 0.029999999329447746,
        "Line Style/Value": "Lines",
        "Normal Cell Count": 0,
        "Offset/X": 0,
        "Offset/Y": 0,
        "Offset/Z": 0,
        "Plane": "XY",
        "Plane Cell Count": 10,
        "Reference Frame": "<Fixed Frame>",
    },
    "GridCells": {"Alpha": 1, "Color": "25; 255; 0"},
    "Illuminance": {**_SCALAR, "Channel Name": "illuminance", "Max Intensity": 1000},
    "Image": _IMAGE,
    "InteractiveMarkers": {
        "Enable Transparency": True,
        "Interactive Markers Namespace": "",
        "Show Axes": False,
        "Show Descriptions": True,
        "Show Visual Aids": False,
    },
    "LaserScan": _POINTS,
    "Map": {
        "Alpha": 0.699999988079071,
        "Binary representation": False,
        "Binary threshold": 100,
        "Color Scheme": "map",
        "Draw Behind": False,
        "Use Timestamp": False,
    },
    "Marker": {},
    "MarkerArray": {},
    "Odometry": {
        "Angle Tolerance": 0.10000000149011612,
        **_COVARIANCE,
        "Keep": 100,
        "Position Tolerance": 0.10000000149011612,
        **{f"Shape/{key}": value for key, value in _ARROW.items()},
        "Shape/Value": "Arrow",
    },
    "Path": {
        "Alpha": 1,
        "Buffer Length": 1,
        "Color": "25; 255; 0",
        "Head Diameter": 0.30000001192092896,
        "Head Length": 0.20000000298023224,
        "Length": 0.30000001192092896,
        "Line Style": "Lines",
        "Line Width": 0.029999999329447746,
        "Offset/X": 0,
        "Offset/Y": 0,
        "Offset/Z": 0,
        "Pose Color": "255; 85; 255",
        "Pose Style": "None",
        "Radius": 0.029999999329447746,
        "Shaft Diameter": 0.10000000149011612,
        "Shaft Length": 0.10000000149011612,
    },
    "PointCloud": _POINTS,
    "PointCloud2": _POINTS,
    "PointStamped": {"Alpha": 1, "Color": "204; 41; 204", "History Length": 1, "Radius": 0.20000000298023224},
    "Polygon": {"Alpha": 1, "Color": "25; 255; 0"},
    "Pose": {**_ARROW, "Shape": "Arrow"},
    "PoseArray": {
        "Alpha": 1,
        "Arrow Length": 0.30000001192092896,
        "Axes Length": 0.30000001192092896,
        "Axes Radius": 0.009999999776482582,
        "Color": "255; 25; 0",
        "Head Length": 0.07000000029802322,
        "Head Radius": 0.029999999329447746,
        "Shaft Length": 0.23000000417232513,
        "Shaft Radius": 0.009999999776482582,
        "Shape": "Arrow (Flat)",
    },
    "PoseWithCovariance": {**_ARROW, **_COVARIANCE, "Shape": "Arrow"},
    "Range": {"Alpha": 0.5, "Buffer Length": 1, "Color": "255; 255; 255"},
    "RelativeHumidity": {**_SCALAR, "Channel Name": "relative_humidity", "Max Intensity": 1},
    "RobotModel": {
        "Alpha": 1,
        "Collision Enabled": False,
        "Description File": "",
        "Description Source": "Topic",
        "Mass Properties/Inertia": False,
        "Mass Properties/Mass": False,
        "TF Prefix": "",
        "Update Interval": 0,
        "Visual Enabled": True,
    },
    "TF": {
        "Filter (blacklist)": "",
        "Filter (whitelist)": "",
        "Frame Timeout": 15,
        "Marker Alpha": 1,
        "Marker Scale": 1,
        "Show Arrows": True,
        "Show Axes": True,
        "Show Names": False,
        "Update Interval": 0,
    },
    "Temperature": {**_SCALAR, "Channel Name": "temperature", "Max Intensity": 100},
    "TwistStamped": _SCREW,
    "Wrench": {
        "Accept NaN Values": False,
        "Alpha": 1,
        "Arrow Width": 0.5,
        "Force Arrow Scale": 2,
        "Force Color": "204; 51; 51",
        "History Length": 1,
        "Torque Arrow Scale": 2,
        "Torque Color": "204; 204; 51",
    },
}
"""The properties of each display, by their paths. The topic, its QoS, and what all displays have is missing."""

_STEREO: dict[str, Any] = {
    "Enable Stereo Rendering/Stereo Eye Separation": 0.05999999865889549,
    "Enable Stereo Rendering/Stereo Focal Distance": 1,
    "Enable Stereo Rendering/Swap Stereo Eyes": False,
    "Enable Stereo Rendering/Value": False,
    "Invert Z Axis": False,
    "Name": "Current View",
    "Near Clip Distance": 0.009999999776482582,
}
_ORBIT: dict[str, Any] = {
    **_STEREO,
    "Distance": 10,
    "Focal Point/X": 0,
    "Focal Point/Y": 0,
    "Focal Point/Z": 0,
    "Focal Shape Fixed Size": True,
    "Focal Shape Size": 0.05000000074505806,
    "Field of View": 0.7853981852531433,
    "Pitch": 0.785398006439209,
    "Target Frame": "<Fixed Frame>",
    "Yaw": 0.785398006439209,
}
_FPS: dict[str, Any] = {
    **_STEREO,
    "Field of View": 0.7853981852531433,
    "Pitch": 0.785398006439209,
    "Position/X": 5,
    "Position/Y": 5,
    "Position/Z": 10,
    "Roll": 0,
    "Target Frame": "<Fixed Frame>",
    "Yaw": 0.785398006439209,
}
VIEW_DEFAULTS: dict[str, dict[str, Any]] = {
    "FPS": _FPS,
    "FrameAligned": {**_FPS, "Point towards": "arbitrary", "Lock Camera": False},
    "Orbit": _ORBIT,
    "ThirdPersonFollower": _ORBIT,
    "TopDownOrtho": {**_STEREO, "Angle": 0, "Scale": 10, "Target Frame": "<Fixed Frame>", "X": 0, "Y": 0},
    "XYOrbit": _ORBIT,
}
"""The properties of each view, by their paths."""

_TOLERANCE = 1e-5  # RViz stores float32 and writes it with more digits.


def differs_from_default(defaults: dict[str, Any], path: str, value: Any) -> bool:
    """Return whether an option has another value than RViz's default.

    Args:
        defaults: The defaults of the display or the view, by paths.
        path: The path of the option.
        value: Its value in a file.
    """
    if path not in defaults:
        return value not in ("", None, False)
    default = defaults[path]
    if isinstance(value, int | float) and isinstance(default, int | float) and not isinstance(default, bool):
        return abs(value - default) > _TOLERANCE * max(1.0, abs(default))
    return bool(value != default)
