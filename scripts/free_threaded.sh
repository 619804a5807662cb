#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Build coframe for a CPython without the GIL, run the tests with it, and measure how lookups scale over two threads.
#
#   scripts/free_threaded.sh                        build CPython 3.13 from Debian's source package first, if it is needed
#   scripts/free_threaded.sh /path/to/python3.14t   use this one
#
# Everything is written to build/free_threaded. Building CPython takes five minutes; it needs Debian's apt, a C compiler and
# the libraries' headers (libssl-dev, libffi-dev, zlib1g-dev, ...). TESTS="tests/core" selects tests.
set -eu
cd "$(dirname "$0")/.."
work=$PWD/build/free_threaded
suite=sid # Debian's source package of this suite; its binary packages have the GIL
mkdir -p "$work"

fail() { echo "free-threaded: $1" >&2; exit 1; }

build_python() { # from the upstream archive in Debian's source package; apt checks its hash and the archive's signature
    command -v apt-get >/dev/null || fail "there is no apt-get: name a CPython without the GIL"
    mkdir -p "$work/apt/lists/partial" "$work/apt/cache" "$work/source" "$work/python-source"
    mirror=${DEBIAN_MIRROR:-$(sed -n 's/^URIs: *//p; s/^deb \([^[ ][^ ]*\).*/\1/p' /etc/apt/sources.list.d/debian.sources \
        /etc/apt/sources.list 2>/dev/null | head -n 1)}
    [ -n "$mirror" ] || fail "no mirror of Debian is configured: set DEBIAN_MIRROR"
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" >"$work/apt/sources.list"
    cat >"$work/apt/apt.conf" <<CONF
Dir::Etc::sourcelist "$work/apt/sources.list";
Dir::Etc::sourceparts "-";
Dir::State::lists "$work/apt/lists";
Dir::Cache "$work/apt/cache";
APT::Sandbox::User "$(id -un)";
CONF
    export APT_CONFIG="$work/apt/apt.conf"
    apt-get update -qq
    # The index can name versions that the mirror does not have: the first one that can be downloaded is taken.
    for version in $(apt-cache showsrc python3.13 | sed -n 's/^Version: *//p' | sort -rV); do
        (cd "$work/source" && apt-get source -qq --download-only "python3.13=$version" 2>/dev/null) && break
    done
    unset APT_CONFIG
    archive=$(ls -t "$work"/source/python3.13_*.orig.tar.xz 2>/dev/null | head -n 1)
    [ -n "$archive" ] || fail "the mirror $mirror has no source package python3.13: name a CPython without the GIL"
    echo "free-threaded: building ${archive##*/} without the GIL" >&2
    tar -xf "$archive" -C "$work/python-source" --strip-components=1
    cd "$work/python-source"
    ./configure --quiet --prefix="$work/python" --disable-gil --disable-test-modules >"$work/python.log" 2>&1 &&
        make -s -j"$(nproc)" >>"$work/python.log" 2>&1 && make -s install >>"$work/python.log" 2>&1 ||
        { tail "$work/python.log" >&2; fail "CPython could not be built; the whole output is in $work/python.log"; }
    cd - >/dev/null
}

python=${1:-$work/python/bin/python3.13t}
[ $# -gt 0 ] || [ -x "$python" ] || build_python
"$python" -c 'import sys; sys.exit(sys._is_gil_enabled())' 2>/dev/null || fail "$python is not a CPython without the GIL"

bin=$work/venv/bin
[ -x "$bin/python" ] || "$python" -m venv "$work/venv"
pip() { "$bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
requirements() { # KEY...: one per line, from pyproject.toml
    "$bin/python" - "$@" <<'PYTHON'
import sys, tomllib
with open("pyproject.toml", "rb") as file:
    known = tomllib.load(file)
extras = known["project"]["optional-dependencies"]
for key in sys.argv[1:]:
    names = {"dev": ("pytest", "hypothesis", "scipy", "ninja", "transforms3d"), "judges": ("rosbags", "mcap")}
    found = known["build-system"]["requires"] if key == "build" else extras["dev" if key == "judges" else key]
    print(*(each for each in found if each.startswith(names.get(key, ("",)))), sep="\n")
PYTHON
}
requirements build dev >"$work/requirements.txt"
pip install --only-binary :all: -r "$work/requirements.txt" "numpy>=1.24,<3"
requirements bags viewer robots cli params parquet protobuf pdf plot judges | sort -u | while read -r requirement; do
    # apsw, which rosbags requires, downloads SQLite's source when it is compiled.
    pip install --only-binary apsw,matplotlib,pyarrow "$requirement" >/dev/null 2>&1 ||
        echo "free-threaded: $requirement cannot be installed for this Python; what needs it is skipped"
done
PATH="$(cd "$bin" && pwd):$PATH" pip install --no-build-isolation --no-deps --editable .

export PYTHON_GIL=0
ignored=
"$bin/python" -c "import rosbags.highlevel" 2>/dev/null || ignored="--ignore tests/core/test_recordings.py"
# shellcheck disable=SC2086  # several words
"$bin/python" -m pytest -q -p no:cacheprovider --numprocesses 2 --dist loadfile $ignored \
    ${TESTS:-tests/core tests/tf2 tests/cli}
"$bin/python" -m benchmarks.threads
