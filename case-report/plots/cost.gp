# Time and error of each stage. To draw it again: gnuplot cost.gp
# Data: cost.tsv, in SI units; x_unit and so on turn them into those of the axes.
# Processor time of each stage that ran (left), and the relative errors it leaves (right): the standard error of its main number (full marks) and its numerical error (open marks), of a fit what a further step would change. A tighter tolerance buys nothing where the open mark lies left of the full one.
reset
figure_name = 'cost'; figure_width = 1.6; figure_height = 0.62
load 'style.gp'
load 'output.gp'
set datafile separator "\t"
set border 1
set multiplot
set size 0.62,1
set lmargin 34
set tmargin 3
unset key
set ytics ('master curve' -1, 'roughness' -2, 'friction' -3, 'transverse isotropy' -4) noenhanced scale 0
set yrange [-4.7:-0.3]
x_unit = 1000.0  # from s to ms
set xlabel 'Processor time (ms)'
unset logscale x
set xrange [0:1394.963379]
set xtics 500.0
set format x '%g'
k=0
plot \
  'cost.tsv' index 0 using (0):($2>0 ? -(k=k+1) : NaN):(0):($1*x_unit):(-k-0.35):(-k+0.35) with boxxyerror ls 1
set origin 0.62,0
set size 0.38,1
set lmargin 2
unset ytics
set key outside top center horizontal
x_unit = 1.0  # from 1 to 1
set xlabel 'Relative error'
set logscale x
set xrange [9.753740817e-13:0.05220362465]
set xtics 1e-12,1e2
unset mxtics
set format x '10^{%T}'
k=0
j=0
plot \
  'cost.tsv' index 0 using ($3>0 ? $3*x_unit : NaN):($2>0 ? -(k=k+1) : NaN) with points ls 1 title 'standard error', \
  'cost.tsv' index 0 using ($4>0 ? $4*x_unit : NaN):($2>0 ? -(j=j+1) : NaN) with points ls 2 pt 6 title 'numerical error'
unset multiplot
set output
