#!/bin/sh
# Runs the commands of weartrack-gallery(7) and writes their figures to one page, WORK/gallery.html. Fails
# if a command fails, if a named figure is not drawn, and if a figure of weartrack is not named.
# Usage: gallery.sh WEARTRACK MAN FIXTURES WORK. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 man=$2 fixtures=$3 work=$4
command -v gnuplot >/dev/null || { echo "no gnuplot: not tried"; exit 77; }
rm -rf "$work"; mkdir -p "$work"; cd "$work"
mkdir bin fixtures
ln -s "$weartrack" bin/weartrack
PATH=$work/bin:$PATH
cp -R "$fixtures"/. fixtures
chmod -R u+w fixtures
fail() { echo "$*"; exit 1; }

# Lines of the page with a kind: title, command, figures, text.
awk '
  /^\.SH DESCRIPTION/ { on = 1; next }
  /^\.SH/ { on = 0 }
  !on { next }
  /^\.SS / { print "title " substr($0, 5); next }
  /^\.RS/ { session = 1; next }
  /^\.RE/ { session = 0; next }
  /^\./ { next }
  { gsub(/\\f[BIR]/, ""); gsub(/\\-/, "-") }
  session && /^\$ / { command = substr($0, 3) }
  session && !/^\$ / { sub(/^ */, " "); command = command $0 }
  session { if (sub(/ *\\e$/, "", command)) next; print "command " command; next }
  /^Figures: / { gsub(/,/, ""); print "figures " substr($0, 10); next }
  { print "text " $0 }
' "$man/weartrack-gallery.7" >lines

escape() { sed 's/&/\&amp;/g; s/</\&lt;/g'; }
{
  cat <<'HEAD'
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Figures of weartrack</title>
<style>
body { font: 1rem/1.5 system-ui, sans-serif; max-width: 78rem; margin: 1rem auto; padding: 0 1rem; }
pre { background: #f5f7f9; padding: 0.6rem; overflow-x: auto; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(24rem, 100%), 1fr)); gap: 1.2rem; }
figure { margin: 0; } img { width: 100%; } figcaption { font-size: 0.9rem; }
</style></head><body><h1>Figures of weartrack</h1>
HEAD
  while read -r kind rest; do
    case $kind in
      title) printf '<h2>%s</h2>\n' "$(printf '%s' "$rest" | escape)" ;;
      text) printf '<p>%s</p>\n' "$(printf '%s' "$rest" | escape)" ;;
      command)
        printf '%s' "$rest" | escape | sed 's/^/<pre>/; s/$/<\/pre>\n/'
        (cd fixtures && eval "$rest") >said 2>&1 </dev/null || { echo "fails: $rest" >&2; cat said >&2; exit 1; } ;;
      figures)
        echo '<div class="figures">'
        for name in $rest; do
          # the latest file, because several reports may have the figure
          # shellcheck disable=SC2012 # the names are those of the page
          picture=$(ls -t fixtures/*/plots/"$name.svg" 2>/dev/null | head -n 1)
          [ -n "$picture" ] || { echo "not drawn: $name" >&2; exit 1; }
          script=${picture%.svg}.gp
          title=$(sed -n '1s/^# \(.*\)\. To draw it again.*/\1/p' "$script")
          printf '<figure><img alt="%s" src="data:image/svg+xml;base64,%s">' "$title" "$(base64 <"$picture" | tr -d '\n')"
          printf '<figcaption><strong>%s</strong> (%s). %s</figcaption></figure>\n' "$title" "$name" \
            "$(sed -n '3s/^# //p' "$script" | escape)"
        done
        echo '</div>' ;;
    esac
  done <lines
  echo '</body></html>'
} >gallery.html || exit 1

named=$(sed -n 's/^figures //p' lines | tr ' ' '\n' | sort)
known=$(sed -n '/^\.\\" figures$/,/^\.\\" end$/s/^\.IR \([a-z_]*\).*/\1/p' "$man/weartrack-report.1" | sort)
[ -n "$known" ] || fail "weartrack-report(1) names no figures"
[ "$named" = "$known" ] || { printf '%s\n' "$named" >named; printf '%s\n' "$known" | diff named - ; fail "not each figure stands once in the gallery"; }
[ "$(grep -c '<figure>' gallery.html)" -eq "$(printf '%s\n' "$known" | wc -l)" ] || fail "gallery.html lacks figures"
