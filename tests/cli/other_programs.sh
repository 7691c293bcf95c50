#!/bin/sh
# Other programs read the output of weartrack. Usage: other_programs.sh WEARTRACK FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work"; cd "$work"
fail() { echo "$*"; exit 1; }
expect() { [ "$2" = "$3" ] || fail "$1: '$2' instead of '$3'"; }

"$weartrack" master -q "$fixtures/case/dma.txt" -o m.h5
"$weartrack" friction -q -m m.h5 --roughness self-affine:q0=500rad/m,q1=1e6rad/m,hurst=0.8,c0=6e-16m^4 \
  -p 0.4MPa -v 1e-3:1m/s:log:4 --shear-stress 5MPa -o stream.txt
"$weartrack" friction -q -m m.h5 --roughness self-affine:q0=500rad/m,q1=1e6rad/m,hurst=0.8,c0=6e-16m^4 \
  -p 0.4MPa -v 1e-3:1m/s:log:4 --shear-stress 5MPa -o result.h5
"$weartrack" table stream.txt friction -o t.tsv

# The order of the input files does not change the result.
c=$fixtures/case
one="$c/bulk-1.jpk-force-map $c/bulk-2.jpk-force-map $c/bulk-3.jpk-force-map"
other="$c/bulk-3.jpk-force-map $c/bulk-1.jpk-force-map $c/bulk-2.jpk-force-map"
"$weartrack" indent -q --no-provenance --tip pyramid:half-angle=20deg,radius=20nm $one > a.tsv
"$weartrack" indent -q --no-provenance --tip pyramid:half-angle=20deg,radius=20nm $other > b.tsv
cmp a.tsv b.tsv || fail "indent: another order, other numbers"
"$weartrack" indent -q --tip pyramid:half-angle=20deg,radius=20nm "$c/track-1.jpk-force-map" --group track -o t.h5
for g in a b; do "$weartrack" compare -q --no-provenance $g.tsv t.h5 > compare-$g.tsv; done
cmp compare-a.tsv compare-b.tsv || fail "compare: another order, other numbers"
for t in 0 20 40; do
  awk -v t=$t 'BEGIN {print "f,E_stor,E_loss,T\nHz,MPa,MPa,C"; for (i = 0; i < 9; i++) {
    w = 10 ^ (i / 4 - 1 - t / 20); printf "%g,%.9g,%.9g,%g\n", 10 ^ (i / 4 - 1), 2 + 100 * w / (1 + w), 20 * sqrt(w) / (1 + w), t}}' > i$t.csv
done
"$weartrack" master -q --no-provenance i0.csv i20.csv i40.csv > a.tsv
"$weartrack" master -q --no-provenance i40.csv i0.csv i20.csv > b.tsv
cmp a.tsv b.tsv || fail "master: another order, other numbers"
"$weartrack" summary stream.txt result.h5 | grep -v '^##' | sort > a.tsv
"$weartrack" summary result.h5 stream.txt | grep -v '^##' | sort > b.tsv
cmp a.tsv b.tsv || fail "summary: another order, other rows"
"$weartrack" table stream.txt friction -o t.csv
"$weartrack" table stream.txt friction -o t.json
"$weartrack" table stream.txt contact_area -o blocks.tsv

# the stream as it is, as weartrack-stream(5) shows
largest=$(awk -F'\t' '/^##$/ {exit} !/^#/ && NF && $2 > m {m = $2} END {printf "%.6g", m}' stream.txt)
expect "awk, table" "$(awk -F'\t' 'NR > 1 && $2 > m {m = $2} END {printf "%.6g", m}' t.tsv)" "$largest"
expect "awk, one number of fields" "$(awk -F'\t' '{print NF}' t.tsv | sort -u | wc -l)" 1
expect "awk, no comments" "$(grep -c '#' t.tsv || true)" 0
for t in $("$weartrack" table --list stream.txt | awk 'NR > 1 {print $1}'); do
  "$weartrack" table stream.txt "$t" --format stream
done > again.tsv
grep -v '^## \(weartrack\|command\|input\): ' stream.txt | cmp - again.tsv || fail "split and joined it differs"

# a folder that nobody may read is said, and those behind it in the alphabet are there
if [ "$(id -u)" -eq 0 ] && ! command -v setpriv >/dev/null; then
  echo "no setpriv: not tried"
else
  as_nobody=
  [ "$(id -u)" -ne 0 ] || as_nobody="setpriv --reuid=65534 --clear-groups"
  lab=$(mktemp -d)
  mkdir "$lab/locked" "$lab/track"
  cp "$fixtures/case/track-1.jpk-force-map" "$lab/track"
  chmod -R a+rX "$lab"
  chmod 000 "$lab/locked"
  # shellcheck disable=SC2086 # a list of words
  if $as_nobody test -x "$weartrack"; then
    status=0
    $as_nobody "$weartrack" new-case "$lab" >case.xml 2>case.err || status=$?
    expect "new-case, a locked folder" "$status" 3
    grep -q "locked: cannot read the folder" case.err || fail "the locked folder is not named"
    grep -q "track-1.jpk-force-map" case.xml || fail "the folder behind the locked one is left out"
  else
    echo "nobody may not run it: not tried"
  fi
  rm -rf "$lab"
fi

if command -v gnuplot >/dev/null; then
  gnuplot -e 'set datafile separator "\t"; stats "t.tsv" using (column("friction")) nooutput; print sprintf("%.6g", STATS_max)' 2> g.txt
  expect "gnuplot, table" "$(cat g.txt)" "$largest"
  gnuplot -e 'set datafile separator "\t"; stats "< awk \"/^##\$/ {exit} 1\" stream.txt" using 2 nooutput; print sprintf("%.6g", STATS_max)' 2> g.txt
  expect "gnuplot, stream" "$(cat g.txt)" "$largest"
else
  echo "no gnuplot: not tried"
fi

if command -v python3 >/dev/null; then
  LARGEST=$largest python3 - <<'EOF'
import csv, json, os
largest = os.environ["LARGEST"]
tsv = list(csv.DictReader(open("t.tsv"), delimiter="\t"))
comma = list(csv.DictReader(open("t.csv")))
assert tsv == comma and len(tsv) == 4, (tsv, comma)
assert "%.6g" % max(float(r["friction"]) for r in tsv) == largest
assert [float(r["velocity[m/s]"]) for r in tsv] == [0.001, 0.01, 0.1, 1]
assert all(r["friction_with_layer"] == "" for r in tsv)
d = json.load(open("t.json"))
assert d["keys"]["pressure"] == {"value": 400000, "standard_error": None, "numerical_error": 0, "unit": "Pa"}
assert {c["name"]: c.get("unit") for c in d["columns"]}["velocity"] == "m/s"
assert [r["friction"] for r in d["rows"]] == [float(r["friction"]) for r in tsv]
assert d["rows"][0]["friction_with_layer"] is None
blocks = list(csv.DictReader(open("blocks.tsv"), delimiter="\t"))
assert {r["block"] for r in blocks} == {"0", "1", "2"}
try:
    import h5py
except ImportError:
    print("no h5py: not tried")
else:
    with h5py.File("result.h5") as f:
        g = f["friction"]
        assert list(g["friction"][:]) == [float(r["friction"]) for r in tsv]
        units = g["velocity"].attrs["units"]
        assert (units.decode() if isinstance(units, bytes) else units) == "m/s"
EOF
else
  echo "no python3: not tried"
fi
