# Files of sweeps, images and curves. SPDX-License-Identifier: GPL-3.0-or-later

piece 'give it with --temperature 25degC, or say where it stands'
cause '--temperature 25degC' master one.csv -o a.h5
helps master --temperature 25degC one.csv -o a.h5
helps convert --temperature 25degC one.csv -o a.tsv
number sweep temperature 298.15 1e-6 a.tsv
cause '--temperature-in-name "*_#C*"' master one.csv -o a.h5
for t in 10 20 30; do { echo "f (Hz),E' (MPa),E'' (MPa)"; sweep $t | cut -d, -f2-; } > "at_${t}C.csv"; done
helps master --poisson-ratio 0.5 --temperature-in-name '*_#C*' at_10C.csv at_20C.csv at_30C.csv -o a.h5
# the suggested command has the options of the call before it
cause 'give it with --temperature' info one.csv
helps info --temperature 25degC one.csv
says '^next: weartrack master --temperature 25degC '

piece 'leave --temperature out: it is for files that state none' '--temperature %gdegC, and %g degC in the file'
{ for t in 20 25 30; do printf 'Temperature: %s degC\nf [Hz]\tE'"'"' [MPa]\tE'"''"' [MPa]\n' $t
  sweep $t | cut -d, -f2- | tr , '\t'; echo; done; } > stated.txt
cause 'leave --temperature out' master --temperature 20degC stated.txt
helps master stated.txt -o a.h5

piece '%s--units \"%s=UNIT\"' 'if the file is wrong, give it with --units'
cause '--units' master unitless.txt
helps master --units "E'=MPa" --units "E''=MPa" --units f=Hz --units T=degC unitless.txt -o a.h5
helps convert --units "E'=MPa" --units "E''=MPa" --units f=Hz --units T=degC unitless.txt -o a.tsv
number sweep storage_modulus 4.99526e6 1e-4 a.tsv # 3 MPa + 1 MPa x 10^0.3

piece 'but its unit is not said: give --units'
cause "give --units \"f=...\"" info unitless.txt
helps info --units f=Hz --units T=degC --units "E'=MPa" --units "E''=MPa" unitless.txt
says '^next: weartrack master --units f=Hz'

no_input 'for example --units' 'the library only: the program checks its options before it reads'

piece 'export that column too, or say it with --deformation tension'
{ echo '# T (degC),f (Hz),Modulus (MPa),tan delta (1)'; sweep 20 30; } > unclear.csv
cause '--deformation shear' master unnamed.csv -o a.h5
helps master --deformation shear unnamed.csv -o a.h5

piece 'if the file is wrong, say what its columns are with --columns'
{ echo "T (C),f (Hz),G' (MPa),G'' (MPa)"; sweep 10 20 30; } > shear.csv
cause 'with --columns' master --deformation tension shear.csv -o a.h5
helps master --deformation tension --columns "T (C)=temperature:degC" --columns "f (Hz)=frequency:Hz" \
  --columns "G' (MPa)=storage_modulus:MPa" --columns "G'' (MPa)=loss_modulus:MPa" --poisson-ratio 0.5 shear.csv -o a.h5

piece 'if cycles are meant, give --columns \"NAME=frequency:Hz\"'
{ echo "T (C),omega (1/s),E' (MPa),E'' (MPa)"; sweep 10 20 30; } > second.csv
cause 'if cycles are meant' master second.csv -o a.h5
helps master --columns "omega (1/s)=frequency:Hz" second.csv -o a.h5

piece 'give the one of all points with --frequency 10Hz'
cause '--frequency 10Hz' ramp ramp.csv -o a.h5
helps ramp --frequency 10Hz ramp.csv -o a.h5
cause 'with --frequency 10Hz' info ramp.csv
helps info --frequency 10Hz ramp.csv
says '^next: weartrack ramp --frequency 10Hz'
helps convert --frequency 10Hz ramp.csv -o a.tsv
number sweep angular_frequency 62.8319 1e-5 a.tsv

piece 'the file states a temperature of %.2f degC, which is used'
head -n 11 stated.txt > lone.txt
cause '--temperature is for files that state none' convert --temperature 25degC lone.txt -o a.tsv
helps convert lone.txt -o a.tsv

not_advice 'chosen with --format' 'says how the format was found'
not_advice 'see `weartrack formats list`' 'the library only: the program has looked before'

piece '--format: there is no format' 'weartrack formats: there is no format'
cause 'see weartrack formats list' master --format nothing three.csv
helps formats list
cause 'see weartrack formats list' formats show nothing
helps formats list
cause 'did you mean' master --format table-unit three.csv -o a.h5
helps master --format table-units three.csv -o a.h5

piece 'with --columns \"NAME=QUANTITY:UNIT\" for each'
cause '--columns "NAME=QUANTITY:UNIT" for each' master foreign.csv -o a.h5
helps master --columns Temp=temperature:degC --columns Hertz=frequency:Hz --columns Stor=storage_modulus:MPa \
  --columns Los=loss_modulus:MPa --poisson-ratio 0.5 foreign.csv -o a.h5
cause 'say what its columns hold, with --columns' info foreign.csv
helps info --columns Temp=temperature:degC --columns Hertz=frequency:Hz --columns Stor=storage_modulus:MPa \
  --columns Los=loss_modulus:MPa foreign.csv
