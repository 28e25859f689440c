#!/bin/sh
# What each public header costs a program that includes it: compile time and memory.
set -eu

usage() {
  cat <<'TEXT'
usage: bench/compile_times.sh [--compiler CXX] [--runs N] [--umbrella] [--help]

Prints, for each public header alone, the processor time and the peak memory of compiling a file that
includes nothing else, and how much that is beyond <Eigen/Core>, which nearly all of them include;
first <Eigen/Core> itself and wheelrail.hpp, parsed and compiled with -O2. Ends with an error where
wheelrail.hpp takes 3 s or more beyond <Eigen/Core>. Times are those of this machine, at this moment;
they are taken in turns, and the least of the runs counts.

  --compiler CXX  the compiler (g++)
  --runs N        of each (1; of <Eigen/Core> and wheelrail.hpp 3 at least)
  --umbrella      <Eigen/Core> and wheelrail.hpp only
  --help          print this

Eigen is taken from /usr/include/eigen3, or from where EIGEN_FOLDER says.
TEXT
}

compiler=g++
runs=1
umbrella_only=no
while [ $# -gt 0 ]; do
  case $1 in
    --compiler | --runs)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      case $1 in
        --compiler) compiler=$2 ;;
        --runs) runs=$2 ;;
      esac
      shift 2
      ;;
    --umbrella) umbrella_only=yes; shift ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
case $runs in
  '' | 0 | *[!0-9]*) usage >&2; exit 2 ;;
esac

root=$(cd -- "$(dirname -- "$0")/.." && pwd)
cd -- "$root"
# shellcheck source=tests/support/install_packages.sh
. tests/support/install_packages.sh
install_packages libeigen3-dev time
eigen=${EIGEN_FOLDER:-/usr/include/eigen3}
[ -e "$eigen/Eigen/Core" ] || { echo "no Eigen in $eigen: set EIGEN_FOLDER" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# Adds one run to $work/runs: a key, seconds, kilobytes. usage: measure key header flags...
measure() {
  key=$1
  echo "#include <$2>" >"$work/one.cpp"
  shift 2
  /usr/bin/time -f '%U %S %M' -o "$work/time" "$compiler" -std=c++20 -Iinclude -isystem "$eigen" \
    "$@" "$work/one.cpp"
  awk -v key="$key" 'NF == 3 { print key, $1 + $2, $3 }' "$work/time" >>"$work/runs"
}

often=$runs
[ "$often" -ge 3 ] || often=3
for _ in $(seq "$often"); do
  for header in Eigen/Core wheelrail/wheelrail.hpp; do
    measure "$header" "$header" -fsyntax-only
    measure "$header,-c,-O2" "$header" -c -O2 -o "$work/one.o"
  done
done
if [ "$umbrella_only" = no ]; then
  headers=$(cd -- include && find wheelrail -name '*.hpp' ! -path '*/detail/*' \
    ! -path wheelrail/wheelrail.hpp | LC_ALL=C sort)
  for _ in $(seq "$runs"); do
    for header in $headers; do
      measure "$header" "$header" -fsyntax-only
    done
  done
fi

"$compiler" --version | head -n 1
awk '
  !($1 in seconds) { order[++count] = $1; seconds[$1] = $2; memory[$1] = $3 }
  $2 < seconds[$1] { seconds[$1] = $2 }
  $3 < memory[$1] { memory[$1] = $3 }
  END {
    printf "%-46s %6s %8s %6s %8s\n", "", "s", "beyond", "MB", "beyond"
    for (i = 1; i <= count; ++i) {
      key = order[i]
      base = key ~ /,-c,-O2$/ ? "Eigen/Core,-c,-O2" : "Eigen/Core"
      name = key
      gsub(/,/, " ", name)
      beyond = seconds[key] - seconds[base]
      printf "%-46s %6.2f %8.2f %6.0f %8.0f\n", name, seconds[key], beyond, memory[key] / 1024,
        (memory[key] - memory[base]) / 1024
      if (key ~ /^wheelrail\/wheelrail\.hpp/ && 3 <= beyond) slow = 1
    }
    if (slow) print "wheelrail.hpp takes 3 s or more beyond <Eigen/Core>"
    exit slow
  }' "$work/runs"
