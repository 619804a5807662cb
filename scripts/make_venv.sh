#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Create the project's virtual environment and build the project into it.
#
#   make_venv.sh lint   the linters only, without compiling anything
#   make_venv.sh demo   what the demo needs: the core, DDS, the viewer, the command line, URDF
#   make_venv.sh dev    everything: the demo's packages, all other extras, tests and linters
#
# Requires Python 3.10 or newer with its headers, a C++ compiler and a package index. Debian's separate packages
# (python3-venv, python3-dev, g++) are installed when the script runs as root; otherwise it prints the command to run.
# So is the DDS library where the cyclonedds package has no wheels: on Python 3.14 and on Linux on ARM.
set -eu
purpose=${1:-dev}
venv=${VENV:-.venv}

usable() { # whether a Python can create a virtual environment and build extension modules
    "$1" - 2>/dev/null <<'PYTHON'
import ensurepip, os, sys, sysconfig, venv
ok = (3, 10) <= sys.version_info < (3, 15) and os.path.exists(sysconfig.get_path("include") + "/Python.h")
sys.exit(not ok)
PYTHON
}

find_python() { # 3.14 comes last because it needs the DDS library of the system: cyclonedds has no wheels for it yet
    for name in ${PYTHON:-python3 python3.13 python3.12 python3.11 python3.10 /usr/bin/python3 python3.14}; do
        if command -v "$name" >/dev/null 2>&1 && usable "$name"; then
            command -v "$name"  # an absolute path, because PATH changes below
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
    echo "setup: found no Python 3.10 or newer with the venv module and C headers." >&2
    echo "       On Debian or Ubuntu: sudo apt-get install python3-venv python3-dev" >&2
    exit 1
fi
if [ "$purpose" != lint ] && ! command -v "${CXX:-c++}" >/dev/null 2>&1; then
    install_with_apt g++
fi
if [ "$purpose" != lint ] && ! command -v "${CXX:-c++}" >/dev/null 2>&1; then
    echo "setup: found no C++ compiler. On Debian or Ubuntu: sudo apt-get install g++" >&2
    exit 1
fi

has_pip() { "$1" -c "import pip" >/dev/null 2>&1; }

if [ ! -x "$venv/bin/python" ]; then
    echo "setup: creating $venv with $("$python" --version)" >&2
    # Copying pip into the environment takes five seconds of processor time; a recent pip can install from outside.
    if [ "$purpose" = demo ] && "$python" -m pip --help 2>/dev/null | grep -q -e "--python"; then
        "$python" -m venv --without-pip "$venv"
    else
        "$python" -m venv "$venv"
    fi
fi
if [ "$purpose" != demo ] && ! has_pip "$venv/bin/python"; then
    "$venv/bin/python" -m ensurepip --default-pip >/dev/null
fi
if has_pip "$venv/bin/python"; then
    run_pip() { "$venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
else
    run_pip() { "$python" -m pip --python "$venv/bin/python" --quiet --disable-pip-version-check "$@"; }
fi

# pip repeats its error for each attempt, and a missing network looks like a missing version: print one sentence instead.
unreachable="NewConnectionError|ConnectTimeout|NameResolutionError|ReadTimeout|ProxyError|Network is unreachable"
unreachable="$unreachable|SSLError|Failed to establish a new connection|Temporary failure in name resolution"
pip() {
    messages=$(mktemp)
    if run_pip "$@" 2>"$messages"; then
        cat "$messages" >&2
        rm "$messages"
        return
    fi
    if grep -q -E "$unreachable" "$messages"; then
        index=$("$python" -m pip config get global.index-url 2>/dev/null || echo https://pypi.org/simple)
        index=$(echo "${PIP_INDEX_URL:-$index}" | sed 's|://[^/@]*@|://|')
        echo "setup: cannot download Python packages because the package index $index cannot be reached; connect to the network, or set PIP_INDEX_URL to an index that can be reached." >&2
    else
        cat "$messages" >&2
    fi
    rm "$messages"
    exit 1
}

if [ "$purpose" = lint ]; then
    echo "setup: installing the linters" >&2
    # shellcheck disable=SC2046  # one word for each requirement of the extra dev in pyproject.toml
    pip install $(sed -n 's/^ *"\(\(ruff\|clang-format\|import-linter\)[^" ]*\)".*/\1/p' pyproject.toml)
    exit 0
fi

recent_cmake() {
    command -v cmake >/dev/null 2>&1 &&
        cmake --version | awk 'NR == 1 { split($3, v, "."); exit !(v[1] > 3 || (v[1] == 3 && v[2] >= 18)) }'
}

tools="scikit-build-core>=0.10,<2 nanobind>=2.4,<4 setuptools-scm>=8.1,<11 hatch-fancy-pypi-readme>=25.1,<26 ninja>=1.11"
recent_cmake || tools="$tools cmake>=3.24"
case $purpose in
    demo) extras="dds,viewer,robots,cli" ;;
    dev) extras="dev" ;;
    *) echo "setup: unknown purpose '$purpose': use lint, demo or dev" >&2; exit 2 ;;
esac
echo "setup: installing packages for $purpose, then compiling coframe" >&2
# Python compiles each module when it is first imported, so pip need not compile all of them now.
# shellcheck disable=SC2086  # the list of tools is meant to be split
pip install --no-compile $tools
PATH="$(cd "$venv/bin" && pwd):$PATH" pip install --no-compile --no-build-isolation --editable ".[$extras]"

has_dds() { "$venv/bin/python" -c "from coframe.wire.dds import library; library.check()" >/dev/null 2>&1; }

if ! has_dds; then
    install_with_apt libddsc0t64  # the name since Debian 13 and Ubuntu 24.04
    has_dds || install_with_apt libddsc0debian
fi
if ! has_dds; then
    echo "setup: found no DDS library (libddsc), which the ROS graph requires. All other features work without it." >&2
    "$venv/bin/python" -c "from coframe.wire.dds import library; print('       ' + library.how_to_get_one())" >&2
fi

if [ "$purpose" = dev ]; then
    VENV=$venv sh scripts/install_fastdds.sh
fi
