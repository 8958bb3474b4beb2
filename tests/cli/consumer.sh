#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# consumer.sh CMAKE BUILD SOURCE CXX: installs BUILD aside, builds tests/consumer against that, runs it, and runs
# the installed program.
set -euo pipefail

cmake=$1 build=$2 source=$3 cxx=$4
scratch=$build/consumer
rm -rf "$scratch"
"$cmake" --install "$build" --prefix "$scratch/install" >/dev/null
# Sanitizers and the like must be the same on both sides.
flags=$(sed -n 's/^CMAKE_CXX_FLAGS:[A-Z]*=//p' "$build/CMakeCache.txt")
"$cmake" -S "$source/tests/consumer" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/install" \
  -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$scratch/build"
# Far from the build tree and the installation, whose modules it has to find.
elsewhere=$(mktemp -d)
trap 'rm -rf "$elsewhere"' EXIT
cp "$scratch/build/consumer" "$elsewhere"
(cd "$elsewhere" && ./consumer)

cd "$scratch"
"$scratch/install/bin/fastrt" "$source/scenes/spheres.obj" -r 32x24 -o installed.png
# This one goes through the module that the program loads from ../lib/fastrt.
"$scratch/install/bin/fastrt" "$source/scenes/spheres.obj" -r 32x24 -o installed.exr
[ -s installed.png ] && [ -s installed.exr ]
