#!/bin/sh
# The page with all curves in a headless browser: it loads without an error, contains all curves, reacts
# to keys and clicks, and indent reads its manual overrides.
# Usage: browse.sh PROGRAM FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
program=$1 case=$2/case work=$3
chromium=$(command -v chromium || command -v chromium-browser || true)
rm -rf "$work"
mkdir -p "$work"
cd "$work"
fail() {
  echo "FAIL $1" >&2
  exit 1
}

fit="--tip pyramid:half-angle=20deg,radius=20nm --spring-constant 0.3N/m"
# shellcheck disable=SC2086 # a list of words
"$program" indent -q $fit "$case"/bulk-1.jpk-force-map -o plain.h5
if "$program" report --browse none.html plain.h5 2>words.txt; then
  fail "a result without samples is refused"
fi
if grep -q "built without\|has no dygraphs" words.txt; then
  echo "skipped: built without dygraphs"
  exit 77
fi
grep -q "weartrack indent --curves all" words.txt || fail "what to do is said: $(cat words.txt)"
[ ! -e none.html ] || fail "nothing is written"
# shellcheck disable=SC2086
"$program" indent -q $fit --curves all "$case"/bulk-1.jpk-force-map "$case"/bulk-2.jpk-force-map -o all.h5
"$program" report -q --browse page.html --no-provenance all.h5
grep -q "Dan Vanderkam" page.html || fail "the licence is named"
if [ -z "$chromium" ]; then
  echo "skipped: no chromium"
  exit 77
fi

# A copy of the page with a script that sends keys and clicks and prints the outcome.
cat >press.html <<'END'
<script>
const press = (key) => document.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
const told = {};
(async () => {
  document.dispatchEvent = document.body.dispatchEvent.bind(document.body);
  const $ = (id) => document.getElementById(id);
  press('ArrowRight'); press('ArrowDown'); press('ArrowLeft');
  told.second = $('name').textContent;
  $('note').value = 'an edge\twith # and \\';
  $('note').onchange();
  press('x');
  press('End');
  told.last = $('name').textContent;
  $('order').value = 'modulus';
  $('order').onchange();
  press('Home');
  told.stiffest = $('verdict').textContent;
  $('filter').value = 'refused';
  $('filter').onchange();
  told.refused = $('count').textContent;
  $('filter').value = 'byhand';
  $('filter').onchange();
  told.byhand = $('count').textContent;
  $('filter').value = '';
  $('order').value = 'file';
  $('filter').onchange();
  press('Home');
  press('c');
  const canvas = document.querySelector('#curve canvas:last-of-type'), box = canvas.getBoundingClientRect();
  const at = {clientX: box.left + box.width * 0.55, clientY: box.top + box.height / 2, button: 0,
    bubbles: true, cancelable: true, view: window, detail: 1};
  for (const kind of ['pointerdown', 'pointerup']) canvas.dispatchEvent(new PointerEvent(kind, at));
  let blob = null;
  URL.createObjectURL = (made) => { blob = made; return '#'; };
  $('save').click();
  told.file = await blob.text();
  told.canvases = document.querySelectorAll('canvas').length;
  const pre = document.createElement('script');
  pre.type = 'application/json';
  pre.id = 'told';
  pre.textContent = JSON.stringify(told);
  document.body.append(pre);
})();
</script>
END
cat page.html press.html >pressed.html
look() {
  timeout 120 "$chromium" --headless --no-sandbox --disable-gpu --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync \
    --user-data-dir="$work/profile" --virtual-time-budget=10000 --window-size=1400,1000 \
    --dump-dom "file://$work/$1" 2>browser.txt
}
look page.html >page.dom || fail "the browser: $(tail -3 browser.txt)"
head -3 page.dom | grep -q 'data-curves="24"' || fail "24 curves: $(head -c 300 page.dom)"
head -3 page.dom | grep -q 'data-opened=' || fail "the script did not come to its end"
! head -3 page.dom | grep -q 'data-error' || fail "a script error: $(head -c 300 page.dom)"
look pressed.html >pressed.dom
! head -3 pressed.dom | grep -q 'data-error' || fail "a script error: $(head -c 300 pressed.dom)"
told=$(sed -n 's/.*id="told">\(.*\)<\/script>.*/\1/p' pressed.dom)
[ -n "$told" ] || fail "the page did not do what was pressed"
has() {
  case $told in *"$1"*) ;; *) fail "$1: $told" ;; esac
}
has '"second":"bulk-1.jpk-force-map, curve 1"'
has '"last":"bulk-2.jpk-force-map, curve 11"'
has '"stiffest":"accepted: E = '
has '"refused":"0 of 24 curves"'
has '"byhand":"1 of 24 curves"'

# The downloaded file, as the browser wrote it.
printf '%b' "$(printf '%s' "$told" | sed 's/.*"file":"\([^"]*\)".*/\1/')" >choices.tsv
grep -q "contact-point" choices.tsv || fail "a contact point was moved: $(cat choices.tsv)"
# shellcheck disable=SC2086
"$program" indent $fit --curves all --overrides choices.tsv "$case"/bulk-1.jpk-force-map \
  "$case"/bulk-2.jpk-force-map -o again.h5 2>words.txt || fail "the choices: $(cat words.txt)"
"$program" table again.h5 choices >applied.txt
[ "$(grep -c bulk-1.jpk-force-map applied.txt)" -eq 2 ] || fail "two were applied: $(cat applied.txt)"
grep -q "1	exclude		\"\{0,1\}an edge" applied.txt || fail "with the note: $(cat applied.txt)"
"$program" report -q --browse again.html again.h5
look again.html >again.dom
head -3 again.dom | grep -q 'data-choices="2"' || fail "they are handed back: $(head -c 300 again.dom)"

# A curve without contact is drawn from its first sample, with a note.
# shellcheck disable=SC2086
"$program" indent -q $fit --curves rejected --fixed-contact-point 1um "$case"/bulk-1.jpk-force-map -o far.h5 \
  2>words.txt || [ -s far.h5 ] || fail "no curve touches: $(cat words.txt)"
"$program" report -q --browse far.html far.h5
look far.html >far.dom
grep -q "displacement from the first sample (" far.dom || fail "of a curve without a contact point"
grep -q "force as measured (" far.dom || fail "the force of a curve without a contact point"
! grep -q "displacement from the contact point (" far.dom || fail "it has none"
echo "24 curves, keys, clicks, choices there and back"
