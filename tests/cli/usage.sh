#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the program makes of its command line, and how it refuses.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

help_is_grouped() {
  expect 0 --help
  for text in 'Usage: fastrt' 'Image:' 'Sampling' 'Photons:' 'Camera' 'Engine:' 'Report:' 'Examples:' '--spp' '--verify'; do
    grep -qF -- "$text" out || fail "no '$text'"
  done
  expect 0 -h
}

version_names_the_isas() {
  expect 0 --version
  grep -qE '^fastrt [0-9]+\.[0-9]+\.[0-9]+$' out || fail "no version"
  grep -qE '^instruction sets here: .*scalar' out || fail "no instruction sets"
}

version_is_quick() {
  local start end
  "$fastrt" --version >out
  start=$(date +%s%N)
  for _ in 1 2 3 4 5 6 7 8 9 10; do "$fastrt" --version >out; done
  end=$(date +%s%N)
  # Linking OpenImageIO would cost 200 ms each.
  [ $((end - start)) -lt 1000000000 ] || fail "ten starts took $(((end - start) / 1000000)) ms"
}

options_out_of_range() {
  local arguments
  while read -r arguments; do
    # shellcheck disable=SC2086
    expect_error 2 '' tiny.obj $arguments
  done <<'LIST'
--spp 0
--spp -1
--spp 1000000000
--spp abc
--spp 1.5
--spp
-r 0x10
-r -5x10
-r 99999999x10
-r 65537x1
-r 10
-r axb
--threads 0
--threads -1
--max-depth -1
--min-contribution -0.1
--min-contribution nan
--fov 0
--fov 180
--fov nan
--seed -1
--filter cone
--integrator backward
--integrator
--photons 0
--photons -1
--photons 1073741825
--photons 1e6
--caustics=0
--caustics=many
--caustics=100000001
--caustic-radius 0
--caustic-radius nan
--integrator forward --caustics
--integrator forward --adaptive 0.1
--integrator forward --aperture 0.1 -s 4
--bvh-quality best
--eye 1,2
--eye 1,2,inf
--ambient -1,0,0
--light lamp
--light point:1,2
--light spot:1,2,3
--light mesh
--light mesh:none
--light emissive
--light default:2
--stats=xml
--max-image-mb 0
--bogus
-z
-o picture.xyz
-o picture
LIST
  expect_error 2 '' tiny.obj -o ''
}

unknown_options() {
  expect_error 2 "error: unknown option '--sppp'; did you mean '--spp'? (see fastrt --help)" tiny.obj --sppp 4
  expect_error 2 "error: unknown option '--bogus' (see fastrt --help)" tiny.obj --bogus
}

one_scene_only() {
  expect_error 2 '' tiny.obj tiny.obj
  expect_error 2 'scene'
}

names_with_a_dash() {
  cp tiny.obj ./-x.obj
  cp tiny.obj ./--spp
  expect 0 "${small[@]}" -- -x.obj
  [ -s ./-x.png ] || fail "no -x.png"
  expect 0 "${small[@]}" ./-x.obj -o y.png
  [ -s y.png ] || fail "no y.png"
  expect_error 2 '' "${small[@]}" -- --spp
}

unsupported_isa() {
  expect_error 2 'mmx' tiny.obj --isa mmx
  local isa
  for isa in avx512 avx2 sse4.2 scalar; do
    if [[ " $(isas) " == *" $isa "* ]]; then
      expect 0 tiny.obj "${small[@]}" --isa $isa
    else
      expect_error 2 $isa tiny.obj --isa $isa
    fi
  done
}

isa_from_environment() {
  FASTRT_ISA=scalar expect 0 tiny.obj "${small[@]}" --stats=json
  grep -q '"isa": "scalar"' out || fail "FASTRT_ISA has no effect"
  FASTRT_ISA=mmx expect_error 2 mmx tiny.obj
  FASTRT_ISA=mmx expect 0 tiny.obj "${small[@]}" --isa scalar
  FASTRT_ISA='' expect 0 tiny.obj "${small[@]}"
}

limits() {
  expect_error 5 '65536x65536' tiny.obj -r 65536x65536
  # Three bytes a pixel where those become a picture of 8 bits, else sixteen, or more.
  expect_error 5 'max-image-mb' tiny.obj -r 592x591 --max-image-mb 1
  expect 0 tiny.obj -r 591x591 --max-image-mb 1
  expect_error 5 'max-image-mb' tiny.obj -r 256x257 --max-image-mb 1 -o tiny.pfm
  expect 0 tiny.obj -r 256x256 --max-image-mb 1 -o tiny.pfm
  expect_error 5 'max-image-mb' tiny.obj -r 256x256 --max-image-mb 1 --verify
  expect_error 5 'max-image-mb' tiny.obj -r 256x257 --max-image-mb 1 --aov depth
  expect_error 5 'max-image-mb' tiny.obj -r 132x133 --max-image-mb 1 --adaptive 0.1
  expect 0 tiny.obj -r 132x132 --max-image-mb 1 --adaptive 0.1
  expect_error 5 'max-image-mb' tiny.obj -r 162x162 --max-image-mb 1 --integrator forward
  expect 0 tiny.obj -r 162x161 --max-image-mb 1 --integrator forward --photons 1000
  expect 0 tiny.obj "${small[@]}" --max-depth 1000000000
  grep -q '^fastrt: warning: --max-depth' err || fail "no warning"
  # Not enough memory for the picture: that is said, and is no crash.
  # A build with sanitizers reserves so much address space that it can't start under such a limit.
  (ulimit -v 400000 && "$fastrt" --version >/dev/null 2>&1) || return 0
  (ulimit -v 400000 && expect_error 5 'memory' tiny.obj -r 8192x8190 -t 1 -o tiny.pfm)
}

