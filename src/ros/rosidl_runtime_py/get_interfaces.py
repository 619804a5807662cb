# SPDX-License-Identifier: Apache-2.0
"""Names of the interfaces of coframe, of the user's packages and of a sourced workspace."""

from collections.abc import Iterable

from coframe.interfaces.sources import package_folders, sources
from coframe.messages.packages import InterfacePackage, find_package, shipped_names

__all__ = [
    "get_action_interfaces",
    "get_all_interface_packages",
    "get_interface_packages",
    "get_interface_path",
    "get_interfaces",
    "get_message_interfaces",
    "get_service_interfaces",
]

_KINDS = ("msg", "srv", "action")


def get_all_interface_packages() -> list[str]:
    """Return the names of all packages that have interfaces."""
    return sorted({*shipped_names(), *(name for source in sources() for name in package_folders(source))})


def get_interface_packages(package_names: Iterable[str] = ()) -> list[str]:
    """Return the given packages that have interfaces, by default all of them."""
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
    packages = {name: find_package(name) for name in package_names or get_all_interface_packages()}
    missing = sorted(name for name, package in packages.items() if package is None)
    if missing:
        raise LookupError(f"Could not find package(s) with interfaces: {', '.join(missing)}")
    return {name: _interfaces(package) for name, package in packages.items() if package is not None}


def get_message_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the messages of packages. Arguments and result are the same as for `get_interfaces`."""
    return _of_kind("msg", package_names)


def get_service_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the services of packages. Arguments and result are the same as for `get_interfaces`."""
    return _of_kind("srv", package_names)


def get_action_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """Return the actions of packages. Arguments and result are the same as for `get_interfaces`."""
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
    package = find_package(parts[0])
    if package is None:
        raise LookupError(f"Unknown package '{parts[0]}'. See all packages with `coframe interface packages`.")
    if package.folder is None:
        raise LookupError(
            f"The package '{parts[0]}' is part of coframe, which has no files of its interfaces. See the definition "
            f"with `coframe interface show {interface_name}`."
        )
    path = package.folder.joinpath(*parts[1:])
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


def _interfaces(package: InterfacePackage) -> list[str]:
    return sorted(f"{kind}/{name}" for kind in package.kinds() for name in package.names(kind))
