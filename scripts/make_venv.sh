#!/bin/sh
# Makes the project's virtual environment and builds the project into it. Needs a Python 3.10+ with its headers, a
# C++ compiler and a package index; what Debian splits off (python3-venv, python3-dev) is installed where that is
# possible without asking for a password, and asked for where it is not.
set -eu
venv=${VENV:-.venv}

usable() { # a Python that can make a virtual environment and build for itself
    "$1" - 2>/dev/null <<'PYTHON'
import ensurepip, os, sys, sysconfig, venv
ok = (3, 10) <= sys.version_info < (3, 15) and os.path.exists(sysconfig.get_path("include") + "/Python.h")
sys.exit(not ok)
PYTHON
}

find_python() { # 3.14 last: cyclonedds has no wheels for it yet
    for name in ${PYTHON:-python3 python3.13 python3.12 python3.11 python3.10 /usr/bin/python3 python3.14}; do
        if command -v "$name" >/dev/null 2>&1 && usable "$name"; then
            echo "$name"
            return
        fi
    done
}

install_with_apt() {
    if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then return; fi
    echo "setup: apt-get install $*" >&2
    { apt-get update -qq && apt-get install -y -qq "$@"; } >/dev/null 2>&1 || true
}

python=$(find_python)
if [ -z "$python" ]; then
    install_with_apt python3-venv python3-dev
    python=$(find_python)
fi
if [ -z "$python" ]; then
    echo "setup: no Python 3.10 or newer with venv and headers here." >&2
    echo "       On Debian or Ubuntu: sudo apt-get install python3-venv python3-dev" >&2
    exit 1
fi
if ! command -v "${CXX:-c++}" >/dev/null 2>&1; then
    install_with_apt g++
fi
if ! command -v "${CXX:-c++}" >/dev/null 2>&1; then
    echo "setup: no C++ compiler. On Debian or Ubuntu: sudo apt-get install g++" >&2
    exit 1
fi

if [ ! -x "$venv/bin/python" ]; then
    echo "setup: $venv with $("$python" --version)" >&2
    "$python" -m venv "$venv"
fi
pip() { "$venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
echo "setup: installing what building and testing need" >&2
pip install "scikit-build-core>=0.10,<2" "nanobind>=2.4,<4" "cmake>=3.24" "ninja>=1.11"
echo "setup: building coframe" >&2
pip install --no-build-isolation --editable ".[dev]"
