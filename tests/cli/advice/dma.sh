# Materials. SPDX-License-Identifier: GPL-3.0-or-later

sed 's/20,10,/20,9.9,/' samples.csv > more.csv
piece 'choose one with --sample NAME; --sample all if they are of one material'
cause '--sample NAME' ramp samples.csv
helps master --sample a samples.csv more.csv --poisson-ratio 0.5 -o a.h5

piece 'choose one with --sample NAME, here or of weartrack master'
cause 'choose one with --sample NAME, here or of weartrack master' friction --material samples.h5 \
  --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
helps friction --sample a --material samples.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
helps master -q --poisson-ratio 0.5 --sample a samples.csv -o a.h5

piece 'taken as one material measured again; if each file is of a material'
sed 's/^20,10,/20,9.9,/' three.csv > other.csv
cause '--sample-by file' master --poisson-ratio 0.5 three.csv other.csv -o a.h5
helps master --poisson-ratio 0.5 --sample-by file three.csv other.csv -o a.h5
says 'other'

piece 'choose one with --strain %.3g%%'
{ echo "T (C),f (Hz),strain (%),E' (MPa),E'' (MPa)"
  for e in 0.1 1; do sweep 10 20 30 | awk -F, -v e=$e '{ print $1 "," $2 "," e "," $3 * (1.1 - 0.1 * e) "," $4 * (1.1 - 0.1 * e) }'; done; } > strains.csv
cause '--strain 0.1%' master --poisson-ratio 0.5 strains.csv -o a.h5
helps master --poisson-ratio 0.5 --strain 0.1% strains.csv -o a.h5

piece '`weartrack master` makes storage and loss modulus of them'
relaxation=$fixtures/formats/table-step/relaxation-two-temperatures.txt
cause '`weartrack master` makes storage' ramp "$relaxation" -o a.h5
helps master "$relaxation" -o a.h5

{ echo "T (C),f (Hz),strain (%),E' (MPa),E'' (MPa),Sample"
  for s in a b; do for t in 20 40; do for e in 0.1 0.3 1 3 10; do
    awk -v e=$e -v t=$t -v s=$s 'BEGIN { printf "%s,10,%s,%g,%g,%s\n", t, e, 5 + 5 / (1 + e), 1 + e / (1 + e * e), s }'
  done; done; done; } > payne.csv
"$weartrack" payne -q payne.csv -o payne.h5 2> err
piece '`weartrack payne FILE` reports how the rubber softens with strain' 'see `weartrack payne`' 'weartrack payne'
payne=payne.csv
cause '`weartrack payne FILE`' master "$payne" -o a.h5
helps payne "$payne" -o a.h5
cause '`weartrack payne FILE`' ramp "$payne" -o a.h5
cause 'see `weartrack payne`' master --poisson-ratio 0.5 --sample all three.csv "$payne" -o a.h5

piece 'give the law of the shifts (--shift-law wlf:...)'
cause '`weartrack ramp FILE`' master --frequency 10Hz ramp.csv -o a.h5
helps ramp --frequency 10Hz ramp.csv -o a.h5
leads master --frequency 10Hz --shift-law wlf:reference-temperature=20degC,c1=8.86,c2=101.6K ramp.csv -o a.h5

no_input '--reference-at tan-del' 'the reference is put elsewhere by itself unless it is stated, and then it is kept'

no_input 'give it by --prony-long-term' 'a fitted series without a long-term modulus'

piece 'give --reference-temperature'
{ printf "# angular_frequency[rad/s]\tstorage_modulus[Pa]\tloss_modulus[Pa]\n"
  sweep 20 | awk -F, '{ printf "%g\t%g\t%g\n", 6.2832 * $2, 1e6 * $3, 1e6 * $4 }'; } > plain.tsv
cause 'give --reference-temperature' friction --material plain.tsv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --sliding-temperature 40degC
leads friction --reference-temperature 20degC --material plain.tsv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --sliding-temperature 20degC

piece 'shift the others, or give another --reference-temperature'
cause 'give another --reference-temperature' master --poisson-ratio 0.5 --reference-temperature 20degC --shift 20degC=0.1 three.csv -o a.h5
helps master --poisson-ratio 0.5 --reference-temperature 30degC --shift 20degC=1.1 three.csv -o a.h5
helps master --poisson-ratio 0.5 --reference-temperature 20degC --shift 30degC=-0.9 three.csv -o a.h5

piece 'give --reference-temperature in place of --reference-at'
cause 'in place of --reference-at' master --poisson-ratio 0.5 --reference-at tan-delta-peak --shift 30degC=-0.9 three.csv -o a.h5
helps master --poisson-ratio 0.5 --reference-temperature 20degC --shift 30degC=-0.9 three.csv -o a.h5