says '^next: weartrack master --columns Temp=temperature:degC --columns Hertz=frequency:Hz'
helps convert --columns Temp=temperature:degC --columns Hertz=frequency:Hz --columns Stor=storage_modulus:MPa \
  --columns Los=loss_modulus:MPa foreign.csv -o a.tsv
number sweep storage_modulus 4.99526e6 1e-4 a.tsv

piece 'a case file is for `weartrack run`; '
cause 'a case file is for `weartrack run`' info "$fixtures/case/case.xml"
helps run --plan "$fixtures/case/case.xml"

piece '`weartrack table --list` shows its tables' '`weartrack table --list` shows what is in it' 'what `weartrack convert` writes of measurements'
cause '`weartrack table --list`' master prony.tsv
helps table --list prony.tsv
cause '`weartrack table --list`' master three.h5
helps table --list three.h5

piece 'tables that are no measurements are left out'
printf '<case version="1"><roughness><files>%s</files></roughness></case>\n' "$road" > whole.xml
"$weartrack" run -q --no-report whole.xml -o whole.h5 > out 2> err
cause '`weartrack table` writes them' convert whole.h5 -o a.tsv
helps table whole.h5 surfaces -o a.csv

piece 'weartrack indent' 'weartrack master' 'weartrack spot' 'weartrack record' 'weartrack friction --roughness'
cause '`weartrack indent` takes force curves' master "$curve"
helps indent --tip "$tip" --spring-constant 0.3N/m "$curve" -o a.h5
cause '`weartrack master` takes' indent --tip "$tip" "$dma"
helps master "$dma" -o a.h5
cause '`weartrack spot` takes' master "$road"
helps spot --tip "$tip" --depth 500nm "$road" -o a.h5
cause '`weartrack record` takes' master "$fixtures/record/disc.csv"
leads record "$fixtures/record/disc.csv"

piece '--format gwyddion has the program Gwyddion read it'
printf '\001\002\003\000\377\376\000\001\002\000\000\005' > unknown.bin
cause '--format gwyddion' psd unknown.bin
leads psd --format gwyddion unknown.bin

piece 'choose with --format %s or --format %s'
mkdir formats
for id in first second; do cat > formats/$id.xml <<END
<format id="$id" version="1" kinds="sweep"><title>$id</title><evidence>test</evidence></format>
END
done
no_input 'choose with --format' 'needs two descriptions of one score, of which the set in the program has none'

piece 'the pixels are not square'
{ printf '# Channel: Z\n# Width: 4 um\n# Height: 4 um\n# Value units: m\n'; for i in 1 2; do echo '1e-9 2e-9 3e-9 1e-9'; done; } > cut-rows.txt
cause 'give the true size with --pixel-size' psd cut-rows.txt
leads psd --pixel-size 1um cut-rows.txt

piece 'the size of the image is not known; --pixel-size gives it'
for i in 1 2 3 4 5 6 7 8; do echo '1e-9 2e-9 3e-9 1e-9 5e-9 2e-9 1e-9 4e-9'; done > rows; cp rows sizeless.txt
cause 'the size of the image is not known; --pixel-size gives it' psd --units z=m sizeless.txt
leads psd --pixel-size 1um --units z=m sizeless.txt

# Spreadsheets with two sheets, created with the Python module zipfile.
piece 'choose one with --sheet NAME, or take all of them'
cp "$here"/advice/*.xlsx .
cause 'choose one with --sheet NAME' master sweeps.xlsx -o a.h5
helps master --poisson-ratio 0.5 --sheet first sweeps.xlsx -o a.h5
helps convert --sheet first sweeps.xlsx -o a.tsv
number sweep storage_modulus 4.99526e6 1e-4 a.tsv
cause 'with --sheet all' master sweeps.xlsx -o a.h5
helps master --poisson-ratio 0.5 --sheet all sweeps.xlsx -o a.h5
cause 'choose one with --sheet NAME' info sweeps.xlsx
helps info --sheet first sweeps.xlsx
says '^next: weartrack master --sheet first sweeps.xlsx'
for command in master ramp payne indent sensitivity psd spot record convert info; do
  "$weartrack" $command --help all > help
  grep -q -e '--sheet ' help || fail "weartrack $command has no --sheet"
done
cause 'choose one with --sheet NAME' psd profiles.xlsx -o a.h5
leads psd --sheet left profiles.xlsx -o a.h5
cause 'choose one with --sheet NAME' indent --tip sphere:radius=5um --spring-constant 0.3N/m curves.xlsx -o a.h5
helps indent --tip sphere:radius=5um --spring-constant 0.3N/m --sheet a curves.xlsx -o a.h5
piece 'a table of data begins with the names of its columns'
cause '`weartrack formats list` shows what is known' master neither.xlsx -o a.h5
helps formats list

piece '`weartrack table --format stream` writes'
"$weartrack" table bulk.h5 modulus_groups -o plain.tsv
cause '--format stream' table plain.tsv
helps table bulk.h5 modulus_groups --format stream -o marked.tsv
helps table marked.tsv
number modulus_groups n 12 0 marked.tsv

no_input 'the library was built with this damaged description: install it again' 'the library is sound; unit_read_description damages one'
