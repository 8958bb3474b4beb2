#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Pictures and reports: where they go and what they look like.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# magic FILE: its first four bytes in hexadecimal.
magic() { head -c 4 "$1" | od -An -tx1 | tr -d ' \n'; }

every_extension() {
  local extension expected
  while read -r extension expected; do
    expect 0 "$scenes/spheres.obj" "${small[@]}" -o "picture.$extension"
    [[ $(magic "picture.$extension") =~ ^($expected) ]] || fail "picture.$extension is no $extension"
  done <<'LIST'
png 89504e47
PNG 89504e47
ppm 50360a
pfm 50460a
exr 762f3101
jpg ffd8ff
jpeg ffd8ff
tif 49492a00|4d4d002a
tiff 49492a00|4d4d002a
hdr 233f5241|233f5247
LIST
}

# 8-bit pictures are made tile by tile; --verify keeps the linear ones.
one_picture() {
  local extension
  for extension in png ppm jpg tif; do
    expect 0 "$scenes/spheres.obj" -r 83x45 -o "codes.$extension"
    expect 0 "$scenes/spheres.obj" -r 83x45 --verify -o "linear.$extension"
    cmp -s "codes.$extension" "linear.$extension" || fail "another $extension"
  done
}

# Modules lie beside the program, not where something is called like it.
modules_of_the_program() {
  PATH=$(dirname "$fastrt"):$PATH
  fastrt=$(basename "$fastrt")
  mkdir "$fastrt"
  echo "no module" >fastrt_png_jpeg.so
  expect 0 tiny.obj "${small[@]}" -o picture.jpg
}

default_name() {
  mkdir deep
  cp tiny.obj deep/model.v2.obj
  expect 0 deep/model.v2.obj "${small[@]}"
  [ -s model.v2.png ] || fail "no model.v2.png here"
}

no_file() {
  expect 0 tiny.obj "${small[@]}" -o none
  [ "$(find . -name '*.png' -o -name none | wc -l)" -eq 0 ] || fail "a file was written"
}

last_line() {
  expect 0 tiny.obj "${small[@]}"
  tail -n 1 out | grep -qE \
    '^tiny.png: 48x32, 2 triangles, 1 spp, [0-9.]+ Mrays in [0-9.]+ s \([0-9.]+ Mrays/s\), total [0-9.]+ s$' ||
    fail "another last line"
}

quiet() {
  printf 'v 0 0 0\nusemtl none\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >odd.obj
  expect 0 odd.obj "${small[@]}" -q
  [ ! -s out ] && [ ! -s err ] || fail "not quiet"
}

stats_text() {
  expect 0 tiny.obj "${small[@]}" --stats
  for text in read build render write primary shadow reflected refracted Mrays/s SAH memory; do
    grep -q "$text" err || fail "no $text"
  done
  [ "$(wc -l <out)" -eq 1 ] || fail "more than the last line on stdout"
}

stats_json() {
  expect 0 tiny.obj "${small[@]}" --stats=json --verify
  [ "$(wc -l <out)" -eq 1 ] || fail "not one object"
  [ ! -s err ] || fail "something on stderr"
  if command -v python3 >/dev/null; then
    python3 - out <<'PYTHON' || fail "no JSON"
import json, sys
stats = json.load(open(sys.argv[1]))
assert stats["width"] == 48 and stats["rays"]["primary"] == 48 * 32 and stats["triangles"] == 2
assert stats["tests"]["primary"]["primitives"] > 0
assert stats["verify"]["pixels"] == 0 and stats["peak_rss_bytes"] > 0 and stats["seconds"]["total"] > 0
PYTHON
  fi
}

picture_to_stdout() {
  "$fastrt" tiny.obj "${small[@]}" -o a.png >/dev/null
  "$fastrt" tiny.obj "${small[@]}" -o /dev/stdout 2>err | cat >b.png
  cmp a.png b.png
  grep -q 'Mrays/s' err || fail "no last line on stderr"
  "$fastrt" tiny.obj "${small[@]}" -o - 2>err | cat >c.png
  cmp a.png c.png
  grep -q 'Mrays/s' err || fail "no last line on stderr"
  expect_error 2 'standard output' tiny.obj -o - --aov id
}