piece 'leave out its column log_b, or give another --vertical-shift'
"$weartrack" master -q --poisson-ratio 0.5 --vertical-shift tied three.csv --save-shifts shifts.tsv -o a.h5 2> err
cause 'another --vertical-shift' master --poisson-ratio 0.5 --vertical-shift none --shifts shifts.tsv three.csv -o a.h5
helps master --poisson-ratio 0.5 --vertical-shift tied --shifts shifts.tsv three.csv -o a.h5
cut -f1,2 shifts.tsv > a-only.tsv
helps master --poisson-ratio 0.5 --vertical-shift none --shifts a-only.tsv three.csv -o a.h5

piece 'temperature[K] and log_a[1], as weartrack master --save-shifts writes them' 'what weartrack master wrote, or a text table that begins with a line such as'
printf '# a[1]\tb[1]\n1\t2\n' > wrong.tsv
cause 'weartrack master --save-shifts writes them' master --poisson-ratio 0.5 --shifts wrong.tsv three.csv -o a.h5
helps master --poisson-ratio 0.5 --shifts shifts.tsv three.csv -o a.h5
cause '# temperature[degC]<TAB>log_a[1]' master --poisson-ratio 0.5 --shifts empty.txt three.csv -o a.h5
printf '# temperature[degC]\tlog_a[1]\n10\t1\n20\t0\n30\t-1\n' > typed.tsv
helps master --poisson-ratio 0.5 --shifts typed.tsv three.csv -o a.h5

piece 'columns strain, f and g, and f_error and g_error if they are known' 'what weartrack payne wrote, or a text table that begins with a line such as'
cause 'as weartrack payne writes it' friction $slide --strain-softening wrong.tsv
cause '# strain[1]<TAB>f[1]<TAB>g[1]' friction $slide --strain-softening empty.txt
printf '# strain[1]\tf[1]\tg[1]\n0.001\t1\t1\n0.01\t0.9\t1\n0.1\t0.7\t0.9\n' > softening.tsv
helps friction $slide --strain-softening softening.tsv

piece 'leave --softening-temperature out'
cause 'leave --softening-temperature out' friction $slide --strain-softening softening.tsv --softening-temperature 20degC
helps friction $slide --strain-softening softening.tsv
piece '--softening-temperature goes with --strain-softening'
cause '--softening-temperature goes with --strain-softening' friction $slide --softening-temperature 20degC
helps friction $slide --strain-softening softening.tsv

piece 'choose one with --softening-temperature T' 'choose one with --sample NAME, here if the moduli are of that sample'
cause '--softening-temperature T' friction --sample a --material samples.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --strain-softening payne.h5
helps friction --sample a --softening-temperature 20degC --material samples.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --strain-softening payne.h5
cause 'choose one with --sample NAME, here if' friction $slide --strain-softening payne.h5
"$weartrack" payne -q --sample a payne.csv -o payne-a.h5 2> err
leads friction $slide --softening-temperature 20degC --strain-softening payne-a.h5
piece '--sample is of moduli and strain sweeps alike'
{ echo "T (C),f (Hz),E' (MPa),E'' (MPa),Sample"; sweep 10 20 30 | sed 's/$/,c/'; } > c.csv
"$weartrack" master -q --poisson-ratio 0.5 c.csv -o c.h5 2> err
cause '--sample is of moduli and strain sweeps alike' friction --sample c --material c.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --strain-softening payne.h5 --softening-temperature 20degC
helps friction --material c.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --strain-softening softening.tsv

piece 'the reduced Prony series of %zu term%s deviates from the spectrum'
cause 'of --prony-error' master --poisson-ratio 0.5 --prony-terms 1 three.csv -o a.h5
helps master --poisson-ratio 0.5 --prony-error 50% three.csv -o a.h5

message='a table without its keys'
no_input 'give the prony table of `weartrack master`' 'the schema of the table is checked before'
awk '/^## equilibrium_modulus/ && !n++ { next } { print }' prony.tsv > prony-only.tsv
cause 'give the output of `weartrack master`' friction --material prony-only.tsv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
helps friction $slide
no_input 'make the file anew with `weartrack master`' 'tables of draws that contradict each other: the program writes none'

piece '--export %s: expected abaqus'
cause '--export rubber.inp: expected abaqus' master --poisson-ratio 0.5 three.csv --export rubber.inp -o a.h5
helps master --poisson-ratio 0.5 three.csv --export abaqus:rubber.inp -o a.h5

piece 'give --prony-terms %zu'
cause 'give one, such as 0.499' master --poisson-ratio 0.5 three.csv --export ls-dyna:rubber.k -o a.h5
cause 'give one, such as 1100kg/m3' master --poisson-ratio 0.499 three.csv --export ls-dyna:rubber.k -o a.h5
cause 'give --prony-terms 17' master --poisson-ratio 0.499 --export-density 1100kg/m3 --prony-terms 19 "$fixtures/case/dma.txt" --export ls-dyna:rubber.k -o a.h5
helps master --poisson-ratio 0.499 --export-density 1100kg/m3 --prony-terms 17 "$fixtures/case/dma.txt" --export ls-dyna:rubber.k -o a.h5
