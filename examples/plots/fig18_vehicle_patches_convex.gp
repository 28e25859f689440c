# Fig. 18: the patches of the outer wheel of the leading wheelset with the convex profile: where they are over time,
# and their ellipses at four instants with their normal forces. Needs `data`.
patches = data."/fig18_convex_patches.csv"
ellipses = data."/fig18_convex_ellipses.dat"
set multiplot title "Right (outer) wheel of the leading wheelset, vehicle in a left curve of 300 m, the convex profile"
set grid
set lmargin 12
set rmargin 4
set origin 0, 0.5
set size 1, 0.46
set datafile separator ","
set title "(a) patches, coloured by how many the wheel has"
set xlabel "time [s]"
set xrange [0:*] noextend
set ylabel "lateral coordinate u_w [mm]"
set yrange [-50:30]
set key outside top center horizontal
count(n) = column(2) == n ? column(4) : NaN
plot patches every ::1 using 1:(count(1)) with points pt 7 ps 0.5 lc rgb "#1f4e9c" title "one patch", \
     patches every ::1 using 1:(count(2)) with points pt 7 ps 0.5 lc rgb "#f0a030" title "two", \
     patches every ::1 using 1:(column(2) > 2 ? column(4) : NaN) with points pt 7 ps 0.5 lc rgb "#c02020" title "three or more"
set datafile separator whitespace
unset key
set xrange [-48:28]
set yrange [-15:15]
set xtics 10
set ytics 5
set xlabel "u_w [mm]"
set ylabel "longitudinal [mm]"
set lmargin 10
set rmargin 2
instants = "1 6 20 36.4"
do for [i = 0:3] {
  set origin 0.5 * (i % 2), i < 2 ? 0.25 : 0
  set size 0.5, 0.25
  set size ratio -1
  set title "(".word("b c d e", i + 1).") t = ".word(instants, i + 1)." s"
  plot ellipses index i using 1:2 with filledcurves closed fc rgb "#8fb0dc", \
       ellipses index i using 1:2 with lines lw 2 lc rgb "#1f4e9c", \
       ellipses index i every ::18::18 using 1:(int(column(-1)) % 2 ? -$2 - 3 : $2 + 3):(sprintf("%.1f kN", $3)) with labels
}
unset multiplot
