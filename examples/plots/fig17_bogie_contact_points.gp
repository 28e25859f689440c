# Fig. 17: where the left wheel of the bogie's leading wheelset touches, every 0.05 s: on the rail
# and on the wheel. Needs `data`.
set datafile separator ","
set multiplot layout 2,1 title "Contact of the left wheel of the leading wheelset, bogie at 18.3 m/s, every 0.05 s"
set grid
set lmargin 12
set key top right
set xlabel "time [s]"
convex = data."/fig17_convex.csv"
real_wheel = data."/fig17_real.csv"
set title "(a) on the rail"
set ylabel "lateral coordinate u_r [mm]"
set offsets graph 0, 0, 0.05, 0.05
plot convex every ::1 using 1:4 with linespoints lw 1 pt 6 ps 0.6 lc rgb "#202020" title "convex", \
     real_wheel every ::1 using 1:4 with linespoints lw 1 pt 7 ps 0.5 lc rgb "#1f4e9c" title "S1002"
set title "(b) on the wheel"
set ylabel "lateral coordinate u_w [mm]"
plot convex every ::1 using 1:2 with linespoints lw 1 pt 6 ps 0.6 lc rgb "#202020" title "convex", \
     real_wheel every ::1 using 1:2 with linespoints lw 1 pt 7 ps 0.5 lc rgb "#1f4e9c" title "S1002"
unset multiplot
