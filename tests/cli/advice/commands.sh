# Messages of the command line. SPDX-License-Identifier: GPL-3.0-or-later

piece 'there is no subcommand' 'it is called %s, see weartrack %s --help' 'did you mean %s? See weartrack --help' 'weartrack %s: %s; see weartrack %s --help'
cause 'it is called report, see weartrack report --help' plot a.h5
helps report --help
cause 'it is called info' show a.h5
helps info --help
cause 'did you mean master? See weartrack --help' mastre
helps --help
cause 'see weartrack --help' nothingofthesort
helps --help
cause 'see weartrack master --help' master --nothing
helps master --help
no_input 'friction --material@, or compare BULK TRACK --master@' 'on a terminal: terminal.sh follows it'
no_input 'friction --material@ --sample NAME, or compare BULK TRACK --master@ --sample NAME' 'on a terminal, as that of one sample'
no_input 'friction --roughness@ --material DMA' 'on a terminal: terminal.sh follows it'
piece "unknown option '%s'; did you mean --%s?"
cause 'did you mean --poisson-ratio?' master --poison-ratio 0.5 three.csv -o a.h5
helps master --poisson-ratio 0.5 three.csv -o a.h5
piece 'hold a record against the growing layer: weartrack validate'
cause 'hold a record against the growing layer' friction $slide --running-in-friction
helps validate --help
piece 'indent --curves has force against indentation'
cause 'indent --curves has force against indentation' convert --contact three.h5 "$curve"
leads indent --tip "$tip" --spring-constant 0.3N/m --curves all "$curve" -o curves.h5
helps friction $slide
piece 'weartrack view of the result shows all curves'
cause 'weartrack view of the result shows all curves' report three.h5 --sheets a.pdf
helps view --help
piece '; did you mean '
cause 'did you mean table-units' master --format table-unit three.csv -o a.h5
helps master --poisson-ratio 0.5 --format table-units three.csv -o a.h5
piece "did you mean '%.*s'?"
cause "did you mean 'shear'?" master --deformation sheer unnamed.csv -o a.h5
helps master --deformation shear unnamed.csv -o a.h5
piece 'did you mean %s? Write it like %s'
cause 'did you mean sphere' indent --tip shpere:radius=5um --spring-constant 0.3N/m "$curve"
helps indent --tip sphere:radius=5um --spring-constant 0.3N/m "$curve" -o a.h5
piece 'did you mean %s%s?' 'did you mean %s?' 'did you mean %.*s?'
cause 'did you mean' master --poisson-ratio 0.5 --shift-law wlff:reference-temperature=20degC,c1=8.86,c2=101.6K three.csv -o a.h5
helps master --poisson-ratio 0.5 --shift-law wlf:reference-temperature=20degC,c1=8.86,c2=101.6K three.csv -o a.h5

piece 'did you mean %s? `weartrack table --list %s` shows all' '`weartrack table --list %s` shows them'
cause 'did you mean prony? `weartrack table --list three.h5`' table three.h5 pronny
helps table --list three.h5
helps table three.h5 prony
cause '`weartrack table --list three.h5` shows them' table three.h5
helps table --list three.h5

piece 'no %s is written; write the result as .h5, then `weartrack table RESULT NAME -o %s'
cause 'then `weartrack table RESULT NAME -o TABLE.csv`' master --poisson-ratio 0.5 three.csv -o a.xlsx
helps master --poisson-ratio 0.5 three.csv -o a.h5
helps table a.h5 prony -o a.csv
piece '--files-from %s: it names no file'
: > names
cause '--files-from names: it names no file' info --files-from names
echo three.csv > names
helps info --files-from names
not_advice 'help        the same' 'part of the help'
not_advice 'of DMA files, as in weartrack master --help all' 'part of the help'
not_advice '--help all has every one' 'part of the help'
cause '--help all has every one' master --help
helps master --help all
not_advice 'a whole case from one case file; --plan' 'part of the help'
piece '--figure is of the page: -o NAME.html or a folder' '-o %s: a page or a folder is written; -o FOLDER --figures'
cause '-o NAME.html or a folder' report --methods --figure master_curve three.h5
helps report --figure master_curve three.h5 -o page.html
cause '-o FOLDER --figures svg' report --figure master_curve three.h5 -o picture.svg
helps report --figure master_curve three.h5 -o figures --figures svg
not_advice 'standard output with --methods' 'part of the help'
piece '--columns: %s; %s'
cause '--columns: ' master --columns "a=nothing:MPa" foreign.csv -o a.h5
leads master --columns "Stor=storage_modulus:MPa" foreign.csv -o a.h5
piece 'no file was read by the columns of --columns' '--units %s: no file has such a column' '--units %s does not apply'
cause 'of --columns: none has such names' master --columns "Stor=storage_modulus:MPa" "$dma" -o a.h5
helps master --poisson-ratio 0.5 three.csv -o a.h5
cause '--units foo=MPa: no file has such a column' friction --units foo=MPa --poisson-ratio 0.5 --dma three.csv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
helps friction --poisson-ratio 0.5 --dma three.csv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
no_input '--units %s does not apply' 'tests/cli/remarks.txt'
not_advice 'give --units' 'text by which the program finds its own advice'
piece 'exit status 1 (--strict)'
cause '(--strict)' master --strict --poisson-ratio 0.5 --units foo=MPa three.csv -o a.h5
helps master --poisson-ratio 0.5 --units foo=MPa three.csv -o a.h5
piece 'weartrack report draws it' '-o - to print them; --verbose has the reasons' 'more rows: --verbose' 'in full: --verbose' 'more kinds: --verbose'
cause '(weartrack report draws it)' master --poisson-ratio 0.5 three.csv -o a.h5
helps report a.h5 -o page-a.html
not_advice 'more rows: --verbose' 'only in a terminal: tests/unit'
no_input 'details: --verbose, or weartrack formats show NAME' 'only in a terminal: terminal.sh'
no_input 'more files: --verbose' 'only in a terminal: terminal.sh'
no_input 'stages; reasons: --verbose' 'only in a terminal: terminal.sh'
advice='no such text'
helps master --verbose --poisson-ratio 0.5 three.csv -o a.h5

