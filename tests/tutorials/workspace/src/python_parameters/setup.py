# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="python_parameters",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "minimal_param_node = python_parameters.node:main",
        ],
    },
)
