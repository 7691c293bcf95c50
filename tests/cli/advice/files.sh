# Files that the rows share. SPDX-License-Identifier: GPL-3.0-or-later

# sweep TEMPERATURE...: rows of T, f, E' and E'' of a rubber whose shift factors are 10 per 10 K
sweep() {
  for t in "$@"; do
    awk -v t="$t" 'BEGIN { for (f = 1; f <= 100.001; f *= 10 ^ 0.25) {
      x = (f * 10 ^ ((20 - t) / 10)) ^ 0.3
      printf "%g,%.6g,%.6g,%.6g\n", t, f, 3 + x, 0.50953 * x } }'
  done
}
tip=pyramid:half-angle=20deg,radius=20nm
curve=$fixtures/case/bulk-1.jpk-force-map track=$fixtures/case/track-1.jpk-force-map
dma=$fixtures/case/dma.txt road=$fixtures/case/road-1.gsf
{ echo "T (C),f (Hz),E' (MPa),E'' (MPa)"; sweep 10 20 30; } > three.csv
{ echo "f (Hz),E' (MPa),E'' (MPa)"; sweep 20 | cut -d, -f2-; } > one.csv
{ printf "T\tf\tE'\tE''\n"; sweep 10 20 30 | tr , '\t'; } > unitless.txt
"$weartrack" master -q --poisson-ratio 0.5 three.csv -o three.h5 2> err
"$weartrack" indent -q --tip "$tip" --spring-constant 0.3N/m "$curve" -o bulk.h5 2> err
"$weartrack" indent -q --tip "$tip" --spring-constant 0.3N/m --group track "$track" -o track.h5 2> err
surface=self-affine:q0=2e3rad/m,q1=2e6rad/m,hurst=0.8,c0=2e-17m^4
slide="--material three.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s"
{ echo "T (C),E' (MPa),E'' (MPa)"; for t in 0 10 20 30 40; do echo "$t,$((100 - 2 * t)),$((9 + t % 20))"; done; } > ramp.csv
{ echo "T (C),f (Hz),E' (MPa),E'' (MPa),Sample"
  for s in a b; do sweep 10 20 30 | sed "s/\$/,$s/"; done; } > samples.csv
"$weartrack" master -q --poisson-ratio 0.5 samples.csv -o samples.h5 2> err
"$weartrack" master -q --poisson-ratio 0.5 three.csv -o prony.tsv 2> err
{ echo "Temp,Hertz,Stor,Los"; sweep 10 20 30; } > foreign.csv
{ echo "T (C),f (Hz),Storage modulus (MPa),Loss modulus (MPa)"; sweep 20 30 40; } > unnamed.csv
echo nothing > empty.txt
