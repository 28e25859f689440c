# Fig. 7: where the minimum distance equations have a solution: on the tread (left) in one point, in
# the fillet (right) nearly everywhere along a valley. Needs `data`.
set multiplot layout 2,2 title "Residual of the minimum distance equations (30), no yaw: tread (left) and fillet (right)"
do for [part in "tread fillet"] {
  set title part eq "tread" ? "non-conformal: lateral shift 0 mm" : "conformal: lateral shift 6 mm"
  outlines = data."/fig07_".part."_outlines.dat"
  set xlabel "lateral in the rail's frame [mm]"
  set ylabel "up [mm]"
  set size ratio -1
  set xrange [-60:50]
  set yrange [-35:15]
  set xtics 20
  set ytics 10
  set grid
  set key bottom right
  plot outlines index 0 with lines lw 2 lc rgb "#404040" title "rail", \
       outlines index 1 with lines lw 2 lc rgb "#1f4e9c" title "wheel", \
       outlines index 2 with points pt 7 ps 1 lc rgb "#c02020" title "contact"
}
set size noratio
set key off
set xtics auto
set ytics auto
set autoscale
unset grid
set palette defined (0 "#0b1f4b", 0.35 "#1f6fb4", 0.6 "#7fc6a4", 0.8 "#f4e285", 1 "#f26b38")
set cblabel "log_{10} of the residual (m and cosines)"
set cbrange [-4.5:-0.5]
do for [part in "tread fillet"] {
  set title part
  residual = data."/fig07_".part."_residual.dat"
  # The contact stands in the file's first line.
  contact_u = real(system("head -n 1 ".residual." | sed 's/.*contact at //' | cut -d' ' -f1"))
  contact_r = real(system("head -n 1 ".residual." | sed 's/.*contact at //' | cut -d' ' -f2"))
  set xlabel "u_w [mm]"
  set ylabel "u_r [mm]"
  set xrange [contact_u - 10 : contact_u + 10]
  set yrange [contact_r - 10 : contact_r + 10]
  set label 1 at contact_u, contact_r point pt 1 ps 2 lw 2 lc rgb "#c02020" front
  plot residual using 1:2:3 with image
}
unset multiplot
