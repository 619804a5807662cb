#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Install the wheels of dist/ in an empty Debian 12 without a network, and run the installed-package tests there.
#
#   scripts/test_in_root.sh                         with the Python of Debian 12
#   scripts/test_in_root.sh /path/to/python3.13 ... with these as well; their prefixes are mounted into the root
#
# Needs root rights, debootstrap and unshare. For each Python, prints the seconds of `pip install coframe[all]` and the
# megabytes of everything that it installed. Build the wheels first: make wheels
set -eu
cd "$(dirname "$0")/.."
project=$PWD
work=$project/build/root
root=$work/bookworm

skip() { echo "test-root: skipped: $1"; exit 0; }
[ "$(id -u)" = 0 ] || skip "it needs root rights for chroot"
command -v debootstrap >/dev/null || skip "debootstrap is not installed (apt-get install debootstrap)"
unshare --mount --net true 2>/dev/null || skip "mounts and networks cannot be separated here (unshare)"
ls dist/coframe-*.whl >/dev/null 2>&1 || { echo "test-root: there is no wheel in dist/. Run: make wheels" >&2; exit 1; }

if [ ! -e "$root/.complete" ]; then
    rm -rf "$root"
    mkdir -p "$root"
    # The libraries after python3-venv are those that other Pythons link to.
    debootstrap --variant=minbase --include=python3-venv,libssl3,libffi8,libsqlite3-0,libbz2-1.0,liblzma5,zlib1g \
        bookworm "$root" "${DEBIAN_MIRROR:-}" >"$work/debootstrap.log" 2>&1 ||
        { tail "$work/debootstrap.log"; skip "debootstrap could not fetch Debian 12"; }
    touch "$root/.complete"
fi

inside='
set -eu
python=$1
rm -rf /tmp/environment
"$python" -m venv /tmp/environment
cd /tmp
export PIP_NO_INDEX=1 PIP_FIND_LINKS=/wheels PIP_DISABLE_PIP_VERSION_CHECK=1
before=$(du -sk /tmp/environment | cut -f1)
start=$(date +%s)
environment/bin/python -m pip install --quiet "coframe[all]"
seconds=$(($(date +%s) - start))
after=$(du -sk /tmp/environment | cut -f1)
environment/bin/python -c "import rclpy, tf2_ros"
version=$(environment/bin/python -c "import platform; print(platform.python_version())")
echo "CPython $version: pip install coframe[all] took $seconds s, $(((after - before) / 1000)) MB"
environment/bin/python -m pip install --quiet pytest pytest-timeout
environment/bin/python -m pytest -q -rs -p no:cacheprovider -c /project/pyproject.toml /project/tests/installed
'

status=0
for python in /usr/bin/python3 "$@"; do
    if [ "$python" = /usr/bin/python3 ]; then
        version=3.11
        prefix=
    else
        version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        prefix=$("$python" -c 'import sys; print(sys.base_prefix)')
        python=$("$python" -c 'import sys; print(sys.executable)')
    fi
    tag=cp$(echo "$version" | tr -d .)
    wheel=$(ls dist/coframe-*-"$tag"-"$tag"-*.whl 2>/dev/null | head -n 1)
    [ -n "$wheel" ] || { echo "test-root: no wheel for CPython $version in dist/"; status=1; continue; }
    wheels=$work/wheels-$tag
    mkdir -p "$wheels"
    rm -f "$wheels"/coframe-*.whl
    # Everything is downloaded outside, for that version of Python.
    "${VENV:-.venv}/bin/python" -m pip download --quiet --only-binary :all: --python-version "$version" \
        --dest "$wheels" "$wheel[all]" "pytest>=8,<10" "pytest-timeout>=2.3,<3"
    unshare --mount --net sh -c '
        root=$1 wheels=$2 project=$3 prefix=$4 python=$5 inside=$6
        ip link set lo up 2>/dev/null || true
        mkdir -p "$root/wheels" "$root/project" "$root$prefix"
        mount --bind "$wheels" "$root/wheels"
        mount --bind "$project" "$root/project"
        [ -z "$prefix" ] || mount --bind "$prefix" "$root$prefix"
        mount -t proc proc "$root/proc"
        chroot "$root" env -i PATH=/usr/bin:/bin HOME=/root LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1 \
            sh -c "$inside" inside "$python"
    ' unshared "$root" "$wheels" "$project" "$prefix" "$python" "$inside" || status=1
done
exit $status
