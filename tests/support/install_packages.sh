# shellcheck shell=sh
# Sourced by tests/run.sh and examples/study.sh.

# Install those of the named Debian packages that are missing. Nothing is called when none is.
install_packages() {
  if ! command -v dpkg >/dev/null 2>&1; then
    echo "Not a Debian system: taking for granted that these are there: $*" >&2
    return 0
  fi
  missing=
  for package in "$@"; do
    if ! dpkg -s "$package" 2>/dev/null | grep -q '^Status: install ok installed'; then
      missing="$missing $package"
    fi
  done
  if [ -z "$missing" ]; then
    return 0
  fi
  echo "Installing:$missing"
  if [ "$(id -u)" -eq 0 ]; then
    as_root=
  elif command -v sudo >/dev/null 2>&1; then
    as_root=sudo
  else
    echo "Neither root nor sudo; please install:$missing" >&2
    return 1
  fi
  # shellcheck disable=SC2086 # a list of words, and nothing when we are root
  {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
  }
}
