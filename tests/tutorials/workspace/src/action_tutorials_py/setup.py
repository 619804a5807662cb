# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="action_tutorials_py",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "fibonacci_action_server = action_tutorials_py.server:main",
            "fibonacci_action_client = action_tutorials_py.client:main",
        ],
    },
)
