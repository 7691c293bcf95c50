# Friction against sliding velocity. To draw it again: gnuplot friction.gp
# Data: friction.tsv, in SI units; x_unit and so on turn them into those of the axes.
# Friction coefficient and its parts against sliding velocity. Bands: one standard error (from material with its shift law, roughness). Conditions: nominal pressure 400 kPa, temperature 20 °C. Largest numerical error of the hysteresis part: 2.0×10⁻¹⁰ %, not in the bands. Less than 0.1 % of the hysteresis part comes from frequencies outside the measured ones.
reset
figure_name = 'friction'; figure_width = 1.0; figure_height = 1.0
load 'style.gp'
load 'output.gp'
set datafile separator "\t"
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
set yrange [0:0.750552557]
set ytics 0.1
set format y '%g'
plot \
  'friction.tsv' index 0 using ($1*x_unit):($4-$5):($4+$5) with filledcurves ls 72 title 'one standard error', \
  'friction.tsv' index 0 using ($1*x_unit):4 with lines ls 22 title 'hysteresis'
set output
