# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="urdf_tutorial_py",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "state_publisher = urdf_tutorial_py.state_publisher:main",
        ],
    },
)
