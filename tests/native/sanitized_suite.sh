#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs the test suite with a native module that was built with AddressSanitizer and UndefinedBehaviorSanitizer.
#
#   sanitized_suite.sh PYTEST_ARGUMENTS...     by default all of tests/
#
# The module is built into a wheel, which is installed into a separate virtual environment. Not run: the tests in the
# browser and of the wheel, which start programs that do not work with the preloaded runtime, and those that
# not_sanitized.txt lists with the reasons.
set -eu
cd "$(dirname "$0")/../.."
build=build/sanitize/suite
main=${VENV:-.venv}
venv=$build/venv
flags="-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g1 -O1"

[ -x "$venv/bin/python" ] || "$main/bin/python" -m venv --without-pip "$venv"
packages() { "$1/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))'; }
packages "$main" > "$(packages "$venv")/packages_of_the_project.pth" # its own .pth files are not read
rm -rf "$build/wheel"
PATH="$PWD/$main/bin:$PATH" "$main/bin/python" -m pip wheel --quiet --no-build-isolation --no-deps --wheel-dir "$build/wheel" \
    --config-settings=build-dir="$build/objects" --config-settings=cmake.build-type=RelWithDebInfo \
    --config-settings=install.strip=false \
    --config-settings=cmake.define.CMAKE_CXX_FLAGS="$flags" --config-settings=cmake.define.CMAKE_MODULE_LINKER_FLAGS="$flags" .
"$main/bin/python" -m pip --python "$venv/bin/python" install --quiet --no-deps --force-reinstall "$build"/wheel/*.whl

library() { "${CXX:-c++}" -print-file-name="$1"; }
LD_PRELOAD="$(library libasan.so) $(library libstdc++.so)"
# CPython keeps memory until its end. Names of other variables of the sanitizers are in sanitized.sh.
ASAN_OPTIONS="detect_leaks=0:halt_on_error=1:allocator_may_return_null=1:log_path=$PWD/$build/report"
UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1:log_path=$PWD/$build/report"
export LD_PRELOAD ASAN_OPTIONS UBSAN_OPTIONS
rm -f "$build"/report.*
[ $# -gt 0 ] || set -- tests
status=0
# shellcheck disable=SC2046 # one word per test: their names have no spaces
"$venv/bin/python" -m pytest -p no:cacheprovider --ignore=tests/viewer/browser --ignore=tests/test_wheel.py \
    --ignore=tests/bags/test_hostile.py $(sed -n 's/^tests/--deselect=tests/p' tests/native/not_sanitized.txt) \
    --timeout=900 "$@" || status=$?
unset LD_PRELOAD
# A warning that too much memory was asked for is not an error: a test reads a file that claims to contain petabytes.
if grep -qsE "ERROR: |runtime error: " "$build"/report.*; then
    echo "sanitize-suite: reports of the sanitizers:"
    head -50 "$build"/report.*
    exit 1
fi
exit "$status"
