#!/bin/sh
# Snakemake workflow: each case runs once, a changed case again, and finished results survive a kill.
# Usage: campaign.sh WEARTRACK SNAKEFILE FIXTURES WORK; 77 without Snakemake.
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 snakefile=$2 fixtures=$3 work=$4
command -v snakemake >/dev/null || exit 77
rm -rf "$work"; mkdir -p "$work"; cd "$work"
export HOME=$work XDG_CACHE_HOME=$work/cache
fail() { echo "$*"; cat said; exit 1; }
options='--replicates 10 --no-provenance'
campaign() { # OPTIONS
  snakemake --snakefile "$snakefile" --cores 2 --config cases=cases weartrack="$weartrack" \
    options="$options" "$@" >said 2>&1
}
runs() { grep -c '^rule run:' said || true; }
cp -R "$fixtures/case" cases
chmod -R u+w cases
rm -f cases/stated-road.xml
mv cases/case.xml cases/one.xml
sed 's/<temperature>30degC/<temperature>40degC/' cases/one.xml >cases/two.xml
sed 's/bulk-4.jpk/absent.jpk/' cases/one.xml >cases/part.xml # answered in part

campaign || fail "the campaign fails"
[ "$(runs)" = 3 ] || fail "not three runs"
[ "$(grep -v '^##' results/summary.tsv | wc -l)" = 4 ] || fail "not three rows: $(cat results/summary.tsv)"
grep -q 'In short' results/two.txt || fail "no answer"
grep -q 'absent.jpk' results/part.log || fail "nothing is said of the file that is missing"
"$weartrack" run -q --no-report --replicates 10 --no-provenance cases/two.xml -o by-hand.h5 >answer
cmp answer results/two.txt || fail "another answer than by hand"

campaign || fail "the second campaign fails"
[ "$(runs)" = 0 ] || fail "something was run again though nothing has changed"
printf '\n' >>cases/two.xml
campaign || fail "the third campaign fails"
[ "$(runs)" = 1 ] || fail "not the case alone that has changed"
printf '\n' >>cases/dma.txt
campaign || fail "the fourth campaign fails"
[ "$(runs)" = 3 ] || fail "a file of all cases has changed, and not all are run again"

# A case without a result has a row; an invalid case file stops no other one.
printf '<case version="1"><dma><files>absent.txt</files></dma></case>\n' >cases/nothing.xml
printf '<case' >cases/broken.xml
campaign --keep-going && fail "a file that is no case is taken for one"
grep -q 'rule run' said || fail "a file that is no case stops all"
rm cases/broken.xml
campaign || fail "a case without an answer stops the campaign"
awk -F '\t' '$1 ~ /nothing/ && $2 == 1 { found = 1 } END { exit !found }' results/summary.tsv ||
  fail "no row of a case without an answer"
rm cases/nothing.xml results/nothing.h5

options='--replicates 11 --no-provenance'
campaign || fail "the fifth campaign fails"
[ "$(runs)" = 3 ] || fail "with other options old results stay"

# Force curves file by file, in nested folders; an invalid file stops no other one.
mkdir -p maps/a maps/b
cp cases/bulk-1.jpk-force-map cases/bulk-2.jpk-force-map maps/a
cp cases/bulk-3.jpk-force-map maps/b/bulk-2.jpk-force-map
indent='--tip pyramid:half-angle=20deg,radius=20nm --no-provenance'
by_file() { # OPTIONS
  snakemake --snakefile "$snakefile" --cores 2 --config files=maps results=by-file \
    weartrack="$weartrack" indent="$indent" "$@" >said 2>&1
}
indents() { grep -c '^rule indent:' said || true; }
by_file || fail "curves file by file fail"
[ "$(indents)" = 3 ] || fail "not three files"
[ "$(wc -l <by-file/files.tsv)" = 4 ] || fail "not three rows: $(cat by-file/files.tsv)"
"$weartrack" indent -q $indent maps/b/bulk-2.jpk-force-map -o by-hand.h5
cmp by-hand.h5 by-file/files/b/bulk-2.jpk-force-map.h5 || fail "another result than by hand"
mv maps/b kept
by_file || fail "a part of the files fails"
[ "$(indents)" = 0 ] || fail "a file is called otherwise without others"
mv kept maps/b
by_file || fail "curves file by file fail again"
[ "$(indents)" = 0 ] || fail "a file was indented again though nothing has changed"
cp cases/track-1.jpk-force-map maps/b/new.jpk-force-map
echo "no curves" >maps/notes.txt
by_file --keep-going && fail "a text is taken for curves"
[ "$(indents)" = 2 ] || fail "not the new files alone"
rm maps/notes.txt
[ ! -e by-file/summary.tsv ] || fail "the cases were run, too"
indent='--tip pyramid:half-angle=21deg,radius=20nm --no-provenance'
by_file || fail "curves of another tip fail"
[ "$(indents)" = 4 ] || fail "with another tip old results stay"
indent=
by_file && fail "no tip is asked for"
grep -q 'files need their tip' said || fail "that a tip is needed is not said"

# Below a hidden folder, with names that look like Snakemake wildcards; hidden files in it are excluded.
mkdir -p .hidden/maps/.skipped
cp cases/bulk-1.jpk-force-map '.hidden/maps/a{1}.jpk-force-map'
cp cases/bulk-2.jpk-force-map .hidden/maps/.skipped
indent='--tip pyramid:half-angle=20deg,radius=20nm --no-provenance'
hidden() {
  by_file files=.hidden/maps results=by-hidden
}
hidden || fail "a folder below a hidden one, or a name with braces, fails"
[ "$(indents)" = 1 ] || fail "not one file below a hidden folder"
[ -s 'by-hidden/files/a%7B1%7D.jpk-force-map.h5' ] || fail "no result of a name with braces"
[ "$(wc -l <by-hidden/files.tsv)" = 2 ] || fail "not one row: $(cat by-hidden/files.tsv)"
hidden || fail "a name with braces fails again"
[ "$(indents)" = 0 ] || fail "a name with braces was indented again though nothing has changed"
touch '.hidden/maps/a{1}.jpk-force-map'
hidden || fail "a name with braces fails the third time"
[ "$(indents)" = 1 ] || fail "a name with braces was not indented again though it has changed"
cp cases/bulk-1.jpk-force-map '.hidden/maps/a%7B1%7D.jpk-force-map'
hidden && fail "two files have one result"
grep -q 'rename one of them' said || fail "that two files have one result is not said"

# Killed when the first job is done.
rm -rf results
setsid snakemake --snakefile "$snakefile" --cores 1 --config cases=cases weartrack="$weartrack" \
  options="--replicates 2000" >killed 2>&1 &
snake=$!
tries=0
until grep -q 'Finished job' killed 2>/dev/null; do
  tries=$((tries + 1))
  [ $tries -lt 600 ] || fail "no result after a minute"
  sleep 0.1
done
kill -KILL -"$snake" || fail "it cannot be killed"
wait $snake 2>/dev/null || true
campaign --unlock || fail "it does not unlock"
[ ! -e results/summary.tsv ] || fail "it was not killed in time"
campaign --rerun-incomplete --rerun-triggers mtime || fail "it does not go on after a kill"
[ "$(runs)" -lt 3 ] || fail "everything is run again after a kill"
[ "$(grep -v '^##' results/summary.tsv | wc -l)" = 4 ] || fail "not three rows after a kill"
