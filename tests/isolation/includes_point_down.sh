#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# includes_point_down.sh ROOT: the sources are floors (docs/architecture.md), and an include may only point to
# the same floor or a lower one. The kernels, with all that they include, see no GLM and no containers.
set -euo pipefail
shopt -s globstar nullglob

cd "$1"
failed=0
complain() {
  echo "$*"
  failed=1
}

# The floor of a path below src/.
floor_of() {
  case $1 in
    simd/* | film/*sampling.hpp) echo 0 ;;
    load/* | modules/* | scene/* | film/*) echo 1 ;;
    accel/*) echo 2 ;;
    trace/* | kernels/* | reference/*) echo 3 ;;
    write/* | render/*) echo 4 ;;
    cli/*) echo 5 ;;
    *) echo unknown ;;
  esac
}

includes_of() { sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*(["<][^">]*)[">].*/\1/p' "$1"; }

checked=0
for file in src/**/*.[ch]pp; do
  path=${file#src/}
  floor=$(floor_of "$path")
  [ "$floor" != unknown ] || complain "$file: its folder is on no floor"
  while read -r include; do
    case $include in
      '"src/'*) ;;
      '"'*) complain "$file: include \"${include#?}\" by its path from the root" && continue ;;
      *) continue ;;
    esac
    target=${include#\"src/}
    target_floor=$(floor_of "$target")
    checked=$((checked + 1))
    [ "$target_floor" != unknown ] || { complain "$file: src/$target is on no floor" && continue; }
    [ "$target_floor" -le "$floor" ] || complain "$file: includes src/$target, which is above it"
    # The naive twin stands beside the kernels and shares nothing with them.
    if [[ $path == reference/* && $target != reference/* && $target_floor -gt 1 ]]; then
      complain "$file: the reference includes src/$target"
    fi
    if [[ $path =~ ^(trace|kernels)/ && $path != trace/scalar_bvh.* && $target == reference/* ]]; then
      complain "$file: only src/trace/scalar_bvh.* may include the reference, src/$target"
    fi
    if [[ $path == accel/* && $target != accel/* && $target_floor -ne 0 ]]; then
      complain "$file: the tree includes src/$target"
    fi
  done < <(includes_of "$file")
done
[ "$checked" -gt 0 ] || complain "no include was found under src/"

for file in include/**/*.hpp; do
  while read -r include; do
    case $include in
      '"'* | '<xsimd'* | '<OpenImageIO'* | '<src/'*) complain "$file: a public header includes ${include#?}" ;;
    esac
  done < <(includes_of "$file")
done

# What the kernels see, however indirectly.
declare -A seen=()
queue=(src/kernels/*.[ch]pp src/simd/*.hpp)
while [ ${#queue[@]} -gt 0 ]; do
  file=${queue[0]}
  queue=("${queue[@]:1}")
  [ -z "${seen[$file]:-}" ] || continue
  seen[$file]=1
  while read -r include; do
    case $include in
      '"src/'*) queue+=("${include#?}") ;;
      '<fastrt/'*) queue+=("include/${include#?}") ;;
      '<glm/'* | '<array' | '<vector' | '<string' | '<map' | '<set' | '<unordered_'* | '<list' | '<deque' | \
        '<memory' | '<functional' | '<span' | '<optional' | '<variant' | *stream | '<cstdio' | '<OpenImageIO'*)
        complain "$file: kernels see <${include#?}>"
        ;;
    esac
  done < <(includes_of "$file")
done

[ "$failed" -eq 0 ] || exit 1
echo "$checked includes point down"
