# Fig. 13: the left wheel's contact point every 0.05 s on the convex and the real profile.
# Needs `data`.
set datafile separator ","
profiles = data."/fig03_profiles.csv"
set multiplot layout 2,1 title "Contact point of the left wheel every 0.05 s"
set xlabel "lateral coordinate u_w [mm]"
set ylabel "f_w [mm]"
set xrange [-45:35]
set yrange [-445:-427]
set grid
set key bottom right
do for [part in "convex real"] {
  set title part eq "convex" ? "(a) convex profile" : "(b) S1002"
  plot profiles every ::1 using 1:2 with lines lw 2 dt 2 lc rgb "#808080" title "S1002", \
       profiles every ::1 using 1:3 with lines lw 2 lc rgb "#1f4e9c" title "convex", \
       data."/fig13_".part.".csv" every ::1 using 2:3 with points pt 5 ps 0.7 lc rgb "#c02020" title "contact"
}
unset multiplot
