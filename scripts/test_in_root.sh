#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Install coframe in an empty Debian without a network, and run the installed-package tests there.
#
#   scripts/test_in_root.sh                         the wheel in dist/ for the Python of Debian 12
#   scripts/test_in_root.sh /path/to/python3.13 ... for these as well; their prefixes are mounted into the root
#   scripts/test_in_root.sh --sdist                 a wheel that the root compiles from the source distribution in dist/
#   scripts/test_in_root.sh --sdist --suite sid --bundle build/cyclonedds
#
# --suite is a release of Debian; its Python may be one that this machine does not have. With --sdist, Debian's libddsc is
# installed as well, and the nodes of the lab run in the root and find those of this checkout, and the reverse. --bundle is
# a folder made by scripts/build_cyclonedds.sh: the wheel then contains this library, and both libraries are tested.
#
# Needs root rights, debootstrap and unshare. Prints the seconds of each compilation, and the seconds and megabytes of
# `pip install` for NumPy, coframe and coframe[all], whose size has a limit. Fill dist/ first: make wheels sdist
set -eu
cd "$(dirname "$0")/.."
project=$PWD
work=$project/build/root
host=$(cd "$(dirname "${VENV:-.venv}")" && pwd)/$(basename "${VENV:-.venv}")/bin/python
suite=bookworm sdist="" bundle="" prefix=""
while [ $# -gt 0 ]; do
    case $1 in
        --sdist) sdist=yes ;;
        --suite) suite=$2; shift ;;
        --bundle) bundle=$(cd "$2" && pwd); shift ;;
        -*) sed -n '3,15s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
        *) break ;;
    esac
    shift
done
root=$work/$suite${sdist:+-compiler}

skip() { echo "test-root: skipped: $1"; exit 0; }
fail() { echo "test-root: $1" >&2; exit 1; }
[ "$(id -u)" = 0 ] || skip "it needs root rights for chroot"
command -v debootstrap >/dev/null || skip "debootstrap is not installed (apt-get install debootstrap)"
unshare --mount --net true 2>/dev/null || skip "mounts and networks cannot be separated here (unshare)"
[ -n "$sdist" ] || ls dist/coframe-*.whl >/dev/null 2>&1 || fail "there is no wheel in dist/. Run: make wheels"
[ -z "$sdist" ] || ls dist/coframe-*.tar.gz >/dev/null 2>&1 || fail "there is no source distribution in dist/. Run: make sdist"

if [ ! -e "$root/.complete" ]; then
    rm -rf "$root"
    mkdir -p "$root"
    case $sdist-$suite in
        # The libraries after python3-venv are those that other Pythons link to.
        -*) packages=python3-venv,libssl3,libffi8,libsqlite3-0,libbz2-1.0,liblzma5,zlib1g ;;
        yes-bookworm) packages=python3-venv,python3-dev,g++,libddsc0debian ;;
        *) packages=python3-venv,python3-dev,g++,libddsc0t64 ;;
    esac
    debootstrap --variant=minbase --include="$packages" "$suite" "$root" "${DEBIAN_MIRROR:-}" >"$work/debootstrap.log" 2>&1 ||
        { tail "$work/debootstrap.log"; skip "debootstrap could not fetch Debian $suite"; }
    touch "$root/.complete"
fi

download() { # VERSION FOLDER PACKAGE...: packages for that version of Python, outside of the root
    version=$1 folder=$2
    shift 2
    if [ -n "$prefix" ]; then # this Python is outside of the root as well: it selects what is needed for its version only
        "$host" -m pip --python "$python" download --quiet --only-binary :all: --dest "$folder" "$@"
    else
        "$host" -m pip download --quiet --only-binary :all: --python-version "$version" --dest "$folder" "$@"
    fi
}

needed() { # VERSION WHEEL: what the tests in the root install
    case $1 in
        # pip evaluates markers for the Python that it runs on; this is `all` for 3.14.
        3.14) echo "$2[bags,viewer,robots,cli,params,pdf]" ;;
        *) echo "$2[all]" ;;
    esac
    echo "pytest>=8,<10" "pytest-timeout>=2.3,<3"
}

# in_root FOLDER PREFIX SCRIPT ARGUMENT...: run a script in the root with FOLDER as /wheels, and PREFIX mounted. AFTER is
# a command that runs outside of the root in the same network.
in_root() {
    unshare --mount --net sh -c '
        root=$1 project=$2 wheels=$3 prefix=$4 bundle=$5 script=$6
        shift 6
        ip link set lo up multicast on 2>/dev/null || true
        mkdir -p "$root/wheels" "$root/project" "$root/bundle" "$root$prefix"
        mount --bind "$wheels" "$root/wheels"
        mount --bind "$project" "$root/project"
        [ -z "$prefix" ] || mount --bind "$prefix" "$root$prefix"
        [ -z "$bundle" ] || mount --bind "$bundle" "$root/bundle"
        mount -t proc proc "$root/proc"
        chroot "$root" env -i PATH=/usr/bin:/bin HOME=/root LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1 \
            PIP_NO_INDEX=1 PIP_FIND_LINKS=/wheels PIP_DISABLE_PIP_VERSION_CHECK=1 ${bundle:+COFRAME_BUNDLE=/bundle} \
            sh -c "$script" inside "$@" || exit
        eval "${AFTER:-}"
    ' unshared "$root" "$project" "$1" "$2" "$bundle" "$3" "$4"
}

