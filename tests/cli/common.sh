# SPDX-License-Identifier: Apache-2.0
# For the scripts of this folder: SCRIPT PROGRAM SOURCE SCRATCH CASE runs the function CASE in a folder of its
# own. `set -e` holds: a command that fails ends the case.
set -euo pipefail
export LC_ALL=C
unset FASTRT_ISA FASTRT_MODULE_PATH OMP_NUM_THREADS

fastrt=$1 source=$2
case_name=$4
scratch=$3/$(basename "$0" .sh)-$case_name
scenes=$source/scenes
small=(-r 48x32)

rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

# A scene that needs no other file.
cat >tiny.obj <<'OBJ'
v -1 -1 0
v 1 -1 0
v 0 1 0
v 0 0 -1
f 1 2 3
f 1 2 4
OBJ

fail() {
  echo "FAILED: $*"
  for file in out err; do
    [ ! -s $file ] || { echo "--- $file"; head -c 2000 $file; }
  done
  exit 1
}

# expect CODE ARGUMENT...: runs the program; its streams are then in the files out and err.
expect() {
  local wanted=$1 code=0
  shift
  "$fastrt" "$@" >out 2>err || code=$?
  [ "$code" -eq "$wanted" ] || fail "fastrt $* ended with $code and not $wanted"
}

# expect_error CODE TEXT ARGUMENT...: besides, one line on stderr that holds TEXT, and nothing on stdout.
expect_error() {
  local wanted=$1 text=$2
  shift 2
  expect "$wanted" "$@"
  [ "$(wc -l <err)" -eq 1 ] || fail "fastrt $*: not one line on stderr"
  grep -q '^fastrt: error: ' err || fail "fastrt $*: no error line"
  grep -qF -- "$text" err || fail "fastrt $*: no '$text' in the message"
  [ ! -s out ] || fail "fastrt $*: something on stdout"
}

isas() { "$fastrt" --version | sed -n 's/^instruction sets here: //p'; }

run_case() { "$case_name"; }
