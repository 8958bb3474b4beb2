#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SIGINT and SIGTERM end the program within half a second, and leave no broken file.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# A rendering that would take hours.
endless=("$scenes/spheres.obj" -r 8000x6000 -s 4096 -o a.png)

# start ARGUMENT...: in the background. A shell lets its background jobs ignore SIGINT; env undoes that.
start() {
  env --default-signal=INT,TERM "$fastrt" "$@" >out 2>err &
  process=$!
}

# interrupt SIGNAL CODE: sends it, and expects that exit code within half a second.
interrupt() {
  local begin end code=0
  begin=$(date +%s%N)
  kill "-$1" "$process"
  wait "$process" || code=$?
  end=$(date +%s%N)
  [ "$code" -eq "$2" ] || fail "ended with $code and not $2"
  [ $((end - begin)) -lt 500000000 ] || fail "took $(((end - begin) / 1000000)) ms"
  [ "$(wc -l <err)" -le 1 ] || fail "more than one line"
}

check_nothing_left() {
  [ "$(cat a.png)" = old ] || fail "the old picture is gone"
  [ "$(find . -name '.fastrt*' -o -name '*.tmp' -o -name '*.partial*' | wc -l)" -eq 0 ] || fail "something is left"
}

while_rendering() {
  echo old >a.png
  start "${endless[@]}"
  sleep 1
  interrupt INT 130
  grep -qE '^fastrt: error: interrupted' err || fail "no message"
  check_nothing_left
}

while_reading() {
  echo old >a.png
  # Long enough to be still read, or built, a little later.
  awk 'BEGIN { for (i = 0; i < 400000; ++i) printf "v %d %d %d\nv %d %d 1\nv 1 %d %d\nf -1 -2 -3\n",
    i % 640, i / 640, i % 7, i % 640, i / 640, i % 640, i / 640 }' >large.obj
  for delay in 0.02 0.1 0.2 0.4; do
    start large.obj -q -r 8000x6000 -s 4096 -o a.png
    sleep $delay
    interrupt INT 130
    check_nothing_left
  done
}

terminate() {
  echo old >a.png
  start "${endless[@]}"
  sleep 0.5
  interrupt TERM 143
  check_nothing_left
}

second_signal() {
  echo old >a.png
  start "${endless[@]}"
  sleep 0.5
  kill -INT "$process"
  interrupt INT 130
  check_nothing_left
}

# Whenever it comes: the picture is the whole new one or the old one.
after_the_end() {
  "$fastrt" "$scenes/spheres.obj" -r 400x300 -q -o whole.png
  local delay code
  for delay in 0.02 0.04 0.06 0.08 0.1 0.12 0.15 0.2 0.3; do
    echo old >a.png
    start "$scenes/spheres.obj" -r 400x300 -o a.png
    sleep $delay
    kill -INT "$process" 2>/dev/null || true
    code=0
    wait "$process" || code=$?
    [ "$code" -eq 0 ] || [ "$code" -eq 130 ] || fail "ended with $code"
    cmp -s a.png whole.png || [ "$(cat a.png)" = old ] || fail "a broken picture"
    [ "$code" -ne 0 ] || cmp a.png whole.png
    [ "$(find . -name '.fastrt*' | wc -l)" -eq 0 ] || fail "something is left"
  done
}

run_case
