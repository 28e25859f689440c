#!/bin/sh
# Every header compiles alone, without exceptions and run-time type information, warnings as errors
# (among them that of functions that Eigen calls deprecated).
#
# Most of a header's own time would go into <Eigen/Core>. So that is precompiled, and put before the
# headers that include it anyway, directly or not. This hides nothing: a header's includes come before
# all else in it, so what it and the headers below it say is read after <Eigen/Core> either way,
# unless one of them lacks the include; and that one is compiled here too, without.
# With exceptions nothing is different but core/require.hpp, the one header that asks for them.
set -eu

usage() {
  cat <<'TEXT'
usage: tests/packaging/headers_test.sh --compiler CXX --work FOLDER [--help] -- FLAGS...

  --compiler CXX  the compiler
  --work FOLDER   is emptied, written to, and removed where all is well
  --help          print this
  FLAGS           for every header: the standard, include folders, warnings
TEXT
}

compiler=
work=
while [ $# -gt 0 ]; do
  case $1 in
    --compiler | --work)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      case $1 in
        --compiler) compiler=$2 ;;
        --work) work=$2 ;;
      esac
      shift 2
      ;;
    --) shift; break ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
if [ -z "$compiler" ] || [ -z "$work" ]; then
  usage >&2
  exit 2
fi

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
rm -rf -- "$work"
mkdir -p -- "$work"
work=$(cd -- "$work" && pwd)
cd -- "$root/include"
failures=0
fault() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
  [ "$failures" -lt 8 ] || { echo "and perhaps more" >&2; exit 1; }
}

find wheelrail -name '*.hpp' | LC_ALL=C sort >"$work/headers"

# For each header, whether its includes end before all else, and whether <Eigen/Core> is among them
# or among those of the headers below. Any other header of Eigen includes <Eigen/Core>.
# shellcheck disable=SC2016 # awk's own dollars
xargs awk '
  FNR == 1 { code = 0 }
  /^[ \t]*#[ \t]*include/ {
    if (code) print "late", FILENAME
    name = $0
    sub(/^[^<]*</, "", name)
    sub(/>.*/, "", name)
    if (name ~ /^Eigen\//) eigen[FILENAME] = 1
    else below[FILENAME] = below[FILENAME] " " name
    next
  }
  !/^[ \t]*(\/\/|#pragma once|$)/ { code = 1 }
  { file[FILENAME] = 1 }
  END {
    do {
      changed = 0
      for (f in file) {
        if (f in eigen) continue
        n = split(below[f], names, " ")
        for (i = 1; i <= n; ++i) if (names[i] in eigen) { eigen[f] = changed = 1; break }
      }
    } while (changed)
    for (f in file) print (f in eigen ? "eigen" : "plain"), f
  }' <"$work/headers" | LC_ALL=C sort -k 2 >"$work/kinds"
[ "$(grep -c -v '^late' "$work/kinds")" -eq "$(wc -l <"$work/headers")" ] ||
  fault "not every header was read"
late=$(sed -n 's/^late //p' "$work/kinds" | uniq)
[ -z "$late" ] || fault "includes come after something else in: $late"

# What these flags change, but for the one header that asks.
# shellcheck disable=SC2046 # a list of words
if grep -nE '\b(throw|try|catch|typeid|dynamic_cast|__cpp_exceptions|__EXCEPTIONS)\b' \
  $(grep -v '^wheelrail/core/require.hpp$' "$work/headers") |
  grep -vE '^[^:]*:[0-9]*:([^"]*[^"/])?//'; then
  fault "only core/require.hpp may have to do with exceptions, and nothing with type information"
fi

# What Eigen 3.4 allows and Eigen 5 has moved, removed, deprecated or changed, by its release notes.
# What 3.4 deprecates is refused by the compiler, here or where a test instantiates it.
# shellcheck disable=SC2046 # a list of words
if grep -nE -e '\bEIGEN_HAS_|\bEIGEN_NO_DEPRECATED_WARNING\b|\bEigen::(all|last|lastp1)\b' \
  -e '\bEigen::placeholders\b|\b(jacobiSvd|JacobiSVD|bdcSvd|BDCSVD|eulerAngles)\b' \
  $(cat "$work/headers"); then
  fault "Eigen 5 has something else in the place of these"
fi

plain="-fno-exceptions -fno-rtti"
echo '#include <Eigen/Core>' >"$work/eigen.hpp"
# shellcheck disable=SC2086 # two words
if "$compiler" --version 2>/dev/null | grep -q clang; then
  "$compiler" "$@" $plain -x c++-header "$work/eigen.hpp" -o "$work/eigen.pch"
  before="-include-pch $work/eigen.pch"
  few=-ferror-limit=3
else
  "$compiler" "$@" $plain -x c++-header "$work/eigen.hpp" -o "$work/eigen.hpp.gch"
  before="-include $work/eigen.hpp -Winvalid-pch"
  few=-fmax-errors=3
fi

# usage: compile header flags...
compile() {
  header=$1
  shift
  echo "#include <$header>" >"$work/alone.cpp"
  "$compiler" "$@" -Werror "$few" -fsyntax-only "$work/alone.cpp" || fault "$header, alone"
}
count=0
while read -r kind header; do
  # shellcheck disable=SC2086 # lists of words
  case $kind in
    eigen) compile "$header" "$@" $plain $before ;;
    plain) compile "$header" "$@" $plain ;;
    *) continue ;;
  esac
  count=$((count + 1))
done <"$work/kinds"
compile wheelrail/core/require.hpp "$@"
compile wheelrail/wheelrail.hpp "$@"

[ "$failures" -eq 0 ] || exit 1
rm -rf -- "$work"
echo "$count headers compile alone."
