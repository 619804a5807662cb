#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compile coframe-fastdds (middlewares/fastdds) into the project's virtual environment. It uses the headers of a sourced
# ROS 2, of Python packages, or of the system: middlewares/fastdds/CMakeLists.txt. Without any, this prints a line.
#
#   install_fastdds.sh          install it, with the Python package of Fast DDS where there is one
#   install_fastdds.sh --again  only where it is installed: compile it again with the native core's present interface
set -eu
venv=${VENV:-.venv}
bin=$(cd "$venv/bin" && pwd)
pip() { "$bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
is_installed() { "$bin/python" -c "import importlib.metadata as m; m.distribution('coframe-fastdds')" 2>/dev/null; }

if [ "${1:-}" = --again ]; then
    is_installed || exit 0
else
    pip install --no-compile "ros-fastdds>=3.2,<3.3" >/dev/null 2>&1 || true # only for Linux on x86-64
fi
log=$venv/fastdds.log
PATH="$bin:$PATH" pip install --no-compile --no-build-isolation --no-deps --editable middlewares/fastdds >"$log" 2>&1 ||
    echo "coframe-fastdds was not compiled ($log), so its tests are skipped: it needs the headers of Fast DDS" >&2
