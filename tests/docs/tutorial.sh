#!/bin/sh
# Session of a page, weartrack-tutorial(7) or weartrack-source(7): its commands run and print what the
# page shows.
# Usage: tutorial.sh WEARTRACK PAGE FIXTURES WORK. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 page=$2 fixtures=$3 work=$4
rm -rf "$work"; mkdir -p "$work/bin"; cd "$work"
ln -s "$weartrack" bin/weartrack
PATH=$work/bin:$PATH
cp -R "$fixtures/case" "$fixtures/compounds" "$fixtures/dma" "$fixtures/severity" "$fixtures/surface" "$fixtures/decades" "$fixtures/transverse" .
chmod -R u+w case
sed -n '/^\.RS$/,/^\.RE$/{/^\.R[SE]$/d;s/\\-/-/g;p;}' "$page" >session
cd case
n=0
while IFS= read -r line; do
  case $line in
    '$ '*)
      n=$((n + 1))
      eval "${line#\$ }" >said 2>&1 || { echo "fails: ${line#\$ }"; cat said; exit 1; }
      said=$(tr -s ' \n' ' ' <said) ;;
    *)
      shown=$(printf '%s' "$line" | tr -s ' ')
      case $said in
        *"$shown"*) ;;
        *) echo "the page shows, and the command does not say: $shown"; cat said; exit 1 ;;
      esac ;;
  esac
done <../session
[ "$n" -ge 10 ] || { echo "only $n commands on the page"; exit 1; }
