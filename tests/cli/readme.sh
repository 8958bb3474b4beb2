#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The README's commands work: those of its ```sh blocks that run fastrt are run here, with this build's program.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# The lines of the sh blocks, without prompts and comments; a line that ends in \ goes on.
lines_of() {
  awk '/^ *```/ { if (inside) inside = 0; else inside = ($0 ~ /^ *```(sh|bash|console|shell) *$/); next }
    inside { sub(/^ *\$ /, ""); if (sub(/\\$/, "")) { held = held $0; next } print held $0; held = "" }' "$1" |
    sed -E 's/[[:space:]]+#.*$//; /^[[:space:]]*(#|$)/d'
}

commands() {
  local readme=$source/README.md line words count=0
  [ -f "$readme" ] || { echo "there is no README.md"; return 0; }
  ln -s "$source/scenes" scenes
  # The same names as in the README stand for this build's program.
  mkdir -p build/release scripts
  ln -s "$fastrt" build/release/fastrt
  ln -s "$fastrt" fastrt
  cat >scripts/run <<RUN
#!/bin/sh
case "\${1:-}" in ''|-*) set -- scenes/spheres.obj "\$@" ;; esac
exec "$fastrt" "\$@"
RUN
  chmod +x scripts/run
  export PATH="$scratch:$PATH"

  while IFS= read -r line; do
    words=${line#./}
    case $words in
      'fastrt '* | 'build/release/fastrt '* | 'scripts/run' | 'scripts/run '*)
        echo "$line"
        bash -euc "$words" >out 2>err || fail "$line"
        count=$((count + 1))
        ;;
      'scripts/'* | '.ci/run'*)
        words=${words%% *}
        [ -x "$source/$words" ] || fail "$line: there is no program $words"
        ;;
    esac
  done < <(lines_of "$readme")
  echo "$count commands of the README work"
}

run_case
