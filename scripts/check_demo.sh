#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Run `make demo` as a new user does: it sets everything up, serves the page, and ends after Ctrl-C.
# Prints how long each took.
set -euo pipefail
cd "$(dirname "$0")/.."
LIMIT=900 # seconds for the packages and the compilation

log=$(mktemp)
trap 'rm -f "$log"' EXIT
set -m # job control gives the demo a process group, to which Ctrl-C is sent
BROWSER=true make demo >"$log" 2>&1 &
demo=$!
# The demo prints its address; another program may use the usual port.
serves_page() {
    address=$(grep -o 'http://127.0.0.1:[0-9]*' "$log" | head -n 1)
    [ -n "$address" ] && python3 -c "import urllib.request; urllib.request.urlopen('$address/', timeout=2).read()" 2>/dev/null
}
until serves_page; do
    if ! kill -0 "$demo" 2>/dev/null || [ "$SECONDS" -gt "$LIMIT" ]; then
        cat "$log"
        echo "make demo: no page after $SECONDS s" >&2
        kill -INT -- "-$demo" 2>/dev/null || true
        exit 1
    fi
    sleep 0.5
done
echo "make demo: the page was served after $SECONDS s"
kill -INT -- "-$demo"
wait "$demo" || status=$?
# make reports the interrupt of its program with 2 or 130.
case ${status:-0} in 0 | 2 | 130) ;; *) cat "$log"; exit "$status" ;; esac
! grep -q Traceback "$log" || { cat "$log"; exit 1; }
echo "make demo: ended after Ctrl-C with exit code ${status:-0}"
