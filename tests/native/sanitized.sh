#!/bin/sh
# Runs a program that was built with a sanitizer; it ends with the first thing that the sanitizer finds.
#
#   sanitized.sh PROGRAM ARGUMENTS...
set -eu
export TSAN_OPTIONS="halt_on_error=1 second_deadlock_stack=1"
export ASAN_OPTIONS="halt_on_error=1 detect_leaks=1"
export UBSAN_OPTIONS="halt_on_error=1 print_stacktrace=1"

# Kernels that spread addresses widely (vm.mmap_rnd_bits) are too much for some ThreadSanitizers.
if "$1" 0 2>&1 | grep -q "unexpected memory mapping"; then
    exec setarch -R "$@"
fi
exec "$@"
