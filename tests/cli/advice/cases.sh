# Case files. SPDX-License-Identifier: GPL-3.0-or-later

# case_file NAME SECTIONS
case_file() { printf '<case version="1">\n%s\n</case>\n' "$2" > "$1"; }
files="<poisson-ratio>0.5</poisson-ratio><files>three.csv</files>"
rubber="<dma>$files</dma>"
law='<self-affine><q0>2e3rad/m</q0><q1>2e6rad/m</q1><hurst>0.8</hurst><c0>2e-17m^4</c0></self-affine>'
rough="<roughness>$law</roughness>"
conditions='<pressure>0.4MPa</pressure><velocity>0.1m/s</velocity><temperature>20degC</temperature><shear-stress>5MPa</shear-stress>'
slides="<sliding>$conditions</sliding>"
balance='<specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate><critical-energy>2e10J/m^3</critical-energy>'
stylus="<tip>$tip</tip>"
soft="<bulk spring-constant=\"0.3N/m\"><files>$curve</files></bulk>"
worn="<track spring-constant=\"0.3N/m\"><files>$track</files></track>"

piece '`xmllint --noout FILE` shows all such places'
printf '<case version="1">\n<dma>\n</case>\n' > w.xml
cause '`xmllint --noout FILE`' run --plan w.xml
if command -v xmllint > /dev/null; then
  xmllint --noout w.xml 2> err && fail 'xmllint finds nothing'
  grep -q 'w.xml:3' err || fail 'xmllint says another line'
fi

piece '`weartrack new-case FILE...` writes one for measured files'
cause '`weartrack new-case FILE...`' run three.csv
helps new-case three.csv -o new.xml
helps run --plan new.xml
cause '`weartrack info FILE` says what this one is' run three.csv
helps info three.csv
piece 'writes one for its files'
mkdir measured; cp three.csv measured
cause '`weartrack new-case measured -o case.xml`' run measured
helps new-case measured -o case.xml
helps run --no-report case.xml -o a.h5
piece 'next: fill in what is missing, then weartrack run %s'
cause 'next: fill in what is missing, then weartrack run new.xml' new-case "$curve" -o new.xml
cause 'line 9 <tip>: 1 value of the case is still to be filled in' run --plan new.xml
sed "s/FILL IN/$tip/" new.xml > filled.xml
helps run --plan filled.xml
piece 'files of force curves stand in <bulk> by a guess' 'in <roughness> by a guess'
cp "$curve" a.jpk-force-map; cp "$road" b.gsf
cause 'stand in <bulk> by a guess' new-case --tip "$tip" a.jpk-force-map -o new.xml
mkdir on_the_track; mv a.jpk-force-map on_the_track
helps new-case --tip "$tip" on_the_track -o new.xml
cause 'in <roughness> by a guess' new-case b.gsf -o new.xml
mv b.gsf road-b.gsf
helps new-case road-b.gsf -o new.xml
piece '; an image: of the counter surface it goes into roughness'
cp "$fixtures/surface/place-1.gsf" on_the_track
cause 'see weartrack spot' new-case --tip "$tip" three.csv on_the_track
helps spot --tip "$tip" --depth 70nm on_the_track/place-1.gsf -o a.h5
piece '<reference-temperature> in <dma>' 'delete <modulus-ratio>, or the curves of bulk or track'
wlf='<wlf><c1>8.86</c1><c2>101.6K</c2></wlf>'
prony='<prony deformation="tension"><equilibrium>5MPa</equilibrium><term time="1s" modulus="10MPa"/></prony>'
case_file w.xml "<dma><poisson-ratio>0.5</poisson-ratio>$prony$wlf</dma>"
cause '<reference-temperature> in <dma>' run --plan w.xml
case_file w.xml "<dma><poisson-ratio>0.5</poisson-ratio><reference-temperature>20degC</reference-temperature>$prony$wlf</dma>"
leads run --plan w.xml
case_file w.xml "<indentation>$stylus$soft$worn</indentation>$rubber<layer>$balance<modulus-ratio>0.5</modulus-ratio></layer>"
cause 'delete <modulus-ratio>' run --plan w.xml
case_file w.xml "<indentation>$stylus$soft$worn</indentation>$rubber<layer>$balance</layer>"
helps run --plan w.xml

