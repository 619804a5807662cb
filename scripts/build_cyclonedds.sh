#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Build the DDS library from the source of Cyclone DDS, for wheels on platforms where the cyclonedds package has none.
#
#   build_cyclonedds.sh SOURCE [FOLDER]
#
# SOURCE is the unpacked source or its archive (.tar.gz), such as the .orig.tar.gz of Debian's source package `cyclonedds`.
# FOLDER, by default src/coframe/_bundled, gets the library and the license: src/coframe/wire/dds/library.py finds it there.
# Requires CMake 3.16 and a C compiler. Nothing but the library is built: no TLS, security plugins or shared memory.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
if [ $# -lt 1 ]; then
    sed -n '3,9s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
source=$1
folder=${2:-$here/../src/coframe/_bundled}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ -f "$source" ]; then
    mkdir "$work/source"
    tar -xf "$source" -C "$work/source" --strip-components=1
    source=$work/source
fi
if [ ! -f "$source/src/core/ddsc/include/dds/dds.h" ]; then
    echo "build_cyclonedds: $1 is not the source of Cyclone DDS: it has no src/core/ddsc/include/dds/dds.h." >&2
    exit 1
fi

# The linker removes the symbols of debuggers: a strip of this machine cannot read the library of another processor.
linking=
[ "$(uname)" != Linux ] || linking=-s
cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DCMAKE_SHARED_LINKER_FLAGS="$linking" -DBUILD_IDLC=OFF \
    -DBUILD_DDSPERF=OFF -DBUILD_EXAMPLES=OFF -DBUILD_TESTING=OFF -DBUILD_DOCS=OFF -DENABLE_SSL=OFF \
    -DENABLE_SECURITY=OFF -DENABLE_SHM=OFF -DENABLE_ICEORYX=OFF >"$work/log" 2>&1 &&
    cmake --build "$work/build" --config Release --target ddsc --parallel "${JOBS:-2}" >>"$work/log" 2>&1 ||
    { tail -n 30 "$work/log" >&2; echo "build_cyclonedds: the build failed." >&2; exit 1; }

# The file itself, not the links to it: wheels contain no links. Its name has the version.
library=$(find "$work/build" \( -name 'libddsc.so.*.*' -o -name 'libddsc.*.*.dylib' -o -name 'ddsc.dll' \) -type f | head -n 1)
if [ -z "$library" ]; then
    echo "build_cyclonedds: the build made no library." >&2
    exit 1
fi
mkdir -p "$folder"
rm -f "$folder"/libddsc* "$folder"/ddsc*.dll
cp "$library" "$folder/"
cp "$source/LICENSE" "$folder/LICENSE.cyclonedds"
[ ! -f "$source/NOTICE.md" ] || cp "$source/NOTICE.md" "$folder/NOTICE.cyclonedds.md"
echo "$folder/$(basename "$library")"
