# Fig. 13: the left wheel's contact point every 0.05 s on the convex and the real profile, zoomed to
# where it is, and its place on the rail over time. Needs `data`.
set datafile separator ","
profiles = data."/fig03_profiles.csv"
set multiplot layout 2,2 title "Contact point of the left wheel every 0.05 s"
set grid
set lmargin 12
set tmargin 3
set bmargin 4
do for [part in "convex real"] {
  set title part eq "convex" ? "(a) convex profile: on the wheel" : "(b) S1002: on the wheel"
  set xlabel "lateral coordinate u_w [mm]"
  set ylabel "f_w [mm]"
  set xrange [8:16]
  set yrange [-429.81:-429.73]
  set xtics 1
  set ytics 0.02
  set format y "%.2f"
  set key top left
  plot profiles every ::1 using 1:2 with lines lw 2 dt 2 lc rgb "#808080" title "S1002", \
       profiles every ::1 using 1:3 with lines lw 2 lc rgb "#1f4e9c" title "convex", \
       data."/fig13_".part.".csv" every ::1 using 2:3 with points pt 6 ps 0.7 lc rgb "#c02020" title "contact"
  set title part eq "convex" ? "convex profile: on the rail" : "S1002: on the rail"
  set xlabel "time [s]"
  set ylabel "lateral coordinate u_r [mm]"
  set xrange [0:*]
  set yrange [10.35:10.75]
  set xtics auto
  set ytics 0.1
  set format y "%.1f"
  unset key
  plot data."/fig13_".part.".csv" every ::1 using 1:4 with points pt 6 ps 0.7 lc rgb "#c02020"
}
unset multiplot
