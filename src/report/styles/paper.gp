# weartrack plot style "paper": for a page of text.
# Each script sets figure_width and figure_height, in panels of this style, and loads this file; of a
# figure of a given width it sets panel_width, too. Sizes are in units of 8/15 point.
set encoding utf8
if (!exists("panel_width")) panel_width = 620
if (!exists("figure_font")) figure_font = 'Helvetica'
# Type has its size in any panel: a narrow one is not as flat. 430 of 620.
panel_height = 0.45*panel_width + 151
figure_type = 15
set terminal svg size int(panel_width*figure_width+0.5),int(panel_height*figure_height+0.5) dynamic enhanced font figure_font.sprintf(',%g', figure_type) background '#ffffff'

set border 3 lw 1.1 lc rgb '#333333'
set tics nomirror out scale 0.8,0.4 textcolor rgb '#1a1a1a'
set title offset 0,-0.4
set key tmargin left horizontal reverse Left samplen 2 width -0.5 maxcols 5
set lmargin 10
set bmargin 3.6
set rmargin 3
set errorbars small

# Dark blue and light orange differ for every kind of colour vision, and in grey.
# 1 bulk, 2 track, 3 to 6 other groups; 30 more: the same on the way back; 40 more: single curves.
set style line 1 lc rgb '#0b4f8a' lw 2 dt solid pt 7 ps 0.75
set style line 2 lc rgb '#e88a0c' lw 2 dt solid pt 9 ps 0.9
set style line 3 lc rgb '#0f8f6b' lw 2 dt solid pt 5 ps 0.7
set style line 4 lc rgb '#b8569a' lw 2 dt solid pt 13 ps 0.95
set style line 5 lc rgb '#555555' lw 2 dt solid pt 11 ps 0.9
set style line 6 lc rgb '#7a1f2b' lw 2 dt solid pt 6 ps 0.75
set style line 31 lc rgb '#8fb0d3' lw 1.6 dt (8,4) pt 7 ps 0.75
set style line 32 lc rgb '#f2bd7a' lw 1.6 dt (8,4) pt 9 ps 0.9
set style line 33 lc rgb '#8fcdb9' lw 1.6 dt (8,4) pt 5 ps 0.7
set style line 34 lc rgb '#dba9cb' lw 1.6 dt (8,4) pt 13 ps 0.95
set style line 35 lc rgb '#aaaaaa' lw 1.6 dt (8,4) pt 11 ps 0.9
set style line 36 lc rgb '#bf8a91' lw 1.6 dt (8,4) pt 6 ps 0.75
set style line 41 lc rgb '#6f9ccb' lw 1 dt solid pt 7 ps 0.6
set style line 42 lc rgb '#f2b566' lw 1 dt solid pt 9 ps 0.72
set style line 43 lc rgb '#8fcdb9' lw 1 dt solid pt 5 ps 0.56
set style line 44 lc rgb '#dba9cb' lw 1 dt solid pt 13 ps 0.76
set style line 45 lc rgb '#aaaaaa' lw 1 dt solid pt 11 ps 0.72
set style line 46 lc rgb '#bf8a91' lw 1 dt solid pt 6 ps 0.6

# 11 fitted law, 12 mark or guide, 13 mean with its interval, 14 point without weight, 15 second law,
# 16 white rim of 14 on a map
set style line 11 lc rgb '#111111' lw 1.6 dt solid
set style line 12 lc rgb '#777777' lw 1.1 dt (3,3)
set style line 13 lc rgb '#111111' lw 2 dt solid pt 7 ps 0.8
set style line 14 lc rgb '#555555' lw 2.0 dt solid pt 6 ps 0.8
set style line 15 lc rgb '#111111' lw 1.6 dt (8,4)
set style line 16 lc rgb '#ffffff' lw 5.0 dt solid pt 6 ps 0.8

# 21 the whole, 22 and 23 its two parts, 24 the whole with a layer; 50 more and 81 to 86, of groups: bands of error, see-through
set style line 21 lc rgb '#111111' lw 2.4 dt solid pt 7 ps 0.6
set style line 22 lc rgb '#0b4f8a' lw 2.2 dt (10,4) pt 7 ps 0.5
set style line 23 lc rgb '#2f9bd6' lw 2.2 dt (10,4,2,4)
set style line 24 lc rgb '#e88a0c' lw 2.4 dt (6,3) pt 9 ps 0.75
set style fill solid 1 noborder
set style line 71 lc rgb '#c0555555'
set style line 72 lc rgb '#c00b4f8a'
set style line 74 lc rgb '#b0e88a0c'
set style line 81 lc rgb '#b00b4f8a'
set style line 82 lc rgb '#b0e88a0c'
set style line 83 lc rgb '#b00f8f6b'
set style line 84 lc rgb '#b0b8569a'
set style line 85 lc rgb '#b0555555'
set style line 86 lc rgb '#b07a1f2b'

# 61 interval of a fitted law or spectrum, behind points
set style line 61 lc rgb '#c4c4c4'

# 51 and 52 points that take their colour from the palette: full and open
set style line 51 lw 1.2 pt 7 ps 0.6
set style line 52 lw 1.2 pt 6 ps 0.6
set palette defined (0 '#2b0b57', 0.25 '#31558c', 0.5 '#1f8f8b', 0.75 '#5fc161', 1 '#d9c80f') maxcolors 32
set colorbox user origin graph 1.03, graph 0 size graph 0.035, graph 1
