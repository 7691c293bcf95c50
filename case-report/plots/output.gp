# weartrack: what a figure is drawn on. The style has set the terminal for svg; figure_format 'pdf' or
# 'png' takes its place, with the same type and lines:
#   gnuplot -e "figure_format = 'pdf'" friction.gp
if (!exists("figure_format")) figure_format = 'svg'
# In a copy of the folder: a report written again removes what it did not write.
# What a style of one's own may leave out.
if (!exists("panel_width")) panel_width = 620
if (!exists("panel_height")) panel_height = 0.6935*panel_width
if (!exists("figure_font")) figure_font = 'Helvetica'
if (!exists("figure_type")) figure_type = 15
# Sizes are in units of 8/15 point, so that type of 15 units is that of a figure in a journal, 8 points.
figure_unit = 8./15
figure_dots = 600/72. # of a bitmap in a point, at 600 dpi
# In Cairo's terminals a point of type is 4/3 point, a line of 1 is half a point or one dot, and a dash
# is about half as long as in svg.
if (figure_format eq 'pdf') {
  set terminal pdfcairo size panel_width*figure_width*figure_unit/72.+0.01,panel_height*figure_height*figure_unit/72.+0.01 enhanced font figure_font.sprintf(',%g', figure_type*figure_unit) fontscale 0.75 linewidth 2*figure_unit dashlength 1.8 background '#ffffff'
}
if (figure_format eq 'png') {
  set terminal pngcairo size panel_width*figure_width*figure_unit*figure_dots,panel_height*figure_height*figure_unit*figure_dots enhanced font figure_font.sprintf(',%g', figure_type*figure_unit) fontscale 0.75*figure_dots linewidth figure_unit*figure_dots pointscale figure_dots dashlength 1.8 background '#ffffff'
}
set output figure_name.'.'.figure_format