cameras() {
  expect_error 3 'degenerate' tiny.obj --eye 1,1,1 --look-at 1,1,1
  expect_error 3 'degenerate' tiny.obj --eye 0,5,0 --look-at 0,0,0
  expect_error 3 'degenerate' tiny.obj --up 0,0,0
  expect 0 tiny.obj "${small[@]}" --eye 0,5,0 --look-at 0,0,0 --up 0,0,1 --fov 179
}

# warned TEXT ARGUMENT...: a warning that is TEXT, and no other line.
warned() {
  local text=$1
  shift
  expect 0 "$@" "${small[@]}" -o none
  [ "$(cat err)" = "fastrt: warning: $text" ] || fail "fastrt $*: no warning '$text'"
}

lights() {
  cat >room.mtl <<'MTL'
newmtl floor
Kd 1 1 1
newmtl ns:li ght
Ke 1 1 1
MTL
  cat >room.obj <<'OBJ'
mtllib room.mtl
v -1 0 1
v 1 0 1
v 0 0 -1
v 0 1 -1
usemtl floor
f 1 2 3
usemtl ns:li ght
f 1 3 4
OBJ
  expect 0 room.obj "${small[@]}" -o whole.ppm --light 'mesh:ns:li ght'
  expect 0 room.obj "${small[@]}" -o half.ppm --light 'mesh:ns:li ght:0.5'
  ! cmp -s whole.ppm half.ppm || fail "no scale behind the name"
  expect_error 2 "--light: the material 'floor' emits nothing (Ke); those that emit light: ns:li ght" \
    room.obj --light mesh:floor
  expect_error 2 "--light: there is no material 'ns:lamp'" room.obj --light mesh:ns:lamp
  expect_error 2 "--light: 'shadow' is no field of a light" room.obj --light point:1,2,3:shadow=off
  expect_error 2 'the sides span no area' room.obj --light rect:1,2,3:1,0,0:2,0,0
}

options_for_nothing() {
  warned '--fov says nothing beside --window' tiny.obj --window=-1,1,-1,1 --fov 30
  warned '--focal says nothing without --window' tiny.obj --focal 2
  warned '--max-spp says nothing without --adaptive' tiny.obj --max-spp 9
  warned '--filter says nothing of one sample a pixel' tiny.obj --filter box
  warned "--aov says nothing without a picture: '-o none' writes no values either" tiny.obj --aov id
  warned '--caustics says nothing without a mirror or glass in the scene' tiny.obj --caustics=100
  expect 0 "$scenes/boxes.obj" "${small[@]}" -o none --caustics=100
  [ ! -s err ] || fail "a warning of mirrors and glass"
}

inputs() {
  expect_error 3 'missing.obj' missing.obj
  expect_error 3 'folder' "$scratch/"
  expect_error 3 'folder' .
  expect_error 2 '.xyz' scene.xyz
  printf 'v 0 0 0\nf 1 2 3\n' >bad.obj
  expect_error 3 'bad.obj:2' bad.obj
  printf 'v 0 0 0\nusemtl none\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >odd.obj
  expect 0 odd.obj "${small[@]}"
  grep -q '^fastrt: warning: ' err || fail "no warning"
  expect_error 3 'none' odd.obj --strict
  : >empty.obj
  expect 0 empty.obj "${small[@]}"
}

errors_are_one_line() {
  expect_error 3 'missing\x0a' $'missing\n\x1b[31m.obj'
  expect_error 2 '\x1b[31m' tiny.obj --isa $'\x1b[31m'
}

closed_streams() {
  "$fastrt" tiny.obj "${small[@]}" -o a.png >&- || fail "closed stdout"
  "$fastrt" tiny.obj "${small[@]}" -o b.png <&- 2>&- >&- || fail "closed streams"
  "$fastrt" tiny.obj "${small[@]}" -o c.png >out
  cmp a.png c.png
  cmp b.png c.png
  # A picture that goes there would be lost.
  local name code
  for name in - /dev/stdout; do
    code=0
    "$fastrt" tiny.obj "${small[@]}" -o $name >&- 2>err || code=$?
    [ "$code" -eq 4 ] || fail "-o $name ended with $code"
    grep -qx 'fastrt: error: cannot write to standard output: it is closed' err || fail "-o $name: no reason"
  done
}

full_standard_output() {
  local code=0
  "$fastrt" tiny.obj "${small[@]}" >/dev/full 2>err || code=$?
  [ "$code" -eq 4 ] || fail "ended with $code"
  code=0
  "$fastrt" --help >/dev/full 2>err || code=$?
  [ "$code" -eq 4 ] || fail "--help ended with $code"
  grep -q '^fastrt: error: .*No space left' err || fail "no reason"
}

small_stack() {
  (ulimit -s 256 && expect_error 5 'a stack of 256 KiB is too small' "$scenes/grove.toml")
  (ulimit -v 400000 && "$fastrt" --version >/dev/null 2>&1) || return 0 # sanitizers need more
  (ulimit -s 1024 && expect 0 "$scenes/grove.toml" "${small[@]}" --max-depth 64)
}

many_threads() {
  expect 0 tiny.obj "${small[@]}" --threads 1000000
  grep -q '^fastrt: warning: --threads' err || fail "no warning"
  OMP_NUM_THREADS=100000 expect 0 tiny.obj "${small[@]}"
  # Where there is no memory for the stacks of all, fewer do it.
  (ulimit -v 100000 && "$fastrt" --version >/dev/null 2>&1) || return 0 # sanitizers need more
  (ulimit -s 65536 -v 100000 && expect 0 tiny.obj "${small[@]}" -o few.png)
  expect 0 tiny.obj "${small[@]}" -o many.png
  cmp few.png many.png
}

run_case
