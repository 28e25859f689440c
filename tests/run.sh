#!/bin/sh
# Build and run all tests on Debian 12 or 13, with g++ or with clang++; warnings as errors.
set -eu

usage() {
  cat <<'TEXT'
usage: tests/run.sh [--compiler g++|clang++] [--full] [--slow] [--help]

Installs what is missing (apt-get; root or sudo), then configures, builds and runs the tests in
build/tests-<compiler>: those of headers, examples and packaging with clang++, assertions, and the
sanitizers of addresses and undefined behaviour; with g++, which compiles the examples too, those of
threads, packaging and documentation, and of the searches and the wheelset's run.

  --compiler NAME  the share of g++ or clang++ only
  --full           all tests with each compiler, but those of threads with g++ only; g++ with -O2
  --slow           all tests with g++ -O2, those too that are hidden because they take long
  --help           print this
TEXT
}

compilers="g++ clang++"
full=no
slow=no
while [ $# -gt 0 ]; do
  case $1 in
    --compiler)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      compilers=$2
      shift 2
      ;;
    --compiler=*) compilers=${1#--compiler=}; shift ;;
    --full) full=yes; shift ;;
    --slow) slow=yes; shift ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

packages="g++ cmake make libeigen3-dev catch2 libbenchmark-dev pkgconf libceres-dev doxygen"
# The simulators of examples/hosts.
packages="$packages libsimbody-dev libdart-dev libdart-external-ikfast-dev"
if [ "$slow" = yes ] && [ "$compilers" = clang++ ]; then
  echo "tests/run.sh: --slow runs with g++, not with --compiler clang++" >&2
  exit 2
fi
for compiler in $compilers; do
  case $compiler in
    g++) ;;
    clang++) packages="$packages clang libclang-rt-dev" ;;
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

gcc_header_tests=OFF
clang_brief=ON
optimised="-O1 -DNDEBUG"
# Most tests take longer to compile than to run; the others are optimised nevertheless
# (wheelrail_computes_long in CMakeLists.txt).
sanitized="-O0 -fsanitize=address,undefined -fno-sanitize-recover=all"
if [ "$full" = yes ]; then clang_brief=OFF; fi
if [ "$full" = yes ] || [ "$slow" = yes ]; then
  gcc_header_tests=ON
  optimised="-O2 -DNDEBUG"
fi
jobs=$(nproc)
for compiler in $compilers; do
  build=build/tests-$compiler
  echo "== $compiler: $build"
  case $compiler in
    clang++)
      flags=$sanitized
      header_tests=ON
      brief=$clang_brief
      ;;
    *)
      flags=$optimised
      header_tests=$gcc_header_tests
      brief=OFF
      ;;
  esac
  cmake -S . -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DWHEELRAIL_BUILD_TESTS=ON \
    -DWHEELRAIL_BUILD_EXAMPLES=ON -DWHEELRAIL_BUILD_HEADER_TESTS=$header_tests \
    -DWHEELRAIL_BRIEF_PACKAGING_TESTS=$brief -DWHEELRAIL_REQUIRE_ALL_TESTS=ON \
    -DWHEELRAIL_WARNINGS_AS_ERRORS=ON
  cmake --build "$build" --parallel "$jobs"
  (cd -- "$build" && ctest --output-on-failure --parallel "$jobs")
  if [ "$slow" = yes ] && [ "$compiler" = g++ ]; then
    run_slow_tests "$build/tests"
  fi
done
