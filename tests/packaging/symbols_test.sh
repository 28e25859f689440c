#!/bin/sh
# No global or static mutable state: of what tests and examples instantiate, nothing of the library lies in a
# writable section. Reads the object files of the folder $1.
set -eu

objects=$(find "$1" -name packaging -prune -o -name '*.cpp.o' -print)
[ -n "$objects" ] || { echo "no object files below $1" >&2; exit 1; }

# Names of the library as the linker knows them (9wheelrail; the tests' own are 14wheelrail_test, or
# in a namespace without a name), variables and the guards of static ones among them, in the sections
# that are written to. __odr_asan is the address sanitizer's own, one byte for each constant too.
# shellcheck disable=SC2086 # a list of words
found=$(objdump -t $objects | grep -E ' \.(data|bss|tdata|tbss)[^ ]*' | grep -v '\.data\.rel\.ro' |
  grep '9wheelrail' | grep -vE '12_GLOBAL__N_1|14wheelrail_test|__odr_asan' | grep -vE ' (df|d) ' || true)
# shellcheck disable=SC2086
count=$(objdump -t $objects | grep -c '9wheelrail' || true)
if [ -n "$found" ]; then
  echo "the library has mutable state:" >&2
  echo "$found" | c++filt >&2
  exit 1
fi
[ "$count" -gt 1000 ] || { echo "only $count symbols of the library: this shows nothing" >&2; exit 1; }
echo "None of $count symbols of the library is mutable."
