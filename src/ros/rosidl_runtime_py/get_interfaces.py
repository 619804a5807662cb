# SPDX-License-Identifier: Apache-2.0
"""Names of the interfaces that exist: those of coframe and those in the ament index (`AMENT_PREFIX_PATH`)."""

import importlib
from collections.abc import Iterable
from pathlib import Path

from ament_index_python import PackageNotFoundError, get_package_share_directory, get_resources
from ament_index_python.resources import get_resource
from coframe.ros_side import ros_folder

__all__ = [
    "get_action_interfaces",
    "get_all_interface_packages",
    "get_interface_packages",
    "get_interface_path",
    "get_interfaces",
    "get_message_interfaces",
    "get_service_interfaces",
]

_RESOURCE = "rosidl_interfaces"
_KINDS = ("msg", "srv", "action")
_SUFFIXES = (".msg", ".srv", ".action", ".idl")


def get_all_interface_packages() -> list[str]:
    """Return the names of all packages that have interfaces."""
    return sorted({*_coframes_packages(), *get_resources(_RESOURCE)})


def get_interface_packages(package_names: Iterable[str] = ()) -> list[str]:
    """Return those of the packages that have interfaces, by default all of them."""
    wanted = set(package_names)
    return [package for package in get_all_interface_packages() if not wanted or package in wanted]


def get_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the interfaces of packages.

    Args:
        package_names: Names of packages. Empty: all packages.

    Returns:
        Names such as `msg/String`, sorted, by the name of the package.

    Raises:
        LookupError: A package does not exist or has no interfaces.
    """
    wanted = list(package_names)
    known = get_all_interface_packages()
    missing = sorted(set(wanted) - set(known))
    if missing:
        raise LookupError(f"Could not find package(s) with interfaces: {', '.join(missing)}")
    return {package: _interfaces(package) for package in (wanted or known)}


def get_message_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the messages of packages. Arguments and result are those of `get_interfaces`."""
    return _of_kind("msg", package_names)


def get_service_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the services of packages. Arguments and result are those of `get_interfaces`."""
    return _of_kind("srv", package_names)


def get_action_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the actions of packages. Arguments and result are those of `get_interfaces`."""
    return _of_kind("action", package_names)


def get_interface_path(interface_name: str) -> str:
    """Return the path of the file that defines an interface.

    Args:
        interface_name: Name such as `std_msgs/msg/String`, with or without the suffix of a file.

    Raises:
        ValueError: The name does not have the parts of an interface.
        LookupError: The package was not found, or it does not contain the file.
    """
    parts = interface_name.split("/")
    if len(parts) < 2 or not all(parts):
        raise ValueError(
            f"Invalid name '{interface_name}'. Expected at least two parts separated by '/', such as "
            "'std_msgs/msg/String'."
        )
    try:
        path = Path(get_package_share_directory(parts[0]), *parts[1:])
    except PackageNotFoundError:
        raise LookupError(
            f"Unknown package '{parts[0]}': no folder in AMENT_PREFIX_PATH and COFRAME_PACKAGE_PATH contains it."
        ) from None
    if not path.suffix:
        path = path.with_suffix(f".{parts[-2] if parts[-2] in _KINDS else 'msg'}")
    if not path.is_file():
        raise LookupError(f"Could not find the interface '{interface_name}': there is no file {path}.")
    return str(path)


def _of_kind(kind: str, package_names: Iterable[str]) -> dict[str, list[str]]:
    found = {
        package: [name for name in names if name.startswith(f"{kind}/")]
        for package, names in get_interfaces(package_names).items()
    }
    return {package: names for package, names in found.items() if names}


def _coframes_packages() -> list[str]:
    folders = [folder for folder in ros_folder().iterdir() if any((folder / kind).is_dir() for kind in _KINDS)]
    return [folder.name for folder in folders if folder.name != "rclpy"]  # rclpy.action has no interfaces.


def _interfaces(package: str) -> list[str]:
    if package in get_resources(_RESOURCE):
        content, _ = get_resource(_RESOURCE, package)
        files = [Path(line) for line in content.splitlines()]
        names = {file.with_suffix("").as_posix() for file in files if file.suffix in _SUFFIXES}
    else:
        kinds = [kind for kind in _KINDS if (ros_folder() / package / kind).is_dir()]
        names = {f"{kind}/{name}" for kind in kinds for name in importlib.import_module(f"{package}.{kind}").__all__}
    return sorted(name for name in names if "_" not in name)  # Parts of services and actions have an underscore.