piece '\nnext: weartrack new-case' ' --units' 'table --list' 'indent --tip'
cause 'next: weartrack new-case' info "$curve" three.csv
helps new-case "$curve" three.csv -o case.xml
cause 'next: weartrack table --list three.h5' info three.h5
helps table --list three.h5
cause 'next: weartrack indent --tip' info "$curve"
helps indent --tip pyramid:half-angle=35deg,radius=20nm "$curve" -o a.h5

piece 'force curves go to `weartrack indent` first'
mkdir bulk track; cp "$curve" bulk; cp "$track" track
cause '`weartrack indent` first' compare bulk track
helps indent --tip "$tip" --spring-constant 0.3N/m bulk -o b.h5
helps indent --tip "$tip" --spring-constant 0.3N/m --group track track -o t.h5
helps compare b.h5 t.h5
piece 'materials are not compared any more'
cause 'BULK and TRACK are outputs of `weartrack indent`' compare three.h5 three.h5
helps compare b.h5 t.h5
helps compare b.h5 t.h5 --master three.h5
piece 'its curves are called bulk and are treated as those of the track'
"$weartrack" indent -q --tip "$tip" --spring-constant 0.3N/m "$track" -o unnamed.h5 2> err
cause '`weartrack indent --group track`' compare bulk.h5 unnamed.h5
leads compare bulk.h5 track.h5
piece '--poisson-ratio and --sample are of --master'
cause 'two files are needed' compare bulk.h5
helps compare bulk.h5 track.h5
cause '--poisson-ratio and --sample are of --master' compare --poisson-ratio 0.5 bulk.h5 track.h5
helps compare bulk.h5 track.h5
piece '--sample goes with --master'
cause '--sample goes with --master' indent --sample a --tip "$tip" --spring-constant 0.3N/m "$curve"
helps indent --sample a --master samples.h5 --poisson-ratio 0.5 --tip "$tip" --spring-constant 0.3N/m "$curve" -o a.h5

piece '--layer-thickness and --modulus-ratio (or a file of it) go together' 'give one of --modulus-ratio and --layer-comparison'
cause 'go together' friction $slide --layer-thickness 1um
helps friction $slide --layer-thickness 1um --modulus-ratio 0.5
"$weartrack" compare -q bulk.h5 track.h5 -o comparison.h5 2> err
cause 'give one of --modulus-ratio' friction $slide --layer-thickness 1um --modulus-ratio 0.5 --layer-comparison comparison.h5
helps friction $slide --layer-thickness 1um --modulus-ratio 0.5
piece 'files go with --material or --dma' 'give either --material FILE or --dma FILE' "the rubber's while it slides is --sliding-temperature" '--roughness takes a spectrum, height maps or'
cause 'files go with --material or --dma' friction $slide three.csv
helps friction --poisson-ratio 0.5 --dma three.csv --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
cause 'give either --material FILE or --dma FILE' friction --roughness $surface --pressure 0.4MPa --velocity 0.1m/s
helps friction $slide
cause 'it slides is --sliding-temperature' friction $slide --temperature 30degC
helps friction $slide --sliding-temperature 20degC
cause 'self-affine:q0=..,qr=..,q1=..,hurst=..,c0=..' friction --material three.h5 --roughness selfaffine --pressure 0.4MPa --velocity 0.1m/s
helps friction --material three.h5 --roughness self-affine:q0=2e3rad/m,qr=4e3rad/m,q1=2e6rad/m,hurst=0.8,c0=2e-17m^4 --pressure 0.4MPa --velocity 0.1m/s

piece 'what weartrack indent or weartrack master wrote' 'a weartrack text stream or HDF5 result'
cp empty.txt none.txt
cause 'what weartrack' friction --material three.h5 --roughness $surface --pressure 0.4MPa --velocity 0.1m/s --layer-thickness 1um --layer-comparison empty.txt
advice='no such text'
leads compare bulk.h5 track.h5
piece 'what weartrack run wrote' 'give what weartrack run wrote or, for moduli against'
cause 'what weartrack run wrote' collect empty.txt empty.txt
cause 'weartrack indent with --curves median' collect bulk.h5 track.h5
for g in bulk track; do
  helps indent --tip "$tip" --curves median --group $g --spring-constant 0.3N/m "$fixtures/case/$g-1.jpk-force-map" -o median-$g.h5
done
leads collect median-bulk.h5 median-track.h5
says 'a result of weartrack run, beside which'

piece 'give them to weartrack master'
cause 'give them to weartrack master' friction --material x --roughness y --velocity 1m/s --pressure 1MPa --vertical-shift free
helps master --vertical-shift free --sample-temperature-error 1K --no-provenance "$fixtures/case/dma.txt" -o free.tsv
