# SPDX-License-Identifier: Apache-2.0
"""Reads a file of a package, and lists packages and plugins."""

import os

import yaml

from ament_index_python import get_resources
from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_packages_with_prefixes,
)
from ament_index_python.resources import get_resource

share = get_package_share_directory("arm_config")
with open(os.path.join(share, "config", "limits.yaml")) as file:
    print("limits", yaml.safe_load(file)["limits"])
print("installed", get_package_prefix("arm_plugins") == get_packages_with_prefixes()["arm_plugins"])
for name in get_resources("arm_plugins__pluginlib__plugin"):
    print("plugin", name, get_resource("arm_plugins__pluginlib__plugin", name)[0])
try:
    get_package_share_directory("no_such_package")
except PackageNotFoundError as error:
    print("missing", "no_such_package" in str(error))