# missing inputs that a plan names, added to the case
piece 'no bulk curves (<bulk> in <indentation>)' 'no wear-track curves (<track> in <indentation>)' 'no DMA files (<files> in <dma>)' \
  'no material (<prony>, <table> or <fractional-zener> in <dma>)' 'no counter surface (<roughness>)' \
  'no height maps of the counter surface (<files> in <roughness>)' 'no sliding conditions (<sliding>)' \
  'no layer parameters (<layer>)' 'no modulus ratio (<modulus-ratio> in <layer>)' \
  'no directions of the material (<transverse> in <dma>)' 'no table of softening (<file> in <strain-softening>)' \
  'no softening by strain sweeps (<sweeps> in <strain-softening>)' 'no records of friction (<files> in <record>)' \
  'nothing that was worn (<track-area>, <profile>' 'a specific wear rate in <layer>' \
  'no decades asked for (<decades> in <sliding>)' \
  'nothing that is seen of a layer (<identify>)' 'no flash temperature (<flash-temperature> in <sliding>)' \
  'the case switches it off (<validate> in <record>)'
# lacks WORDS BEFORE AFTER: the plan of BEFORE lacks it, that of AFTER does not
lacks() {
  case_file w.xml "$2"; cause "$1" run --plan w.xml
  case_file w.xml "$3"; helps run --plan w.xml
}
lacks '(<bulk> in <indentation>)' "<indentation>$stylus$worn</indentation>" "<indentation>$stylus$soft$worn</indentation>"
lacks '(<track> in <indentation>)' "<indentation>$stylus$soft</indentation>" "<indentation>$stylus$soft$worn</indentation>"
lacks '(<files> in <dma>)' "$rough$slides" "$rubber$rough$slides"
lacks '(<prony>, <table> or <fractional-zener> in <dma>)' "$rough$slides" "<dma><poisson-ratio>0.5</poisson-ratio><reference-temperature>20degC</reference-temperature>$prony</dma>$rough$slides"
lacks '(<roughness>)' "$rubber$slides" "$rubber$rough$slides"
lacks '(<files> in <roughness>)' "$rubber$rough$slides" "$rubber<roughness><files>$road</files></roughness>$slides"
lacks '(<sliding>)' "$rubber$rough" "$rubber$rough$slides"
ratio='<modulus-ratio>0.5</modulus-ratio>'
lacks '(<layer>)' "$rubber$rough$slides" "$rubber$rough$slides<layer>$balance$ratio</layer>"
lacks '(<modulus-ratio> in <layer>)' "$rubber$rough$slides<layer>$balance</layer>" "$rubber$rough$slides<layer>$balance$ratio</layer>"
lacks '(<decades> in <sliding>)' "$rubber$rough$slides" "$rubber$rough<sliding>$conditions<decades>yes</decades></sliding>"
lacks '(<flash-temperature> in <sliding>)' "$rubber$rough$slides" "$rubber$rough<sliding>$conditions<flash-temperature>yes</flash-temperature></sliding>"
measured="<record><files>$fixtures/record/disc.csv</files><load>5N</load><track-radius>12mm</track-radius></record>"
lacks '(<files> in <record>)' "$rubber$rough$slides" "$rubber$rough$slides$measured"
lacks '(<identify>)' "$rubber$rough$slides<layer>$balance$ratio</layer>" "$rubber$rough$slides<layer>$balance$ratio</layer><identify><observed-thickness>3um</observed-thickness></identify>"

piece '`weartrack run --plan` says what each stage lacks'
case_file w.xml "$slides"
cause '`weartrack run --plan`' run w.xml
helps run --plan w.xml
cause '`weartrack run --plan`' validate w.xml
helps run --plan w.xml
cause '`weartrack run --plan`' accuracy w.xml
helps run --plan w.xml
piece 'the result is an HDF5 file; type -o case.h5 and then weartrack table case.h5 NAME' 'type -o %.*s.h5 and then weartrack table %.*s.h5 NAME -o %s'
case_file w.xml "$rubber"
cause 'type -o case.h5 and then weartrack table case.h5 NAME' run w.xml -o -
helps run --no-report w.xml -o case.h5
helps table case.h5 prony
cause 'type -o w.h5 and then weartrack table w.h5 NAME -o w.csv' run w.xml -o w.csv
helps run --no-report w.xml -o w.h5
helps table w.h5 prony -o w.csv
piece '<at> in <dma>, such as 25degC,60degC'
case_file w.xml "<dma>$files</dma><report><moduli-at/></report>"
no_input '<at> in <dma>, such as' 'a result is asked for by the schema only with its section'
piece ' (in a case: <%.*s> in <dma>)'
case_file w.xml "<dma><poisson-ratio>0.5</poisson-ratio><files>one.csv</files></dma>"
cause '(in a case: the attribute temperature=' run --no-report w.xml -o a.h5
case_file w.xml '<dma><poisson-ratio>0.5</poisson-ratio><files temperature="25degC">one.csv</files></dma>'
helps run --no-report w.xml -o a.h5
# each attribute that a message advises exists in a case
for attribute in 'sheet="first"' 'frequency="10Hz"' 'temperature-in-name="*_#C*"' 'temperature="20degC"' 'units="a=MPa"' \
  'deformation="tension"' 'strain="1%"' 'sample="all"' 'format="table-units"' 'sample-by="file"'; do
  case_file w.xml "<dma><poisson-ratio>0.5</poisson-ratio><files $attribute>three.csv</files></dma>"
  cause 'Shift factors, WLF law, master curve' run --plan w.xml
