#!/bin/sh
# Two compounds at two severities with known softening of the track: collect finds the pairs that differ,
# and no others. Usage: collect.sh PROGRAM GENERATOR FIXTURES WORK [SEEDS]. With SEEDS (such as "1 2 3")
# the script counts how often the intervals contain the truth: in 100 studies 94 to 98 % for each pair,
# and 3 wrong verdicts "differs".
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
program=$1 generator=$2 fixtures=$3 work=$4 seeds=${5:-}
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# A case in its own folder: sample, condition, softening, variant of the measurement errors. Piezo and
# detector of the generator are linear, and its sample is thick.
make_case() {
  mkdir -p "$1-$2"
  sed -e "s#</title>#</title><sample>$1</sample><condition>$2</condition>#" -e '/<roughness>/,$d' \
    -e 's#<temperature>23degC#<piezo-nonlinearity>1e-6</piezo-nonlinearity><detector-nonlinearity>1e-6</detector-nonlinearity><thick-sample>yes</thick-sample>&#' \
    "$fixtures/case.xml" >"$1-$2/case.xml"
  echo '<compare><track-to-bulk/><by-rate/></compare></case>' >>"$1-$2/case.xml"
  "$generator" "$1-$2" "$fixtures/stated-road.xml" "$4" "$3"
  "$program" run -q --no-report "$1-$2/case.xml" -o "$1-$2.h5" >/dev/null
}
make_study() {
  make_case HC mild 0.85 $(($1 * 4))
  make_case HC severe 0.64 $(($1 * 4 + 1))
  make_case HS mild 1 $(($1 * 4 + 2))
  make_case HS severe 0.64 $(($1 * 4 + 3))
  "$program" collect -q HC-mild.h5 HC-severe.h5 HS-mild.h5 HS-severe.h5 -o study.h5
  "$program" table study.h5 ratio_pairs >pairs.tsv
}
# "HC mild severe yes"; true ratios of the pairs: 0.85/0.64, 1/0.64, 0.85/1, 1
verdicts() { awk -F '\t' 'NR > 1 { print $1, $2, $3, $10 }' pairs.tsv | sort; }

if [ -n "$seeds" ]; then
  for seed in $seeds; do
    make_study "$seed"
    awk -F '\t' 'NR > 1 {
      truth = $1 == "HC" ? 0.85 / 0.64 : $1 == "HS" ? 1 / 0.64 : $1 == "mild" ? 0.85 : 1
      print $1, $5 <= truth && truth <= $6 ? "holds" : "misses", $10 }' pairs.tsv
  done | sort | uniq -c
  exit 0
fi

make_study 1
expected='HC mild severe yes
HS mild severe yes
mild HC HS yes
severe HC HS no'
if [ "$(verdicts)" != "$expected" ]; then
  echo "the pairs are judged:" >&2
  cat pairs.tsv >&2
  exit 1
fi
# how to decide an inconclusive pair; no text if all are decided
! "$program" table --keys study.h5 ratio_pairs | grep 'would decide'
"$program" collect -q --equivalence-margin 0.001 HC-*.h5 HS-*.h5 -o fine.h5
"$program" table --keys fine.h5 ratio_pairs | grep -q 'decide the nearest of them, severe: HC against HS'
# the interval beside 1 leaves no space for 0.1 %
"$program" table fine.h5 ratio_pairs >fine.tsv
needed=$(awk -F '\t' '$1 == "severe" { half = (log($6) - log($5)) / 2; off = log($4)
  n = (half / (off < 0 ? -off : off)) ^ 2; if (n < 2) n = 2; printf "%.0f", int(n) + (n > int(n)) }' fine.tsv)
"$program" table --keys fine.h5 ratio_pairs | grep -q "about $needed times as many spots"
# every row of the cases, and a figure for each
"$program" table study.h5 collection --format csv | cut -d , -f 1,2,6 >cases.csv
printf 'sample,condition,differs\nHC,mild,yes\nHC,severe,yes\nHS,mild,no\nHS,severe,yes\n' | diff - cases.csv
"$program" report study.h5 -o page >/dev/null 2>&1
test -s page/plots/collected_modulus.tsv
! test -e page/plots/collected_friction.tsv
# the reference indentations are with every sample, and are no case
"$program" indent -q --curves median --tip pyramid:half-angle=20deg,radius=20nm --group silica \
  HC-mild/bulk-1.jpk-force-map -o silica.h5
"$program" collect -q HC-mild.h5 HS-mild.h5 silica.h5 -o beside.h5
"$program" table beside.h5 collected_force | sed 1d | cut -f 2,3,4 | sort -u >places.tsv
printf 'HC\t\tsilica\nHC\tmild\tbulk\nHC\tmild\tmild\nHS\t\tsilica\nHS\tmild\tbulk\nHS\tmild\tmild\n' |
  diff - places.tsv
# without a group, or with a duplicate one, a case has the name of its file and is not drawn as bulk
"$program" indent -q --curves median --tip pyramid:half-angle=20deg,radius=20nm \
  HC-mild/bulk-1.jpk-force-map -o filler.h5
cp silica.h5 again.h5
"$program" collect -q HC-mild.h5 silica.h5 again.h5 filler.h5 -o named.h5
"$program" table named.h5 collected_force | sed 1d | cut -f 4 | sort -u >named.tsv
printf 'bulk\nbulk of filler.h5\nmild\nsilica of again.h5\nsilica of silica.h5\n' | diff - named.tsv
"$program" report beside.h5 -o beside >/dev/null 2>&1
grep -q "title 'silica'" beside/plots/collected_force.gp
status=0
"$program" collect silica.h5 -o none.h5 2>words || status=$?
test $status -eq 1 -a ! -e none.h5
grep -q 'there is no case' words
# invalid files are skipped; two of a kind are named
status=0
"$program" collect HC-mild.h5 pairs.tsv HS-mild.h5 -o two.h5 2>words || status=$?
test $status -eq 3
grep -q 'pairs.tsv: .*weartrack run' words
status=0
"$program" collect HC-mild.h5 HC-mild.h5 -o none.h5 2>words || status=$?
test $status -eq 1 -a ! -e none.h5
grep -q 'sample "HC" and condition "mild"' words

# cases without indentation have a row of their largest friction and no ratio
for name in nr-rough sbr-rough; do
  "$program" run -q --no-report "$fixtures/../compounds/$name.xml" -o $name.h5 >/dev/null
done
"$program" collect nr-rough.h5 sbr-rough.h5 -o friction.h5 2>words
for name in NR SBR; do
  grep -q "^  $name, rough surface  *0\.[0-9]* .*largest friction by hysteresis, at 10.0 m/s" words
done
! grep -q 'not known' words

# temperature sweeps of several samples have no case and are drawn together
for name in ramp ramp-frequencies-in-turn; do
  "$program" ramp -q "$fixtures/../formats/table-units/$name".* -o "$name.h5"
done
"$program" collect ramp.h5 ramp-frequencies-in-turn.h5 -o ramps.h5
test "$("$program" table ramps.h5 collected_ramp | cut -f 2 | sort -u | grep -c ramp)" -eq 2