# Standard output is written to as it is, not opened anew.
picture_behind_other_output() {
  "$fastrt" tiny.obj "${small[@]}" -q -o a.png
  for name in - /dev/stdout /dev/fd/1; do
    (echo before && "$fastrt" tiny.obj "${small[@]}" -q -o $name && echo after) >b.png
    cmp b.png <(echo before && cat a.png && echo after) || fail "-o $name is not behind what was there"
  done
  expect_error 4 'Bad file descriptor' tiny.obj -o /dev/fd/77
  expect_error 2 'write the same file' tiny.obj -o - --signature=/dev/fd/1
}

# As that of a program which Node.js has started.
picture_to_a_socket() {
  command -v python3 >/dev/null || return 0
  "$fastrt" tiny.obj "${small[@]}" -q -o a.png
  python3 - "$fastrt" tiny.obj "${small[@]}" -q -o - <<'PYTHON' || fail "another picture in the socket"
import socket, subprocess, sys
ours, theirs = socket.socketpair()
program = subprocess.Popen(sys.argv[1:], stdout=theirs)
theirs.close()
picture = ours.makefile("rb").read()
assert program.wait() == 0 and picture == open("a.png", "rb").read()
PYTHON
}

picture_to_a_command() {
  "$fastrt" tiny.obj "${small[@]}" -o a.png >/dev/null
  "$fastrt" tiny.obj "${small[@]}" -q -o >(cat >b.png)
  for _ in {1..50}; do # the command ends on its own
    ! cmp -s a.png b.png || return 0
    sleep 0.1
  done
  fail "the command got another picture"
}

unwritable() {
  mkdir folder.png
  expect_error 4 'missing' tiny.obj -o missing/a.png
  expect_error 4 'folder.png' tiny.obj -o folder.png
  expect_error 4 'tiny.obj' tiny.obj -o tiny.obj/a.png
  # Before the rendering, which would take hours.
  local start=$SECONDS
  expect_error 4 'missing' "$scenes/spheres.obj" -r 8000x8000 -s 1000 -o missing/a.png
  [ $((SECONDS - start)) -lt 20 ] || fail "found out late"
  # For root, permissions say nothing.
  if [ "$(id -u)" -ne 0 ]; then
    mkdir locked
    chmod a-w locked
    expect_error 4 'denied' tiny.obj -o locked/a.png
  fi
}

# Before the rendering, as above.
module_is_missing() {
  local format
  for format in exr hdr jpg; do
    FASTRT_MODULE_PATH=/nowhere expect_error 4 'cannot load the module for this picture format' missing.obj -o a.$format
  done
  FASTRT_MODULE_PATH=/nowhere expect 0 tiny.obj "${small[@]}"
}

# A scene that is missing shows that nobody looked for it yet.
too_large_for_the_format() {
  expect_error 4 '65500' missing.obj -r 65501x2 -o a.jpg
  expect_error 4 '65500' missing.obj -r 2x65501 -o none --signature=a.JPEG
  expect_error 3 'missing.obj' missing.obj -r 65536x2 --crop 18,0,65518,2 -o a.jpg
  expect_error 3 'missing.obj' missing.obj -r 65536x2 -o a.tif
  expect_error 4 '1400 million' missing.obj -r 21363x65536 -o a.tif
  expect_error 4 '1400 million' missing.obj -r 65536x65536 -o none --signature=a.TIFF
  expect_error 3 'missing.obj' missing.obj -r 65536x21362 --max-image-mb 8192 -o a.tiff
  expect_error 3 'missing.obj' missing.obj -r 65536x65536 --crop 0,0,2,2 -o a.tif
  printf '[picture]\nwidth = 65536\nheight = 2\nspp = 65536\n[[sphere]]\n' >wide.toml
  expect_error 4 '65500' wide.toml -o a.jpg
}

output_is_the_scene() {
  ln tiny.obj same.png
  ln -s tiny.obj linked.png
  cp tiny.obj copy
  expect_error 2 'the scene' tiny.obj -o same.png
  expect_error 2 'the scene' tiny.obj -o linked.png
  expect_error 2 'the scene' tiny.obj -o none --signature=linked.png
  # The side-car too.
  echo 'background = [0.9, 0.1, 0.1]' >tiny.toml
  cp tiny.toml copy.toml
  ln -s tiny.toml beside-id.png
  expect_error 2 "'tiny.toml'" tiny.obj -o beside-id.png
  expect_error 2 "'tiny.toml'" tiny.obj -o beside.png --aov id
  expect_error 2 "'tiny.toml'" tiny.obj -o none --signature=beside-id.png
  cmp tiny.obj copy
  cmp tiny.toml copy.toml
}