done
cp "$here/advice/sweeps.xlsx" "$here/advice/profiles.xlsx" "$here/advice/curves.xlsx" .
case_file w.xml '<dma><poisson-ratio>0.5</poisson-ratio><files>sweeps.xlsx</files></dma>'
cause '(in a case: the attribute sheet="..." where the file is named)' run --no-report w.xml -o a.h5
case_file w.xml '<dma><poisson-ratio>0.5</poisson-ratio><files sheet="first">sweeps.xlsx</files></dma>'
helps run --no-report w.xml -o a.h5
case_file w.xml "<indentation>$stylus<bulk spring-constant=\"0.3N/m\" sheet=\"a\"><files>curves.xlsx</files></bulk></indentation>"
helps run --no-report w.xml -o a.h5
case_file w.xml '<roughness><files sheet="left">profiles.xlsx</files></roughness>'
leads run --no-report w.xml -o a.h5
case_file w.xml '<dma><poisson-ratio>0.5</poisson-ratio><files>ramp.csv</files></dma>'
cause '(in a case: the attribute frequency="..." where the file is named)' run --no-report w.xml -o a.h5
case_file w.xml '<dma><poisson-ratio>0.5</poisson-ratio><files frequency="10Hz">ramp.csv</files></dma>'
leads run --no-report w.xml -o a.h5
piece 'give <profile>, <track-area> or <mass-loss> in <record>'
case_file w.xml "$rubber$rough$slides<layer><critical-energy>2e10J/m^3</critical-energy>$ratio</layer>$measured"
cause 'give <profile>, <track-area> or <mass-loss> in <record>' run --no-report w.xml -o a.h5
case_file w.xml "$rubber$rough$slides<layer><critical-energy>2e10J/m^3</critical-energy>$ratio</layer><record><files>$fixtures/record/disc.csv</files><load>5N</load><track-radius>12mm</track-radius><track-area>3e-11m^2</track-area></record>"
helps run --no-report w.xml -o a.h5
case_file w.xml "$rubber$rough$slides<layer>$balance$ratio</layer>$measured"
helps run --no-report w.xml -o a.h5
piece 'name what distinguishes them with <sample> and <condition>'
case_file w.xml "<sample>s</sample><condition>c</condition>$rubber$rough$slides"
"$weartrack" run -q --no-report w.xml -o one.h5 > out 2> err; "$weartrack" run -q --no-report w.xml -o two.h5 > out 2> err
cause 'with <sample> and <condition> in the case files' collect one.h5 two.h5
case_file w.xml "<sample>s</sample><condition>d</condition>$rubber$rough$slides"
"$weartrack" run -q --no-report w.xml -o two.h5 > out 2> err
helps collect one.h5 two.h5

piece 'a style of your own is a file that ends in .gp, given with --style'
cause 'given with --style' report --style mine three.h5 -o p.html
cp "$source/src/report/styles/paper.gp" mine.gp 2> err || :
leads report --style mine.gp three.h5 -o p.html
piece 'or name the program with --gnuplot' '`weartrack report --gnuplot-time` allows more'
cause 'name the program with --gnuplot' report --gnuplot ./none three.h5 -o p.html
leads report --gnuplot gnuplot three.h5 -o p.html
printf '#!/bin/sh\nsleep 9\n' > slow; chmod +x slow
cause '`weartrack report --gnuplot-time` allows more' report --gnuplot ./slow --gnuplot-time 1s three.h5 -o p.html
leads report --gnuplot-time 60s three.h5 -o p.html