compile='
set -eu
rm -rf /tmp/compiled /tmp/environment
python3 -m venv /tmp/environment
start=$(date +%s)
/tmp/environment/bin/python -m pip wheel --quiet --no-deps --wheel-dir /tmp/compiled "$1"
echo "$(/tmp/environment/bin/python --version): compiled ${1##*/} in $(($(date +%s) - start)) s"
'
install='
set -eu
python=$1
rm -rf /tmp/environment
"$python" -m venv /tmp/environment
cd /tmp
size() { du -sb environment | cut -f1; }
time_install() { start=$(date +%s); environment/bin/python -m pip install --quiet "$1"; seconds=$(($(date +%s) - start)); }
version=$(environment/bin/python -c "import platform; print(platform.python_version())")
before=$(size)
time_install numpy
numpy=$(($(size) - before))
echo "CPython $version: pip install numpy: $seconds s, $((numpy / 1000000)) MB"
time_install coframe
core=$(($(size) - before - numpy))
echo "CPython $version: pip install coframe: $seconds s, $((core / 1000)) kB more"
time_install "coframe[all]"
all=$(($(size) - before - numpy))
echo "CPython $version: pip install coframe[all]: $seconds s more, $((all / 1000000)) MB more than NumPy"
[ "$all" -lt 200000000 ] || { echo "test-root: the limit for coframe[all] without NumPy is 200 MB" >&2; exit 1; }
environment/bin/python -c "import rclpy, tf2_ros"
environment/bin/python -m pip install --quiet pytest pytest-timeout
environment/bin/python -m pytest -q -rs -p no:cacheprovider -c /project/pyproject.toml /project/tests/installed
'
# The lab in the root and in this checkout, with each of the libraries in the root.
both_sides='
for library in "" $(cd "$root" && ls -d usr/lib/*/libddsc.so.0debian 2>/dev/null | sed s:^:/:); do
    [ -n "$bundle" ] || [ -n "$library" ] || continue
    echo "the lab in $root and here, with ${library:-the library of the wheel}"
    COFRAME_TEST_OTHER_PYTHON="env ${library:+COFRAME_DDS_LIBRARY=$library} chroot $root /tmp/environment/bin/python" \
        '"$host"' -m pytest -q -rs -p no:cacheprovider -m "" -k another_python tests/wire/test_library_versions.py || exit
done
'

if [ -n "$sdist" ]; then
    version=$(chroot "$root" python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    wheels=$work/wheels-$suite
    mkdir -p "$wheels"
    rm -f "$wheels"/coframe-*
    requirements=$("$host" -c 'import re; print("\n".join(re.findall(r"\"([^\"]+)\"", re.search(r"requires = (.*)", open("pyproject.toml").read())[1])))')
    # shellcheck disable=SC2086  # one requirement per word
    download "$version" "$wheels" $requirements "cmake>=3.24" "ninja>=1.11"
    source=$(ls -t dist/coframe-*.tar.gz | head -n 1)
    in_root "$wheels" "" "$compile" "/project/$source"
    cp "$root"/tmp/compiled/coframe-*.whl "$wheels/"
    # shellcheck disable=SC2046  # one requirement per word
    download "$version" "$wheels" $(needed "$version" "$(ls "$wheels"/coframe-*.whl)")
    export AFTER="$both_sides"
    in_root "$wheels" "" "$install" python3
    exit
fi

status=0
for python in /usr/bin/python3 "$@"; do
    if [ "$python" = /usr/bin/python3 ]; then
        version=$(chroot "$root" python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        prefix=
    else
        version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        prefix=$("$python" -c 'import sys; print(sys.base_prefix)')
        python=$("$python" -c 'import sys; print(sys.executable)')
    fi
    tag=cp$(echo "$version" | tr -d .)
    wheel=$(ls -t dist/coframe-*-"$tag"-"$tag"-*.whl 2>/dev/null | head -n 1)
    [ -n "$wheel" ] || { echo "test-root: no wheel for CPython $version in dist/"; status=1; continue; }
    wheels=$work/wheels-$tag
    mkdir -p "$wheels"
    rm -f "$wheels"/coframe-*.whl
    # shellcheck disable=SC2046  # one requirement per word
    download "$version" "$wheels" $(needed "$version" "$wheel")
    in_root "$wheels" "$prefix" "$install" "$python" || status=1
done
exit $status
