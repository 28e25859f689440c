#!/bin/sh
# The library as others get it: installed, then found by CMake and by pkg-config; as a subdirectory;
# as fetched content. Each way builds and runs a small program outside the source tree.
set -eu

usage() {
  cat <<'TEXT'
usage: tests/packaging/packaging_test.sh --compiler CXX --work FOLDER [--cmake CMAKE] [--brief]
                                         [--help]

  --compiler CXX  the compiler
  --work FOLDER   is emptied, written to, and removed where all is well
  --cmake CMAKE   the program (cmake)
  --brief         leave out what was shown with another compiler: subdirectory, fetched content
  --help          print this
TEXT
}

cmake=cmake
compiler=
work=
brief=no
while [ $# -gt 0 ]; do
  case $1 in
    --compiler | --work | --cmake)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      case $1 in
        --compiler) compiler=$2 ;;
        --work) work=$2 ;;
        --cmake) cmake=$2 ;;
      esac
      shift 2
      ;;
    --brief) brief=yes; shift ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
if [ -z "$compiler" ] || [ -z "$work" ]; then
  usage >&2
  exit 2
fi

here=$(cd -- "$(dirname -- "$0")" && pwd)
root=$(cd -- "$here/../.." && pwd)
rm -rf -- "$work"
mkdir -p -- "$work"
work=$(cd -- "$work" && pwd)

fail() {
  echo "FAILED: $*" >&2
  echo "What was built is left in $work" >&2
  exit 1
}

# Run a command quietly; where it fails, say what was being done and show what it printed.
# usage: try "what" command...
try() {
  doing=$1
  shift
  "$@" >"$work/log" 2>&1 || { cat -- "$work/log" >&2; fail "$doing"; }
}

# Whether two files hold the same. usage: same "what" one other
same() {
  diff -- "$2" "$3" >&2 || fail "$1"
}

echo "== install"
try "configuring the library" "$cmake" -S "$root" -B "$work/library" \
  -DCMAKE_CXX_COMPILER="$compiler" -DWHEELRAIL_BUILD_TESTS=OFF -DWHEELRAIL_BUILD_EXAMPLES=OFF
if [ ! -e "$work/library/wheelrail.pc" ]; then
  echo "Eigen is not installed: neither can the library be. Nothing was tested."
  exit 77
fi
try "installing" "$cmake" --install "$work/library" --prefix "$work/first place"
rm -rf -- "$work/library"
# Somewhere else, deeper and with a space in the name.
mkdir -p -- "$work/another/place"
mv -- "$work/first place" "$work/another/place/to be"
prefix="$work/another/place/to be"

(cd -- "$prefix" && find . ! -type d) | LC_ALL=C sort >"$work/files"
{
  (cd -- "$root" && find ./include -name '*.hpp')
  for file in cmake/wheelrail/wheelrailConfig.cmake cmake/wheelrail/wheelrailConfigVersion.cmake \
    cmake/wheelrail/wheelrailTargets.cmake pkgconfig/wheelrail.pc; do
    echo "./share/$file"
  done
} | LC_ALL=C sort >"$work/files_wanted"
same "the installed files are not the headers and what CMake and pkg-config need" \
  "$work/files" "$work/files_wanted"
if grep -rlF -e "$work" -e "$root" -- "$prefix"; then
  fail "these installed files name a folder that they were made from or in"
fi

# The programs lie outside, as anyone's would.
cp -R -- "$here/consumer" "$here/programs" "$work"
cp -- "$here/programs/contact_force.cpp" "$work/consumer"
(cd -- "$prefix/include" && find wheelrail -name '*.hpp' ! -path '*/detail/*') | LC_ALL=C sort |
  sed 's/.*/#include <&>/' >"$work/consumer/every_header.hpp"
version=$(sed -n 's/^#define WHEELRAIL_VERSION_[MP][A-Z]* //p' \
  "$root/include/wheelrail/version.hpp" | paste -s -d . -)

