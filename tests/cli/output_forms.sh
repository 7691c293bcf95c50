#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Each subcommand with each form of output: the end of the name after -o decides. A .csv has
# the main table under one header line, as a .tsv of a subcommand that writes one table; a .json has
# it, too. Other subcommands refuse the name and leave no file.
#   output_forms.sh WEARTRACK FIXTURES WORK
set -eu
weartrack=$1 fixtures=$2
rm -rf "$3" && mkdir -p "$3" && cd "$3"
fail() { echo "FAILED: $*"; exit 1; }
case=$fixtures/case
tip=pyramid:half-angle=20deg,radius=20nm
road=self-affine:q0=500rad/m,qr=2000rad/m,q1=1e6rad/m,hurst=0.8,c0=6e-16m^4
sliding="--roughness $road --pressure 0.4MPa --velocity 0.3m/s"
wear="--specific-wear-rate 1e-12m^2/N --critical-energy 2e10J/m^3"

# tables FIRST SUBCOMMAND [ARGUMENT]...: the first column of the main table, without its unit.
tables() {
  first=$1 name=$2
  shift
  rm -f out.*
  forms="csv json"
  case $name in table | summary | formats) forms="csv json tsv" ;; esac
  for form in $forms; do
    "$weartrack" "$@" -o out.$form 2>err || [ $? -eq 3 ] || fail "$* -o out.$form: $(cat err)"
  done
  head -n 1 out.csv | grep -q "^\(block,\)\{0,1\}$first\(\[[^]]*\]\)\{0,1\}," || fail "$name: the header of a .csv: $(head -n 1 out.csv)"
  python3 - <<'EOF' || fail "$name: its forms differ"
import csv, json, os
def numbers(row): # an apostrophe keeps a spreadsheet from taking a text for a formula
    return [c.lstrip("'") for c in row]
rows = [numbers(r) for r in csv.reader(open("out.csv"))]
assert len(rows) > 1 and len({len(r) for r in rows}) == 1
if os.path.exists("out.tsv"):
    assert rows == [numbers(r) for r in csv.reader(open("out.tsv"), delimiter="\t")]
tables = json.load(open("out.json"))
tables = tables if isinstance(tables, list) else [tables]
names = [n.split("[")[0] for n in rows[0] if n != "block"]
first = [t for t in tables if [c["name"] for c in t["columns"]] == names]
assert first, [t["table"] for t in tables]
table = first[0]
assert len(table["rows"]) == len(rows) - 1
units = {c["name"]: c.get("unit") for c in table["columns"]}
for name, cell in zip(rows[0], rows[1]):
    if name == "block":
        continue
    value = table["rows"][0][name.split("[")[0]]
    if units[name.split("[")[0]] is not None:
        assert value is None and cell == "" or float(cell) == float(value), (name, cell, value)
EOF
}

# refused SUBCOMMAND [ARGUMENT]...: a usage error, and no file.
refused() {
  for form in csv $also json; do
    status=0
    rm -f out.*
    "$weartrack" "$@" -o out.$form >said 2>err || status=$?
    [ $status -eq 2 ] || fail "$* -o out.$form: exit status $status"
    grep -q -- "-o out.$form" err || fail "$* -o out.$form: $(cat err)"
    [ ! -e out.$form ] || fail "$*: out.$form was written"
  done
}

command -v python3 >/dev/null || { echo "no python3: not tried"; exit 77; }
"$weartrack" indent -q --tip $tip $case/bulk-1* $case/bulk-2* -o bulk.h5
"$weartrack" indent -q --tip $tip --group track $case/track-1* $case/track-2* -o track.h5
"$weartrack" master -q $case/dma.txt -o dma.h5
"$weartrack" run -q --no-report --replicates 10 $case/case.xml -o case.h5 >text

tables file indent -q --tip $tip $case/bulk-1*
tables rate_low compare -q bulk.h5 track.h5
tables relaxation_time master -q $case/dma.txt
tables angular_frequency ramp -q $fixtures/dma/ramp_storage.csv
tables angular_frequency payne -q $fixtures/formats/tidy/strain-sweeps.csv
tables wavenumber psd -q $case/road-1.gsf
tables velocity friction -q --material dma.h5 $sliding
tables time layer -q --material dma.h5 $sliding $wear
tables velocity record -q --load 5N $fixtures/record/steps.csv
tables velocity validate -q --replicates 10 $case/case.xml $fixtures/record/steps.csv
tables number accuracy -q --no-provenance --replicates 10 $case/case.xml
tables sample collect -q case.h5
tables file summary case.h5
tables relaxation_time table dma.h5 prony
tables format formats list

also=
refused convert $case/dma.txt
also=tsv
refused run $case/case.xml
refused new-case $case
refused report case.h5
refused formats show jpk
echo "every subcommand writes the form of the name"
