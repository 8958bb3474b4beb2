#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scene.toml brings camera, lights and how the picture is made; options go first.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

size_of() { sed -n 's/^.*: \([0-9]*x[0-9]*\), .*/\1/p' out; }
samples_of() { sed -n 's/^.*, \([0-9]*\) spp.*/\1/p' out; }

write_scene() {
  cat >ball.toml <<'TOML'
background = [0.25, 0.5, 0.75]

[picture]
width = 48
height = 32
spp = 2
seed = 7

[camera]
eye = [0, 0, 5]
look_at = [0, 0, 0]
window = [-0.3, 0.3, -0.2, 0.2]

[[light]]
type = "disk"
position = [4, 4, 4]
direction = [-1, -1, -1]
radius = 1

[[sphere]]
radius = 0.5

[[plane]]
point = [0, -0.5, 0]
TOML
}

settings() {
  write_scene
  expect 0 ball.toml -o scene.pfm --verify
  grep -q '^verify: 0 of 1536 pixels differ$' out || fail "no verdict on pixels"
  [ "$(size_of)" = 48x32 ] || fail "the scene's resolution"
  [ "$(samples_of)" = 2 ] || fail "the scene's samples"
  expect 0 ball.toml -o small.pfm -r 24x16 -s 1
  [ "$(size_of)" = 24x16 ] || fail "the command line's resolution"
  [ "$(samples_of)" = 1 ] || fail "the command line's samples"
  local option
  for option in '--eye 1,0,5' '--look-at 0,1,0' '--up 1,1,0' '--fov 20' '--light point:-5,5,5' '--ambient 1,1,1' \
    '--background 0,0,0' '--window -1,1,-1,1' '--focal 2' '--ortho 2' '--seed 8' '--filter box' '--light-samples 2'; do
    # shellcheck disable=SC2086
    expect 0 ball.toml -o other.pfm $option
    ! cmp -s scene.pfm other.pfm || fail "$option changes nothing"
  done
  # The same, spelled out.
  expect 0 ball.toml -o same.pfm -r 48x32 -s 2 --seed 7 --eye 0,0,5 --look-at 0,0,0 --window=-0.3,0.3,-0.2,0.2
  cmp scene.pfm same.pfm
  sed -i 's/48/30000/; s/32/30000/' ball.toml
  expect_error 5 '30000x30000' ball.toml -o none
}

sidecar() {
  expect 0 tiny.obj -o plain.pfm "${small[@]}"
  [ ! -s err ] || fail "something on stderr"
  echo 'background = [0.9, 0.1, 0.1]' >scene.toml
  expect 0 tiny.obj -o red.pfm "${small[@]}"
  grep -qx "fastrt: note: 'scene.toml' beside the scene is used too (--no-sidecar: it is not)" err || fail "no note"
  ! cmp -s plain.pfm red.pfm || fail "scene.toml changes nothing"
  echo 'background = [0.1, 0.1, 0.9]' >tiny.toml
  expect 0 tiny.obj -o blue.pfm "${small[@]}" --strict
  grep -q "'tiny.toml'" err || fail "tiny.toml goes before scene.toml"
  ! cmp -s red.pfm blue.pfm || fail "tiny.toml changes nothing"
  expect 0 tiny.obj -o other.pfm "${small[@]}" -q
  [ ! -s err ] || fail "-q: something on stderr"
  cmp blue.pfm other.pfm
  expect 0 tiny.obj -o other.pfm "${small[@]}" --no-sidecar
  [ ! -s err ] || fail "--no-sidecar: something on stderr"
  cmp plain.pfm other.pfm
  echo 'backgrond = 1' >tiny.toml
  expect 3 tiny.obj -o none
  grep -qF "error: tiny.toml:1:1: unknown key 'backgrond' in the scene; did you mean 'background'?" err || fail "no error"
}

errors() {
  printf '[[sphere]]\nradius = [1\n' >bad.toml
  expect_error 3 'bad.toml:' bad.toml
  printf '[[sphere]]\ncolour = 1\n' >bad.toml
  expect_error 3 "bad.toml:2:1: unknown key 'colour' in [[sphere]]" bad.toml
  echo 'include = "b.toml"' >a.toml
  echo 'include = "a.toml"' >b.toml
  expect_error 3 "b.toml:1:11: include: include cycle: 'a.toml' is being read already" a.toml
  printf '[material.a]\ndiffuse_texture = "none.png"\n[[sphere]]\nmaterial = "a"\n' >odd.toml
  expect 0 odd.toml "${small[@]}"
  grep -q "odd.toml:2:19: texture 'none.png' does not exist" err || fail "no warning"
  expect_error 3 'odd.toml:2:19' odd.toml --strict
  mkdir -p sub
  echo 'include = "../odd.toml"' >sub/up.toml
  expect_error 3 'lies outside the scene directory' sub/up.toml
  expect 0 sub/up.toml "${small[@]}" --allow-external-files
  printf '[material.dull]\n[[cube]]\nmaterial = "dull"\n[[light]]\ntype = "mesh"\nmaterial = "dull"\n' >dull.toml
  expect_error 3 "error: dull.toml: light 0: the material 'dull' emits nothing" dull.toml
  truncate -s 17M large.toml
  expect_error 5 "'large.toml' is larger than 16 MiB" large.toml
}

verify_scenes() {
  local scene
  for scene in "$scenes"/*.toml; do
    expect 0 "$scene" -r 32x20 -s 1 --light-samples 1 -o none --verify
    grep -q '^verify: 0 of 640 pixels differ$' out || fail "$scene: no verdict on pixels"
    [ ! -s err ] || fail "$scene: warnings"
  done
}

run_case
