#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs a program that was built with a sanitizer. The program ends at the first error that the sanitizer reports.
#
#   sanitized.sh PROGRAM ARGUMENTS...
set -eu
export TSAN_OPTIONS="halt_on_error=1 second_deadlock_stack=1"
export ASAN_OPTIONS="halt_on_error=1 detect_leaks=1"
export UBSAN_OPTIONS="halt_on_error=1 print_stacktrace=1"

# Some versions of ThreadSanitizer do not support Linux kernels with much address randomisation (vm.mmap_rnd_bits).
if "$1" 0 2>&1 | grep -q "unexpected memory mapping"; then
    exec setarch -R "$@"
fi
exec "$@"
