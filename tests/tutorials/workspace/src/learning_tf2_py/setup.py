# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="learning_tf2_py",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "turtle_tf2_broadcaster = learning_tf2_py.broadcaster:main",
            "turtle_tf2_listener = learning_tf2_py.listener:main",
            "static_turtle_tf2_broadcaster = learning_tf2_py.static_broadcaster:main",
        ],
    },
)
