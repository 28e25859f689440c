# Wheel and rail with lines between corresponding contact points, rolling radius difference and
# equivalent conicity, as contact_kinematics writes them. Needs `data`, their folder, and `heading`.
set encoding utf8
table = data."/contact_lines.dat"
# Blocks 0 to 2 are the left side's wheel, rail and lines, 3 to 5 the right side's.
stats table index 2 using 3 nooutput
set cbrange [STATS_min:STATS_max + 1e-6]
stats table index 0:1 using 1 nooutput
left_most = STATS_max + 5
left_least = STATS_min - 5
stats table index 3:4 using 1 nooutput
right_most = STATS_max + 5
right_least = STATS_min - 5

set multiplot title heading noenhanced
set grid lt 1 lw 0.6 lc rgb "#dcdcdc"
set tmargin 0
set bmargin 0
set lmargin 0
set rmargin 0

# Seen along the track: left is left.
set size ratio -1
set xlabel "lateral position in the track, positive to the left [mm]"
set ylabel "height [mm]"
set cblabel "lateral shift to the left [mm]"
set palette defined (0 "#1f4e9c", 0.5 "#30a030", 1 "#c02020")
set colorbox user origin 0.925, 0.57 size 0.015, 0.30
unset key
set yrange [-45:75]
set xtics 20
set ytics 20
set label 1 "wheel at shift 0, lifted by 30 mm" at graph 0.02, 0.95
set label 2 "rail" at graph 0.02, 0.05
do for [right = 0:1] {
  block = 3*right
  set origin (right == 0 ? 0.065 : 0.50), 0.53
  set size 0.40, 0.40
  set title (right == 0 ? "left side" : "right side")
  set xrange [(right == 0 ? left_most : right_most):(right == 0 ? left_least : right_least)]
  plot table index (block + 2) using 1:2:3 with lines lw 1.2 lc palette, \
       table index (block + 2) using 1:2:3 with points pt 7 ps 0.4 lc palette, \
       table index (block) using 1:2 with lines lw 2 lc rgb "#202020", \
       table index (block + 1) using 1:2 with lines lw 2 lc rgb "#202020"
}

# A missing value breaks the line.
set datafile separator ","
unset label 1
unset label 2
unset colorbox
set size noratio
set autoscale x
set autoscale y
set xtics autofreq
set ytics autofreq
set size 0.40, 0.32
set origin 0.085, 0.075
set title "rolling radius difference"
set xlabel "lateral shift to the left [mm]"
set ylabel "left less right radius [mm]"
plot data."/rolling_radius_difference.csv" every ::1 using 1:($2) with lines lw 2 lc rgb "#1f4e9c"
set origin 0.555, 0.075
set title "equivalent conicity"
set xlabel "amplitude [mm]"
set ylabel "conicity [-]"
set xrange [0:8]
set yrange [0:*]
plot data."/conicity.csv" every ::1 using 1:($2) with lines lw 2 lc rgb "#1f4e9c", \
     0 with lines lc rgb "#808080"
unset multiplot
