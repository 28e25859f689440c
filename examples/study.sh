#!/bin/sh
# Build the paper's study on Debian 12 or 13, run it and draw its figures: all lands in build/study.
set -eu

root=$(cd -- "$(dirname -- "$0")/.." && pwd)
cd -- "$root"
# shellcheck source=tests/support/install_packages.sh
. tests/support/install_packages.sh
install_packages g++ cmake make libeigen3-dev catch2 libbenchmark-dev gnuplot-nox

cmake -S . -B build/study-build -DCMAKE_BUILD_TYPE=Release -DWHEELRAIL_BUILD_TESTS=OFF \
  -DWHEELRAIL_BUILD_EXAMPLES=ON
cmake --build build/study-build --parallel "$(nproc)"

build/study-build/examples/three_case_study --output build/study

for plot in examples/plots/fig*.gp; do
  name=$(basename -- "$plot" .gp)
  gnuplot -e "data='build/study'; set terminal pngcairo size 1200,900 font ',11'; \
    set output 'build/study/$name.png'" "$plot"
  gnuplot -e "data='build/study'; set terminal svg size 1200,900 dynamic font ',14' background 'white'; \
    set output 'build/study/$name.svg'" "$plot"
done
echo "tables, pictures and report.md: build/study/"
