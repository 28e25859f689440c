#!/bin/sh
# Build and run all tests on Debian 12, with g++ and with clang++, warnings as errors.
set -eu

usage() {
  cat <<'TEXT'
usage: tests/run.sh [--compiler g++|clang++] [--slow] [--help]

Installs what is missing (apt-get; root or sudo), then configures, builds and runs the tests with
each compiler in build/tests-<compiler>, or with the given one only. With both, the second one
builds the library's tests only, not the examples and theirs.

  --compiler NAME  g++ or clang++ only
  --slow           also run, after the others, the tests that are hidden because they take long
  --help           print this
TEXT
}

compilers="g++ clang++"
slow=no
while [ $# -gt 0 ]; do
  case $1 in
    --compiler)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      compilers=$2
      shift 2
      ;;
    --compiler=*) compilers=${1#--compiler=}; shift ;;
    --slow) slow=yes; shift ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

packages="g++ cmake make libeigen3-dev catch2 libbenchmark-dev"
for compiler in $compilers; do
  case $compiler in
    g++) ;;
    clang++) packages="$packages clang" ;;
    *) usage >&2; exit 2 ;;
  esac
done

root=$(cd -- "$(dirname -- "$0")/.." && pwd)
cd -- "$root"
# shellcheck source=tests/support/install_packages.sh
. tests/support/install_packages.sh
# shellcheck disable=SC2086 # a list of words
install_packages $packages

# Run the tests tagged [slow] of each test program in the folder $1 that has any.
run_slow_tests() {
  for program in "$1"/*_test; do
    # The list's exit code is the number of tests in it.
    names=$("$program" --list-test-names-only "[slow]" || true)
    if [ -n "$names" ]; then
      echo "== $program [slow]"
      "$program" "[slow]"
    fi
  done
}

jobs=$(nproc)
for compiler in $compilers; do
  build=build/tests-$compiler
  echo "== $compiler: $build"
  # The second compiler also brings a second level of optimisation, and the assertions. After the
  # first it leaves out the example programs, which are most of the time that building takes.
  examples=ON
  case $compiler in
    clang++)
      flags="-O1"
      [ "$compilers" = clang++ ] || examples=OFF
      ;;
    *) flags="-O2 -DNDEBUG" ;;
  esac
  cmake -S . -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DWHEELRAIL_BUILD_TESTS=ON \
    -DWHEELRAIL_BUILD_EXAMPLES=$examples -DWHEELRAIL_WARNINGS_AS_ERRORS=ON
  cmake --build "$build" --parallel "$jobs"
  (cd -- "$build" && ctest --output-on-failure --parallel "$jobs")
  if [ "$slow" = yes ]; then
    run_slow_tests "$build/tests"
  fi
done