# Build the consumer with CMake. usage: consume way options...
consume() {
  way=$1
  shift
  echo "== $way"
  try "configuring a project with wheelrail $way" \
    "$cmake" -S "$work/consumer" -B "$work/$way" -Dway="$way" -DCMAKE_CXX_COMPILER="$compiler" "$@"
  try "building a project with wheelrail $way" "$cmake" --build "$work/$way"
  "$work/$way/consumer" >"$work/$way.out" || fail "the program with wheelrail $way"
}

consume installed -DCMAKE_PREFIX_PATH="$prefix" -Dwheelrail_version="$version"
echo "$version" >"$work/version"
same "the program knows another version than CMake" "$work/installed.out" "$work/version"
if [ "$brief" = no ]; then
  consume subdirectory -Dwheelrail_source="$root"
  if command -v git >/dev/null; then
    # A repository of what a user of the library needs.
    repository=$work/repository
    mkdir -p -- "$repository"
    cp -R -- "$root/CMakeLists.txt" "$root/include" "$repository"
    try "making a repository" git -C "$repository" init -b main
    try "adding to a repository" git -C "$repository" add .
    try "committing to a repository" git -C "$repository" -c user.name=nobody \
      -c user.email=nobody@localhost commit -m "As it is"
    consume fetched -Dwheelrail_source="$repository"
  else
    echo "== fetched: left out without git"
  fi
fi

echo "== pkg-config, without exceptions and run-time type information"
PKG_CONFIG_PATH=$prefix/share/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
export PKG_CONFIG_PATH
command -v pkg-config >/dev/null || fail "there is no pkg-config"
[ "$(pkg-config --modversion wheelrail)" = "$version" ] ||
  fail "pkg-config's version is $(pkg-config --modversion wheelrail), but must be $version"
# Its words are quoted for a shell.
eval "set -- $(pkg-config --cflags --libs wheelrail)"
try "compiling and linking with pkg-config's flags" "$compiler" -std=c++20 \
  -Werror=deprecated-declarations -fno-exceptions -fno-rtti "$work/consumer/main.cpp" \
  "$work/consumer/other.cpp" -o "$work/no_exceptions" "$@"
"$work/no_exceptions" >"$work/no_exceptions.out" || fail "the program without exceptions"
same "the version without exceptions" "$work/no_exceptions.out" "$work/version"

echo "== what is refused: the same words with exceptions and without"
cd -- "$work"
# shellcheck disable=SC3045 # the shells of Linux have it
ulimit -c 0
for what in value points text file; do
  status=0
  "$work/installed/consumer" "$what" 2>"$work/thrown" || status=$?
  [ "$status" -eq 1 ] || fail "refusing a $what with exceptions ended with $status"
  [ -s "$work/thrown" ] || fail "refusing a $what with exceptions says nothing"
  status=0
  # That it was aborted is said by the shell, elsewhere.
  (exec "$work/no_exceptions" "$what" 2>"$work/printed") 2>/dev/null || status=$?
  [ "$status" -eq 134 ] || fail "refusing a $what without exceptions ended with $status, not abort()"
  same "refusing a $what without exceptions says something else" "$work/thrown" "$work/printed"
  cat -- "$work/printed"
done

# Programs as people would write them, of some 30 lines: each compiles in 10 s, not optimised, and runs.
limit=10
for program in "$work"/programs/*.cpp; do
  name=$(basename -- "$program" .cpp)
  echo "== $name, in $limit s of the processor"
  (
    # shellcheck disable=SC3045
    ulimit -t "$limit"
    try "compiling $name, perhaps for its limit of $limit s" \
      "$compiler" -std=c++20 "$program" -o "$work/programs/$name" "$@"
  ) || exit 1
  "$work/programs/$name" || fail "$name"
done

cd -- "$root"
rm -rf -- "$work"
echo "All ways work."
