# What ./demo and ./check share: install packages, configure and build a preset. To be sourced by bash.
# shellcheck shell=bash

lahar_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

say() { printf '==> %s\n' "$*"; }

die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# missing_packages [optional]: names in tools/packages.txt that dpkg does not know as installed, of those that are
# needed or of those that are optional.
missing_packages() {
  local package note status
  while read -r package note; do
    case "$package" in '' | '#'*) continue ;; esac
    [ "$note" = "${1:-}" ] || continue
    status="$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)"
    [ "$status" = 'install ok installed' ] || printf '%s\n' "$package"
  done <"$lahar_root/tools/packages.txt"
}

# Runs a command as root, directly or by sudo. Without a terminal sudo must not ask for a password. Names the packages
# that its caller misses (`missing`) where it can do neither.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    if [ -t 0 ]; then sudo "$@"; else sudo -n "$@"; fi
  else
    die "packages must be installed, but this is neither root nor is there sudo. As root, run:
  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
  fi
}

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say 'not a Debian system: taking the packages of tools/packages.txt as installed'
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  if [ "${#missing[@]}" -eq 0 ]; then
    say 'all packages are installed'
    return
  fi
  say "installing ${#missing[@]} packages: ${missing[*]}"
  as_root apt-get update -q || die "apt-get update failed: is the network up, and are the sources of Debian 12 set?"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" ||
    die "apt-get could not install: ${missing[*]}
  Lahar is built and tested on Debian 12 (bookworm); see tools/packages.txt."
}

# One by one: what one of them serves is left out where it cannot be had.
install_optional_packages() {
  command -v dpkg-query >/dev/null || return 0
  local package missing
  mapfile -t missing < <(missing_packages optional)
  for package in "${missing[@]}"; do
    say "installing $package, which is optional"
    (as_root apt-get update -q &&
      as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$package") ||
      say "going on without $package: what needs it is skipped"
  done
}

# Memory that a build may use, MiB: what is available, or less where a control group sets a limit.
available_memory_mib() {
  local kib limit
  kib="$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)"
  limit="$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)"
  case "$limit" in
    max) ;;
    *) [ "$((limit / 1024))" -ge "$kib" ] || kib="$((limit / 1024))" ;;
  esac
  echo "$((kib / 1024))"
}

# One compiler per processor, as long as each has 1.6 GiB: a translation unit with OpenVDB takes about 1.5.
parallel_jobs() {
  local jobs by_memory
  jobs="$(nproc)"
  by_memory="$(($(available_memory_mib) / 1600))"
  [ "$jobs" -le "$by_memory" ] || jobs="$by_memory"
  [ "$jobs" -ge 1 ] || jobs=1
  echo "$jobs"
}

# A cache written for another folder (the checkout was moved or copied) cannot be used again.
drop_foreign_cache() {
  local build="$1" home
  [ -f "$build/CMakeCache.txt" ] || return 0
  home="$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")"
  [ "$home" = "$lahar_root" ] || rm -rf "$build"
}

# build_preset PRESET [TARGET ...]
build_preset() {
  local preset="$1" jobs
  shift
  local build="$lahar_root/build/$preset"
  jobs="$(parallel_jobs)"
  drop_foreign_cache "$build"
  say "configuring the preset $preset"
  (cd "$lahar_root" && cmake --preset "$preset" --log-level=NOTICE) || die "configuring failed"
  say "building in build/$preset with $jobs jobs"
  NINJA_STATUS='[%f/%t %es] ' cmake --build "$build" -j "$jobs" ${1:+--target "$@"} ||
    die "building failed (if a compiler was killed, memory ran out: close other programs and run again)"
}

# Seconds as `3 min 20 s`.
duration_text() { printf '%d min %d s' "$(($1 / 60))" "$(($1 % 60))"; }
