# What the directions of the material do. To draw it again: gnuplot transverse_isotropy.gp
# Data: transverse_isotropy.tsv, in SI units; x_unit and so on turn them into those of the axes.
# Hysteresis friction and contact area of the transversely isotropic material against velocity: with its factors on the moduli, with those on one modulus alone and as the isotropic material.
reset
figure_name = 'transverse_isotropy'; figure_width = 1.0; figure_height = 1.5
load 'style.gp'
load 'output.gp'
set datafile separator "\t"
set multiplot layout 2,1
x_unit = 1.0  # from m/s to m/s
set xlabel 'Sliding velocity (m/s)'
set logscale x
set xrange [7.079457844e-5:14.12537545]
set xtics 1e-4,1e1
set mxtics 10
set format x '10^{%T}'
y_unit = 1.0  # from 1 to 1
set ylabel 'Hysteresis friction coefficient'
unset logscale y
set yrange [0:0.8365840644]
set ytics 0.2
set format y '%g'
plot \
  'transverse_isotropy.tsv' index 0 using ($1*x_unit):($2*y_unit) with lines ls 23 title 'isotropic', \
  'transverse_isotropy.tsv' index 1 using ($1*x_unit):($2*y_unit) with lines ls 22 title 'factors on E″ alone', \
  'transverse_isotropy.tsv' index 2 using ($1*x_unit):($2*y_unit) with lines ls 21 title 'factors on E′ alone', \
  'transverse_isotropy.tsv' index 3 using ($1*x_unit):($2*y_unit) with lines ls 24 title 'both'
unset key
y_unit = 1.0  # from 1 to 1
set ylabel 'Real over nominal contact area'
unset logscale y
set yrange [0:0.06345197232]
set ytics 0.01
set format y '%g'
plot \
  'transverse_isotropy.tsv' index 0 using ($1*x_unit):($3*y_unit) with lines ls 23 title 'isotropic', \
  'transverse_isotropy.tsv' index 1 using ($1*x_unit):($3*y_unit) with lines ls 22 title 'factors on E″ alone', \
  'transverse_isotropy.tsv' index 2 using ($1*x_unit):($3*y_unit) with lines ls 21 title 'factors on E′ alone', \
  'transverse_isotropy.tsv' index 3 using ($1*x_unit):($3*y_unit) with lines ls 24 title 'both'
unset key
unset multiplot
set output
