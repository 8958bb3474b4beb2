# SPDX-License-Identifier: Apache-2.0
# Shared by scripts/run, scripts/test, scripts/bench and .ci/run: packages, configuring, building. To be sourced.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

build_packages=(g++ cmake ninja-build pkg-config libglm-dev libxsimd-dev libopenimageio-dev libpng-dev
  libjpeg-dev libopenexr-dev libdeflate-dev libcli11-dev libtomlplusplus-dev)
test_packages=(libgtest-dev libbenchmark-dev binutils)

say() { echo "$*" >&2; }

# quietly LOG COMMAND...: runs it, and shows what it printed only if it fails.
quietly() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  "$@" >"$log" 2>&1 && return
  local code=$?
  cat "$log" >&2
  say "failed: $*"
  return "$code"
}

# need PACKAGE...: installs those that are missing, on Debian and its kin; elsewhere CMake will say what it lacks.
need() {
  command -v dpkg-query >/dev/null || return 0
  local missing=() package
  local have
  have=$(dpkg-query -W -f '${Package} ${Status}\n' "$@" 2>/dev/null | sed -n 's/ install ok installed$//p') || true
  for package in "$@"; do
    grep -qxF "$package" <<<"$have" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { say "install these packages first: ${missing[*]}"; return 1; }
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  quietly "$root/build/packages.log" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update
  quietly "$root/build/packages.log" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}

# cached PRESET VARIABLE: its value in the build's cache, or nothing.
cached() {
  sed -n "s/^$2:[A-Z]*=//p" "$root/build/$1/CMakeCache.txt" 2>/dev/null || true
}

# configure PRESET VARIABLE=VALUE...: unless the build is configured with these already.
configure() {
  local preset=$1 setting definitions=() changed=0
  shift
  [ -e "$root/build/$preset/build.ninja" ] || changed=1
  for setting in "$@"; do
    definitions+=("-D$setting")
    [ "$(cached "$preset" "${setting%%=*}")" = "${setting#*=}" ] || changed=1
  done
  [ "$changed" -eq 1 ] || return 0
  say "configuring build/$preset"
  (cd "$root" && quietly "$root/build/$preset-configure.log" cmake --preset "$preset" "${definitions[@]}")
}

# build PRESET [TARGET...]: prints nothing when there is nothing to do.
build() {
  local preset=$1 targets=()
  shift
  [ $# -eq 0 ] || targets=(--target "$@")
  if [ ! -e "$root/build/$preset/fastrt" ]; then say "building build/$preset (the first time takes a few minutes)"; fi
  (cd "$root" && quietly "$root/build/$preset-build.log" cmake --build "build/$preset" "${targets[@]}")
}

# One build at a time in this tree.
lock_builds() {
  mkdir -p "$root/build"
  exec 9>"$root/build/.lock"
  flock 9
}
unlock_builds() { exec 9>&-; }
