#!/bin/sh
# run --keep: an unchanged result is kept, and a change of any input is detected. Usage: run_keep.sh
# WEARTRACK FIXTURES WORK. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work"; cd "$work"
cp -R "$fixtures/case" case
chmod -R u+w case
sed -i 's/bulk-4/bulk-[4-9]/' case/case.xml
fail() { echo "$*"; cat said; exit 1; }
run() { # OPTIONS: what is said to standard error
  "$weartrack" run --keep --no-report --replicates 10 "$@" case/case.xml 2>said >answer || true
}
made() { # WHY [OPTION...]: it is made again for that reason, and kept when asked once more
  why=$1; shift
  run "$@"
  grep -q "made again: .*$why" said || fail "not made again: $why"
  cp answer before
  run "$@"
  grep -q '(kept: ' said || fail "not kept after: $why"
  cmp answer before || fail "another answer than before: $why"
}
run
grep -q 'kept' said && fail "kept what was not there"
run
grep -q '(kept: ' said || fail "not kept"
run --strict
grep -q '(kept: ' said || fail "not kept with --strict"
for threads in '--threads 1' --threads=2; do
  run $threads
  grep -q '(kept: ' said || fail "not kept with $threads"
done
touch case/dma.txt case/case.xml
run
grep -q '(kept: ' said || fail "not kept though only a time has changed"

made 'command' --seed 2
made 'command'
sed -i 's/<title>/<title>New /' case/case.xml
made 'the case has changed'
printf '\n' >> case/dma.txt
made 'dma.txt has changed'
cp case/bulk-1.jpk-force-map case/bulk-9.jpk-force-map
printf 'x' >> case/bulk-9.jpk-force-map
made 'bulk-9.jpk-force-map is new'
run --strict # the bytes behind the archive are a remark
grep -q 'exit status 1 (--strict)' said || fail "remarks of a result that is kept do not count"
rm case/bulk-9.jpk-force-map
made 'is gone'
printf '\n' >> case/softening.txt # nothing asks for it
run
grep -q '(kept: ' said || fail "not kept though what has changed was not read"

# What was answered in part is tried again, and so is what cannot be read or has descriptions beside it.
mv case/track-2.jpk-force-map gone
for again in 1 2; do
  run
  grep -q '(kept: ' said && fail "an answer in part is kept"
done
mv gone case/track-2.jpk-force-map
made 'in part'
mkdir descriptions
run --formats descriptions
grep -q 'made again: --formats' said || fail "kept in spite of --formats"
run --no-provenance
run --no-provenance
grep -q 'does not say what it was made of' said || fail "kept without a provenance"
printf 'x' > case.h5
run
grep -q 'made again: it cannot be read' said || fail "a result that is none is not made again"

# A page that is missing is drawn from the result that is kept.
"$weartrack" run --keep -q --replicates 10 case/case.xml >answer 2>said
cp case.h5 result.h5
mv case-report/index.html page.html && rm -rf case-report
"$weartrack" run --keep --replicates 10 case/case.xml >answer 2>said
grep -q '(kept: ' said || fail "not kept for want of a page"
cmp case.h5 result.h5 || fail "the result has changed"
cmp case-report/index.html page.html || fail "another page"
