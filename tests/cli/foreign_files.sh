#!/bin/sh
# Foreign files: names with terminal escape sequences, pipes, folders with very many files, cells without
# a value, extreme values. Usage: foreign_files.sh WEARTRACK FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work"; cd "$work"
fail() { echo "$*"; cat said 2>/dev/null; exit 1; }
# refused STATUS WORDS ARGUMENT...: exits with the status in time and prints the words
refused() {
  status=$1 words=$2; shift 2
  got=0; timeout 20 "$weartrack" "$@" > out 2> said || got=$?
  [ "$got" = "$status" ] || fail "$*: exit status $got, not $status"
  grep -q -- "$words" said || fail "$*: nothing about '$words'"
}
escape=$(printf '\033')
plain() { ! grep -q "$escape" said || fail "an escape character reaches the terminal"; }

# names
name=$(printf 'a\033]0;title\007b\nc.txt')
echo text > "$name"
refused 1 'a ]0;title b c.txt' info "$name"; plain
refused 1 'a ]0;title b c.txt' report -o r "$name"; plain
refused 1 'a.*]0;title' master "$name"; plain
refused 2 'no subcommand.*\\x1b' "$name"; plain
refused 2 '\\x1b' info "--format=$name" x; plain
[ "$(wc -l < said)" = 1 ] || fail "a line is made by a name"
cp "$fixtures/case/dma.txt" "$name"
"$weartrack" convert "$name" -o µ.tsv 2> said || fail "a name"; plain
refused 1 "absent-µ" report -o r absent-µ.h5

# names in a case are read back unchanged, or the case omits them and reports it
mkdir names other; cp "$fixtures/case/bulk-1.jpk-force-map" other/plain
for name in 'a]]>b' 'a--b-->c' 'a&lt;"b' ' a' 'a[b]*?'; do
  cp other/plain "names/$name"
  "$weartrack" new-case -q --tip sphere:radius=5um "names/$name" -o c.xml 2> said || fail "$name"
  "$weartrack" run --no-report --no-provenance c.xml -o c.h5 > out 2> said || fail "$name: the case does not run"
  rm "names/$name"
done
for name in "$(printf 'a\001b')" "$(printf 'a\rb')" "$(printf 'a\nb')" "$(printf 'a\377b')" "$(printf 'a\357\277\276b')" 'a '; do
  cp other/plain "names/$name"
  refused 1 'the name cannot stand in a case file' new-case --tip sphere:radius=5um "names/$name"
  refused 3 'the name cannot stand in a case file' new-case --tip sphere:radius=5um "names/$name" other/plain -o c.xml; plain
  "$weartrack" run --plan c.xml > out 2> said || fail "a case without the name"
  [ "$(grep -c '<files>' c.xml)" = 1 ] || fail "a file of a name that cannot be"
  rm "names/$name"
done

# cells that a spreadsheet would execute
printf '## table: t\n# a[text]\tb[1]\n=1+2\t-1\n@x,y\t1\n-5\t1\n+\t1\n-x\t1\nplain\t1\n##\n' > cells.tsv
"$weartrack" table cells.tsv --format csv > out 2> said || fail "table"
printf "a,b\n'=1+2,-1\n\"'@x,y\",1\n-5,1\n+,1\n'-x,1\nplain,1\n" | cmp - out || fail "cells that begin with a sign"
"$weartrack" table cells.tsv --format csv --formulas > out 2> said || fail "table --formulas"
grep -q '^=1+2,' out || fail "--formulas"

# an archive with one text is not read as the text
if command -v tar > /dev/null; then
  cp "$fixtures/case/dma.txt" one.txt; cp one.txt two.txt
  tar cf texts.tar one.txt two.txt; tar czf texts.tgz one.txt two.txt
  for name in texts.tar texts.tgz; do
    refused 1 'found a tar archive; unpack it (tar -xf), and give its files' master "$name"
    refused 1 'found a tar archive; unpack it (tar -xf), and give its files' convert --format trios-lims "$name"
  done
fi

# pipes
mkfifo pipe
refused 1 'named pipe' info pipe
refused 1 'named pipe' convert pipe
mkdir folder; mkfifo folder/pipe; cp "$fixtures/case/dma.txt" folder
refused 3 'named pipe' master folder/pipe folder/dma.txt
timeout 20 "$weartrack" convert -q --no-provenance folder/dma.txt > direct
cat folder/dma.txt > pipe &
[ "$(timeout 20 "$weartrack" convert -q --no-provenance - < pipe | grep -c "^[0-9]")" = "$(grep -c "^[0-9]" direct)" ] || fail "a pipe as standard input"
cat > case.xml <<'EOF'
<case version="1"><dma><files>pipe</files></dma></case>
EOF
refused 1 'named pipe' run --no-report case.xml -o r.h5

# endless or too large inputs are refused before memory or disk are full
for subcommand in info convert run validate accuracy table collect summary; do
  refused 1 'is a device' "$subcommand" /dev/zero
done
refused 1 'is a device' report -o zeros /dev/zero
timeout 20 "$weartrack" info - < /dev/zero > said 2>&1 && fail "zeros as standard input"
grep -q 'is a device' said || fail "zeros as standard input: $(cat said)"
truncate -s 65M large.xml
refused 1 'is larger than 64 MiB' run --no-report large.xml -o r.h5
yes '<case>' | timeout 60 "$weartrack" run --no-report - -o r.h5 > said 2>&1 && fail "an endless case"
grep -q 'is larger than 64 MiB' said || fail "an endless case: $(cat said)"

# few file descriptors; the error is not lack of memory
if command -v prlimit > /dev/null; then
  told=no
  for most in 4 5 6 7 8 9; do
    prlimit --nofile=$most:$most "$weartrack" info folder/dma.txt > out 2> said || true
    if grep -q 'no memory' said; then fail "$most descriptors"; fi
    if grep -q 'ulimit -n' said; then told=yes; fi
  done
  [ $told = yes ] || fail "few descriptors: nobody says so"
fi

# the time is proportional to the number of files
mkdir many
(cd many && seq 40000 | xargs -n 2000 touch)
refused 1 'found files: 40000' master many

# cells without a value
printf 'f,E_stor,E_loss,T\nHz,MPa,MPa,C\n1,10,1,20\n2,inf,1,20\n4,12,NaN,20\n8,13,1,20\n16,14,-inf,20\n' > cells.csv
"$weartrack" convert --no-provenance cells.csv > out 2> said
grep -q 'line 4: "inf" in column 2 (E_stor) is no value' said || fail "inf"
grep -q 'line 5: "NaN" in column 3 (E_loss) is no value' said || fail "nan"
[ "$(grep -c '^[0-9]' out)" = 2 ] || fail "rows with a value"

# extreme values
refused 2 'at most 1e+06 m' indent --tip sphere:radius=1e300m x
refused 2 'at most 2000 K' master --reference-temperature 1e300K x
refused 2 'at most 1e+15 Pa' friction -m x --roughness y -v 1m/s -p 1e300Pa
"$weartrack" master -q "$fixtures/case/dma.txt" -o m.h5
refused 2 'at most 1e+15 rad/m' friction -m m.h5 --roughness self-affine:q0=1rad/m,q1=1e300rad/m,hurst=0.8,c0=1m^4 -v 1m/s -p 1Pa
