# Fig. 3: the S1002 profile and its convex modification, their slopes, second derivatives and
# curvatures. Needs `data`, the folder with the tables.
set datafile separator ","
file = data."/fig03_profiles.csv"
set multiplot layout 4,2 columnsfirst title "S1002, nominal radius 430 mm: real (left) and convex (right); f_w' is clipped at -4, f_w'' at 1/mm"
set xrange [-72:62]
set xlabel "lateral coordinate u_w [mm]"
set grid
unset key
set lmargin 11
set style data lines
do for [side = 0:1] {
  set title side == 0 ? "real" : "convex"
  set ylabel "f_w [mm]"; set yrange [-460:-425]; set ytics 10
  plot file every ::1 using 1:(column(2 + side)) lw 2 lc rgb "#1f4e9c"
  unset title
  set ylabel "f_w' [-]"; set yrange [-4:4]; set ytics 2
  plot file every ::1 using 1:(column(4 + side)) lw 2 lc rgb "#1f4e9c"
  set ylabel "f_w'' [1/mm]"; set yrange [-2.2:1]; set ytics 1
  plot file every ::1 using 1:(column(6 + side)) lw 2 lc rgb "#1f4e9c"
  set ylabel "curvature [1/mm]"; set yrange [-0.1:0.1]; set ytics 0.05
  plot file every ::1 using 1:(column(8 + side)) lw 2 lc rgb "#1f4e9c"
}
unset multiplot
