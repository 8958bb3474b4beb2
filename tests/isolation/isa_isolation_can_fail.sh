#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# isa_isolation_can_fail.sh CHECK NM CXX: the check finds an inline function that two objects share.
set -euo pipefail

check=$1 nm=$2 cxx=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

echo 'inline int twice(int x) { static int calls = 0; return 2 * x + ++calls; } int one(int x) { return twice(x); }' >a.cpp
sed 's/int one/int two/' a.cpp >b.cpp
sed 's/twice/thrice/g; s/int one/int three/' a.cpp >c.cpp
for name in a b c; do
  "$cxx" -O0 -c $name.cpp -o $name.o
  echo "$PWD/$name.o" >$name.txt
done

bash "$check" "$nm" a.txt c.txt
if bash "$check" "$nm" a.txt b.txt; then
  echo "the shared function was not found"
  exit 1
fi
