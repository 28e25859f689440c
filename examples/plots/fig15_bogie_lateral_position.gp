# Fig. 15: lateral position of the bogie's leading wheelset in the three scenarios, and how far the
# two methods are apart on the convex profile. Needs `data`.
set datafile separator ","
file = data."/fig15_fig16_bogie.csv"
set multiplot
set origin 0, 0.34
set size 1, 0.66
set title "Leading wheelset of a bogie on a tangent track at 18.3 m/s, started 2 mm off centre"
set ylabel "lateral position [mm]"
set xlabel "time [s]"
set grid
set key outside top center horizontal
set lmargin 12
set rmargin 4
plot file every ::1 using 1:2 with lines lw 4 lc rgb "#f0a030" title "convex, minimum distance", \
     file every ::1 using 1:4 with lines lw 2 dt 2 lc rgb "#202020" title "convex, strips", \
     file every ::1 using 1:6 with lines lw 2 lc rgb "#1f4e9c" title "S1002, strips"
set origin 0, 0
set size 1, 0.34
set title "convex profile: strips less minimum distance"
set ylabel "difference [fm]"
set format y "%g"
unset key
plot file every ::1 using 1:(($4 - $2) * 1e12) with lines lw 1 lc rgb "#c02020"
unset multiplot
