# Fig. 16: magnitude of the normal force on the left wheel of the bogie's leading wheelset, once the
# drop onto the rails has died away. Needs `data`.
set datafile separator ","
file = data."/fig15_fig16_bogie.csv"
set title "Normal force on the left wheel of the leading wheelset, bogie at 18.3 m/s, after the first second"
set xlabel "time [s]"
set ylabel "normal force [kN]"
set format y "%.3f"
set xrange [1:*]
set grid
set key outside top center horizontal
plot file every ::1 using 1:3 with lines lw 4 lc rgb "#f0a030" title "convex, minimum distance", \
     file every ::1 using 1:5 with lines lw 2 dt 2 lc rgb "#202020" title "convex, strips", \
     file every ::1 using 1:7 with lines lw 2 lc rgb "#1f4e9c" title "S1002, strips"
