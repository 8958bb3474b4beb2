#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# includes_point_down_can_fail.sh CHECK: the check finds each kind of include that is not allowed.
set -euo pipefail

check=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# tree FILE INCLUDE: a small tree in which FILE has one more include.
tree() {
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree"/{include/fastrt,src/{simd,scene,accel,kernels,trace,reference,render}}
  cd "$scratch/tree"
  echo '#include <cstdint>' >src/simd/lanes.hpp
  echo '#include <glm/glm.hpp>' >include/fastrt/math.hpp
  echo '#include "src/simd/lanes.hpp"' >src/kernels/box.hpp
  echo '#include "src/kernels/box.hpp"' >src/trace/tile.hpp
  echo '#include <fastrt/math.hpp>' >src/scene/scene.hpp
  echo '#include "src/scene/scene.hpp"' >src/reference/ray.hpp
  mkdir -p "$(dirname "$1")"
  echo "#include $2" >>"$1"
}

tree src/render/frame.hpp '"src/trace/tile.hpp"'
bash "$check" "$scratch/tree"
tree src/trace/scalar_bvh.cpp '"src/reference/ray.hpp"'
bash "$check" "$scratch/tree"

while read -r file include; do
  tree "$file" "$include"
  if bash "$check" "$scratch/tree"; then
    echo "not found: $file includes $include"
    exit 1
  fi
done <<'LIST'
src/scene/a.hpp "src/trace/tile.hpp"
src/accel/a.hpp "src/scene/scene.hpp"
src/reference/a.hpp "src/kernels/box.hpp"
src/trace/a.hpp "src/reference/ray.hpp"
src/trace/scalar.cpp "src/reference/ray.hpp"
src/kernels/a.hpp "src/reference/ray.hpp"
src/kernels/a.hpp <vector>
src/kernels/a.hpp <fastrt/math.hpp>
src/scene/a.hpp "scene.hpp"
src/attic/a.hpp <cstdint>
include/fastrt/a.hpp <xsimd/xsimd.hpp>
include/fastrt/a.hpp "src/simd/lanes.hpp"
LIST
