#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# isa_isolation.sh NM LIST...: each LIST names the object files compiled with one set of instruction set flags.
# Fails if two lists define the same inline function or object: the linker would keep one copy for all, and
# code for a newer CPU would run on an older one.
set -euo pipefail
export LC_ALL=C

nm=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for list in "$@"; do
  mapfile -t objects < <(tr ';' '\n' <"$list" | sed '/^$/d')
  [ ${#objects[@]} -gt 0 ] || { echo "$list names no object"; exit 1; }
  # W, V, u: functions and objects of which the linker keeps one. The personality's address is the same everywhere.
  "$nm" -P --defined-only "${objects[@]}" | awk '$2 ~ /^[WVu]$/ && $1 !~ /^DW\.ref\./ { print $1 }' | sort -u
done | sort | uniq -d >"$scratch/shared"

if [ -s "$scratch/shared" ]; then
  echo "defined under more than one set of instruction set flags:"
  c++filt <"$scratch/shared" | head -n 40
  exit 1
fi
echo "nothing shared between $# sets of objects"
