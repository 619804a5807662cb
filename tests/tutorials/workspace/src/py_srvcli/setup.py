# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

setup(
    name="py_srvcli",
    version="0.0.0",
    packages=find_packages(),
    entry_points={
        "console_scripts": [
            "service = py_srvcli.service:main",
            "client = py_srvcli.client:main",
        ],
    },
)
