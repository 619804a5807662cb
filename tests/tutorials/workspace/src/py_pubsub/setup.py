# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="py_pubsub",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "talker = py_pubsub.publisher:main",
            "listener = py_pubsub.subscriber:main",
        ],
    },
)