# These are known once the scene is read, and before the rendering.
output_is_a_part_of_the_scene() {
  expect 0 "$scenes/spheres.obj" "${small[@]}" -o texture.png
  printf 'newmtl m\nmap_Kd texture.png\n' >materials.png
  printf 'mtllib materials.png\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n' >model.obj
  printf 'ply\nformat ascii 1.0\ncomment TextureFile other-id.png\nelement vertex 3\n' >model.ply
  printf 'property float %s\n' x y z u v >>model.ply
  printf 'element face 1\nproperty list uchar int vertex_indices\nend_header\n' >>model.ply
  printf '0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n' >>model.ply
  printf '[[mesh]]\nfile = "model.obj"\n[[mesh]]\nfile = "model.ply"\n' >part.toml
  printf 'include = "part.toml"\n[material.a]\ndiffuse_texture = "own.png"\n[[sphere]]\nmaterial = "a"\n' >whole.toml
  cp texture.png own.png
  cp texture.png other-id.png
  ln -s model.obj mesh.png
  ln part.toml included.png
  sha256sum ./*.png ./*.obj ./*.ply ./*.toml >sums
  local long=(-r 2000x2000 -s 64) name start=$SECONDS
  expect_error 2 "materials.png', which is read" model.obj "${long[@]}" -o materials.png
  expect_error 2 "texture.png', which is read" model.obj "${long[@]}" -o none --signature=texture.png
  expect_error 2 "other-id.png', which is read" model.ply "${long[@]}" -o other.png --aov id
  for name in materials texture other-id own mesh included; do
    expect_error 2 "the output '$name.png' is" whole.toml "${long[@]}" -o $name.png
  done
  [ $((SECONDS - start)) -lt 20 ] || fail "found out late"
  sha256sum --quiet -c sums
  expect 0 whole.toml "${small[@]}" -o whole.png
}

outputs_are_not_each_other() {
  local name
  mkdir folder
  ln -s a.png link.png # to what is not there yet
  ln -s . here
  for name in a.png ./a.png "$PWD/a.png" folder/../a.png here/a.png link.png; do
    expect_error 2 '--signature and --output write the same file' tiny.obj -o a.png "--signature=$name"
  done
  expect_error 2 '--signature and --output write the same file' tiny.obj --signature=tiny.png
  expect_error 2 '--signature and --aov id write the same file' tiny.obj -o b.png --aov id --signature=b-id.png
  ln -s c.png c-depth.png
  expect_error 2 '--aov depth and --output write the same file' tiny.obj -o c.png --aov id,depth
  expect 0 tiny.obj "${small[@]}" -o b.exr --aov id --signature=b-id.png
  expect 0 tiny.obj "${small[@]}" -o b.png --aov id --signature=folder/b-id.png
}

old_picture_survives() {
  echo old >a.png
  # A file may grow to 1 KiB only: the write fails, and the old picture stays.
  local code=0
  (ulimit -f 1 && "$fastrt" "$scenes/spheres.obj" -r 400x300 -o a.png >/dev/null 2>&1) || code=$?
  [ "$code" -eq 4 ] || fail "ended with $code"
  [ "$(cat a.png)" = old ] || fail "the old picture is gone"
  [ "$(find . -name '*.tmp' -o -name '.fastrt*' | wc -l)" -eq 0 ] || fail "something is left over"
}

# As containers have it. Where nothing can be mounted nothing is tested.
mounted_file() {
  touch mounted a.png
  unshare --mount mount --bind mounted a.png 2>/dev/null || return 0
  unshare --mount bash -euc 'mount --bind mounted a.png; "$@"' - "$fastrt" tiny.obj "${small[@]}" -q -o a.png ||
    fail "a mounted file is no place for a picture"
  [ "$(magic mounted)" = 89504e47 ] || fail "no picture in the mounted file"
  [ "$(find . -name '.fastrt*' | wc -l)" -eq 0 ] || fail "something is left over"
}

locale_does_not_matter() {
  "$fastrt" "$scenes/spheres.obj" "${small[@]}" -o a.ppm --fov 33.5 --ambient 0.1,0.2,0.3 >/dev/null
  local name
  for name in de_DE.UTF-8 tr_TR.UTF-8 xx; do
    LC_ALL=$name LANG=$name "$fastrt" "$scenes/spheres.obj" "${small[@]}" -o b.ppm --fov 33.5 \
      --ambient 0.1,0.2,0.3 >/dev/null
    cmp a.ppm b.ppm
  done
}

progress_on_a_terminal_only() {
  expect 0 "$scenes/spheres.obj" -r 640x480 -s 4
  [ ! -s err ] || fail "progress without a terminal"
  command -v script >/dev/null || return 0
  local command="'$fastrt' '$scenes/spheres.obj' -r 1000x750 -s 64"
  TERM=xterm script -qec "$command" /dev/null </dev/null >out
  grep -q 'rendering .* %' out || fail "no progress on a terminal"
  TERM=dumb script -qec "$command" /dev/null </dev/null >out
  ! grep -q 'rendering .* %' out || fail "progress on a dumb terminal"
  TERM=xterm script -qec "$command --no-progress" /dev/null </dev/null >out
  ! grep -q 'rendering .* %' out || fail "progress in spite of --no-progress"
}

aovs() {
  expect 0 "$scenes/spheres.obj" "${small[@]}" -o deep.png --aov normal,depth-of-recursion,id --verify
  grep -q '^verify: 0 of 1536 AOVs differ$' out || fail "AOVs are not verified"
  local name
  for name in normal depth-of-recursion id; do
    [ "$(magic deep-$name.png)" = 89504e47 ] || fail "no deep-$name.png"
  done
  [ "$(find . -name 'deep*' | wc -l)" -eq 4 ] || fail "other files too"
  # Channels of one file.
  expect 0 "$scenes/spheres.obj" "${small[@]}" -o layers.exr --aov normal,depth,id
  [ "$(find . -name 'layers*' | wc -l)" -eq 1 ] || fail "more than one file"
  for name in normal.X normal.Z depth id R; do
    grep -qaF "$name" layers.exr || fail "no channel $name"
  done
  expect 0 "$scenes/spheres.obj" "${small[@]}" -o none --aov all --verify
  expect_error 2 'colour' tiny.obj --aov colour
  expect_error 2 '/dev/stdout' tiny.obj -o /dev/stdout --aov id
  mkdir a-id.png
  expect_error 4 'a-id.png' tiny.obj -o a.png --aov id
}

# Rows and columns of a PPM are those of the whole picture.
# window FILE NAME: a window of an EXR file, its first and last column and row.
window() {
  local at
  at=$(grep -aob "$2" "$1" | head -n 1 | cut -d: -f1)
  od -An -td4 -j $((at + ${#2} + 1 + 6 + 4)) -N 16 "$1" | xargs # behind the name, "box2i" and a size
}

crop_in_exr() {
  local more
  for more in "" "--aov id" "--signature"; do
    # shellcheck disable=SC2086 # several words
    expect 0 tiny.obj -r 80x60 $more -o part.exr --crop 20,17,61,49
    [[ $(window part.exr dataWindow) == '20 17 60 48' ]] || fail "'$more': $(window part.exr dataWindow)"
    [[ $(window part.exr displayWindow) == '0 0 79 59' ]] || fail "'$more': $(window part.exr displayWindow)"
  done
}

crop() {
  local more
  for more in '' '-s 2 --adaptive 0.05 --max-spp 8' '-s 4 --aperture 0.2 --filter mitchell'; do
    # shellcheck disable=SC2086
    expect 0 "$scenes/spheres.obj" -r 80x60 $more -o whole.ppm
    # shellcheck disable=SC2086
    expect 0 "$scenes/spheres.obj" -r 80x60 $more -o part.ppm --crop 20,17,61,49
    head -n 2 part.ppm | tail -n 1 | grep -qx '41 32' || fail "another size"
    for row in 0 13 31; do
      cmp -n $((3 * 41)) whole.ppm part.ppm $((13 + 3 * (80 * (17 + row) + 20))) $((13 + 3 * 41 * row)) ||
        fail "row $row differs $more"
    done
  done
  expect_error 2 '--crop' tiny.obj "${small[@]}" --crop 0,0,49,32
}

signature() {
  expect 0 "$scenes/spheres.obj" "${small[@]}" --signature
  [ "$(magic spheres-signature.png)" = 89504e47 ] || fail "no spheres-signature.png"
  expect 0 "$scenes/spheres.obj" "${small[@]}" -s 3 --seed 5 -o none --signature=b.ppm -t 1
  expect 0 "$scenes/spheres.obj" "${small[@]}" -o none --signature=c.ppm --isa scalar
  cmp b.ppm c.ppm
  expect_error 2 'the scene' tiny.obj -o a.png --signature=tiny.obj
  expect_error 2 'nonsense' tiny.obj -o a.png --signature=nonsense
  expect_error 4 'missing' tiny.obj -o a.png --signature=missing/a.png
}

run_case
