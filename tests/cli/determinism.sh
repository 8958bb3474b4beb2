#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The picture depends on the scene, the camera and the settings alone.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# render NAME OPTION...: to NAME.pfm, which holds every bit, and quietly.
render() {
  local name=$1
  shift
  "$fastrt" "$scenes/spheres.obj" -r 97x61 -s 3 -q -o "$name.pfm" "$@"
}

threads() {
  render one -t 1
  for count in 2 8; do
    render many -t $count
    cmp one.pfm many.pfm
  done
}

instruction_sets() {
  local isa
  render first
  for isa in $(isas); do
    render "$isa" --isa "$isa"
    cmp first.pfm "$isa.pfm"
  done
}

repeated() {
  render first
  for _ in 1 2 3 4 5; do
    render again
    cmp first.pfm again.pfm
  done
}

seed_matters() {
  render first
  render other --seed 1
  ! cmp -s first.pfm other.pfm || fail "the seed changes nothing"
}

verify_every_scene() {
  local scene
  for scene in "$scenes"/*.obj "$scenes"/*.nff "$scenes"/*.ply; do
    expect 0 "$scene" -r 64x64 -o none --verify
    grep -q '^verify: 0 of 4096 pixels differ$' out || fail "$scene: no verdict on pixels"
    grep -q '^verify: 0 of 4096 primitive ids differ$' out || fail "$scene: no verdict on ids"
    grep -q '^verify: the largest difference is 0$' out || fail "$scene: no largest difference"
    [ ! -s err ] || fail "$scene: warnings"
  done
}

# Light from its source: whatever follows it, and however many.
photons() {
  local options isa
  for options in '--integrator forward --photons 20000' '--caustics=5000'; do
    # shellcheck disable=SC2086
    expect 0 "$scenes/caustic.nff" -r 48x32 -q $options -o first.pfm --verify
    # shellcheck disable=SC2086
    for isa in $(isas); do
      "$fastrt" "$scenes/caustic.nff" -r 48x32 -q $options -t 3 --isa "$isa" -o other.pfm
      cmp first.pfm other.pfm
    done
    # shellcheck disable=SC2086
    "$fastrt" "$scenes/caustic.nff" -r 48x32 -q $options --seed 1 -o other.pfm
    ! cmp -s first.pfm other.pfm || fail "the seed changes nothing"
  done
  expect 0 "$scenes/caustic.nff" -r 8x8 -o none --photons 10 --caustic-radius 1
  [ "$(grep -c 'says nothing without' err)" = 2 ] || fail "no warnings about options without effect"
}

scenes_are_small() {
  [ -f "$scenes/spheres.obj" ]
  [ -z "$(find "$scenes" -type f -size +300k)" ] || fail "a scene is larger than 300 KiB"
}

run_case
