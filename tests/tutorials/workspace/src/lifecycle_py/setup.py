# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="lifecycle_py",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "talker = lifecycle_py.talker:main",
        ],
    },
)
