#!/bin/sh
# convert --contact uses the contact points of the file with this name, not of another path with the same
# end. Usage: contact_names.sh WEARTRACK FIXTURES WORK. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work/a" "$work/b"; cd "$work"
fail() { echo "$*"; exit 1; }
cp "$fixtures/case/bulk-1.jpk-force-map" a/spot.jpk-force-map
cp "$fixtures/case/bulk-2.jpk-force-map" b/spot.jpk-force-map
cp "$fixtures/case/bulk-3.jpk-force-map" spot.jpk-force-map
tip=pyramid:half-angle=20deg,radius=20nm
first() { grep -v '^#' | head -n 1; }
for place in a/ b/ ''; do
  "$weartrack" indent -q --tip $tip ${place}spot.jpk-force-map -o alone.tsv
  "$weartrack" convert -q --contact alone.tsv ${place}spot.jpk-force-map -o alone.txt
  first <alone.txt >"expected$(echo "$place" | tr -d /)"
done
"$weartrack" indent -q --tip $tip a/spot.jpk-force-map b/spot.jpk-force-map spot.jpk-force-map -o all.tsv
for place in a/ b/ ''; do
  "$weartrack" convert -q --contact all.tsv ${place}spot.jpk-force-map -o found.txt
  [ "$(first <found.txt)" = "$(cat "expected$(echo "$place" | tr -d /)")" ] ||
    fail "${place}spot.jpk-force-map has the contact of another file"
done
# from another folder the name is ambiguous
"$weartrack" indent -q --tip $tip a/spot.jpk-force-map b/spot.jpk-force-map -o two.tsv
cd b
! "$weartrack" convert --contact ../two.tsv spot.jpk-force-map -o found.txt 2>words || fail "one of two was taken"
grep -q 'two files of ../two.tsv are called so' words
