#!/bin/sh
# Results of earlier versions, whose tables had fewer columns, are still read. Usage: earlier_versions.sh
# WEARTRACK FIXTURES WORK. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work"; cd "$work"

# A text stream without these columns and keys, separated by blanks.
strip() {
  awk -F '\t' -v OFS='\t' -v names=" $1 " '
    /^## column: / { name = $1; sub(/^## column: /, "", name); if (index(names, " " name " ")) next }
    /^## [a-z_]+: / { name = $1; sub(/^## /, "", name); sub(/: .*/, "", name); if (index(names, " " name " ")) next }
    /^# / {
      for (i = 1; i <= NF; i++) {
        name = $i; sub(/^# /, "", name); sub(/\[.*/, "", name)
        out[i] = index(names, " " name " ") > 0
      }
    }
    /^##/ { print; next }
    { row = ""
      for (i = 1; i <= NF; i++)
        if (!out[i]) row = row (row == "" ? "" : OFS) $i
      print row }'
}

"$weartrack" psd -q "$fixtures/surface/place-1.gsf" "$fixtures/surface/place-2.gsf" "$fixtures/surface/near-by.gsf" |
  strip "law_error convention" >psd.tsv
"$weartrack" record -q --load 5N "$fixtures/record/steps.csv" | strip rotation >record.tsv
! grep -q 'law_error\|rotation' psd.tsv record.tsv
for result in psd record; do
  "$weartrack" summary -q $result.tsv >/dev/null
  "$weartrack" report -q $result.tsv -o $result.html
done
"$weartrack" master -q "$fixtures/case/dma.txt" -o m.h5
"$weartrack" friction -q -m m.h5 --roughness psd.tsv -p 0.4MPa -v 1m/s -o friction.tsv
"$weartrack" validate -q "$fixtures/case/stated-road.xml" record.tsv -o validation.tsv

# Results of versions before 0.9, which named tables, columns and keys otherwise.
"$weartrack" table -q friction.tsv what_if >present.tsv
sed -e 's/alternative/tried/' friction.tsv >former.tsv
grep -q tried former.tsv
"$weartrack" table -q former.tsv what_if >read.tsv
cmp present.tsv read.tsv

# The verdict "inconclusive" of these versions was "cannot say", in keys and in cells.
sed 's/	not computed	/	cannot say	/' validation.tsv >cell.tsv
grep -q '	cannot say	' cell.tsv
"$weartrack" table -q cell.tsv answer >cells.tsv
grep -q '	inconclusive	' cells.tsv
! grep -q 'cannot say' cells.tsv

# Options and case elements of these versions.
