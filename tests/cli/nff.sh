#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# NFF scenes bring their camera, lights and the size of the picture; options go first.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

size_of() { sed -n 's/^.*: \([0-9]*x[0-9]*\), .*/\1/p' out; }

write_scene() {
  cat >tiny.nff <<'NFF'
b 0.25 0.5 0.75
v from 0 0 5 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 48 32
l 5 5 5
f 1 0.5 0.25 0.8 0.1 20 0 1
s 0 0 0 0.5
NFF
}

view() {
  write_scene
  expect 0 tiny.nff -o scene.pfm
  [ "$(size_of)" = 48x32 ] || fail "the scene's resolution"
  expect 0 tiny.nff -o small.pfm -r 24x16
  [ "$(size_of)" = 24x16 ] || fail "the command line's resolution"
  local option
  for option in '--eye 1,0,5' '--look-at 0,1,0' '--up 1,1,0' '--fov 20' '--light point:-5,5,5' '--ambient 1,1,1' \
    '--background 0,0,0'; do
    # shellcheck disable=SC2086
    expect 0 tiny.nff -o other.pfm $option
    [ "${option% *}" = --up ] || ! cmp -s scene.pfm other.pfm || fail "$option changes nothing"
  done
  expect 0 tiny.nff -o part.pfm --crop 40,20,48,32
  expect_error 2 '48x32' tiny.nff -o part.pfm --crop 40,20,49,32
  # A picture of the scene as it is, spelled out: 32 rows between whose middles are 40 degrees.
  expect 0 tiny.nff -o same.pfm -r 48x32 --eye 0,0,5 --look-at 0,0,0 --up 0,1,0 --light point:5,5,5:1,1,1 \
    --background 0.25,0.5,0.75
  cmp scene.pfm same.pfm
}

limits() {
  write_scene
  sed -i 's/48 32/30000 30000/' tiny.nff
  expect_error 5 '30000x30000' tiny.nff -o none
}

errors() {
  printf 'f 1 1 1 1 0 1 0 1\ns 0 0 x 1\n' >bad.nff
  expect_error 3 "bad.nff:2:7: s: not a number: 'x'" bad.nff
  printf 'f 1 1 1 1 0 1 0 1\ns 0 0 0 0\n' >odd.nff
  expect 0 odd.nff "${small[@]}"
  grep -q 'odd.nff:2:1: a sphere of radius 0 is left out' err || fail "no warning"
  expect_error 3 'odd.nff:2:1' odd.nff --strict
  write_scene
  expect_error 3 'error: degenerate camera' tiny.nff --eye 0,0,0
  sed -i 's/from 0 0 5/from 0 0 0/' tiny.nff
  expect_error 3 'error: tiny.nff: degenerate camera: eye and look-at point are the same' tiny.nff
  expect 0 tiny.nff --eye 0,0,5 -o none
}

# The Standard Procedural Databases, if FASTRT_MODELS names a folder that has them in nff/.
published_scenes() {
  local folder=${FASTRT_MODELS:-}/nff scene isa
  [ -n "${FASTRT_MODELS:-}" ] && [ -d "$folder" ] || { echo "FASTRT_MODELS is not set"; exit 77; }
  for scene in "$folder"/*.nff; do
    expect 0 "$scene" -r 64x64 --verify -o first.pfm
    [ ! -s err ] || fail "$scene: warnings"
    for isa in $(isas); do
      [ "$isa" != scalar ] || continue
      expect 0 "$scene" -r 64x64 --isa "$isa" -o other.pfm
      cmp first.pfm other.pfm || fail "$scene: $isa"
    done
  done
}

run_case
