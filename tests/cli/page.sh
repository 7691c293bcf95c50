#!/bin/sh
# The page of a report in a real browser: at three widths and on paper nothing is cut off, the results are
# on the first screen, text has a contrast of 4.5, no link is dead, and HTML and XML read the same. Usage:
# page.sh WEARTRACK FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
for browser in chromium chromium-browser google-chrome; do
  ! command -v "$browser" >/dev/null || break
done
command -v "$browser" >/dev/null && command -v gnuplot >/dev/null || { echo "no chromium or no gnuplot: not tried"; exit 77; }
rm -rf "$work"; mkdir -p "$work"; cd "$work"
fail() { echo "$*"; exit 1; }
browse() { # no user profile, no network
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$work/profile" --allow-file-access-from-files "$@" 2>browser.log
}

"$weartrack" run -q "$fixtures/case/case.xml" -o case.h5 --report case.html >/dev/null
# The same with one spot each, a wrong tip and a cold track: three remedies, and warnings on the cards.
cp -r "$fixtures/case" few
sed -e '/spot="[bt][234]"/d' -e 's/radius=20nm/radius=2um/' -e 's/<temperature>30degC/<temperature>-10degC/' \
  few/case.xml > few/warned.xml
"$weartrack" run -q few/warned.xml -o warned.h5 --report warned.html >/dev/null
"$weartrack" master -q "$fixtures/case/dma.txt" -o dma.h5
"$weartrack" report -q dma.h5 -o dma.html
"$weartrack" record -q "$fixtures/record/steps.csv" -o record.h5 >/dev/null 2>&1 || [ $? -eq 3 ]
"$weartrack" report -q record.h5 -o record.html
"$weartrack" run -q "$fixtures/decades/case.xml" -o decades.h5 --report decades.html >/dev/null

# A script writes its results into the document, which the browser prints. A page is in a frame of each
# width, because no window is as narrow as a telephone. The paper width of 180 mm (between the margins of
# A4) uses `@media print` everywhere.
cat > judge.js <<'JUDGE'
const widths = {telephone: 390, tablet: 768, desk: 1400, paper: 680, dark: 1400};
const lines = [];
const say = (...words) => lines.push(words.join(' '));
// Relative luminance and contrast by WCAG 2; a colour without opacity is that of what is behind it.
const luminance = rgb => rgb.slice(0, 3).map(c => c / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
  .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const rgb_of = colour => colour.match(/[\d.]+/g).map(Number);
function background(element) {
  for (let e = element; e; e = e.parentElement) {
    const rgb = rgb_of(e.ownerDocument.defaultView.getComputedStyle(e).backgroundColor);
    if (rgb.length < 4 || rgb[3] > 0) return rgb;
  }
  return [255, 255, 255];
}
function judge_contrast(name, page) {
  let least = 21, where = '';
  for (const e of page.querySelectorAll('main *:not(svg, svg *)')) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())) continue;
    const light = [luminance(rgb_of(page.defaultView.getComputedStyle(e).color)), luminance(background(e))].sort((a, b) => b - a);
    const contrast = (light[0] + 0.05) / (light[1] + 0.05);
    if (contrast < least) { least = contrast; where = e.localName + '.' + e.className; }
  }
  say(name, 'contrast', least >= 4.5 ? 'good' : 'low', least.toFixed(1), where);
}
// The first screen: cards, remedies and limits. The words are those of the page as it opens.
function judge_first_screen(name, page) {
  const cards = [...page.querySelectorAll('.finding')];
  const cut = cards.flatMap(c => [c, ...c.querySelectorAll('p, dl, li, .limits')]).filter(e => e.scrollWidth > e.clientWidth + 1 ||
    e.getBoundingClientRect().right > e.closest('.finding').getBoundingClientRect().right + 1);
  say(name, 'cards', cards.length, 'cut', cut.length, cut.map(e => e.localName + ':' + e.textContent.trim().replace(/\s+/g, ' ')).join('; ').slice(0, 300));
  const last = ['certain', 'limits'].map(id => page.getElementById(id)?.parentElement).filter(e => e);
  if (!last.length) last.push(page.querySelector('.findings'));
  say(name, 'first_screen_ends', Math.round(Math.max(...last.map(e => e?.getBoundingClientRect().bottom ?? -1))));
}
function judge_words(page) {
  for (const picture of page.querySelectorAll('svg')) picture.remove();
  say('words', page.querySelector('main').innerText.split(/\s+/).filter(w => w).length);
}
function judge(name, width, frame) {
  const page = frame.contentDocument, root = page.documentElement, beyond = [];
  judge_first_screen(name, page);
  for (const fold of page.querySelectorAll('details')) fold.open = true;
  say(name, 'overflow', Math.max(0, root.scrollWidth - width));
  for (const box of page.querySelectorAll('.scroll'))
    if (box.scrollWidth > box.clientWidth + 1)
      beyond.push(box.getAttribute('aria-label') + ':' + box.scrollWidth + '>' + box.clientWidth);
  say(name, 'tables_cut', beyond.length, beyond.join('; ').slice(0, 400));
  const sizes = [...page.querySelectorAll('.card svg')].map(s => 15 * s.getScreenCTM().a);
  say(name, 'type', Math.min(...sizes).toFixed(1), 'to', Math.max(...sizes).toFixed(1));
  const keys = [...page.querySelectorAll('.key svg')].filter(s => s.clientHeight).map(s => 15 * s.getScreenCTM().a);
  say(name, 'key_type', Math.min(99, ...keys).toFixed(2));
  judge_contrast(name, page);
  const first = page.querySelector('.finding .verdict, .finding .number');
  say(name, 'answer_begins', first ? Math.round(first.getBoundingClientRect().top) : -1);
}
function judge_links(page, text) {
  let dead = [];
  for (const link of page.querySelectorAll('a[href], link[href], [src], use')) {
    const to = link.getAttribute('href') ?? link.getAttribute('xlink:href') ?? link.getAttribute('src');
    if (to.startsWith('#') ? !page.getElementById(to.slice(1)) : !(to.startsWith('data:') && link.getAttribute('download')))
      dead.push(to.slice(0, 80));
  }
  say('links', page.querySelectorAll('a[href]').length, 'dead', dead.length, dead.slice(0, 5).join(' '));
  const as_xml = new DOMParser().parseFromString(text, 'application/xhtml+xml');
  const tags = d => [...d.querySelectorAll('*')].map(e => e.localName).join(' ');
  say('xml', as_xml.querySelector('parsererror') ? 'broken' : 'whole', 'same', tags(as_xml) === tags(page));
  const ids = [...page.querySelectorAll('[id]')].map(e => e.id);
  say('ids', ids.length, 'twice', ids.length - new Set(ids).size);
}
function frame_of(text, width) {
  return new Promise(done => {
    const frame = document.createElement('iframe');
    frame.style = 'border:0;height:900px;width:' + width + 'px';
    frame.onload = () => done(frame);
    frame.srcdoc = text;
    document.body.append(frame);
  });
}
async function all(text) {
  for (const [name, width] of Object.entries(widths)) {
    let shown = text;
    if (name === 'paper') shown = text.replace('@media print', '@media all').replaceAll('@media screen and', '@media not all and');
    if (name === 'dark') shown = text.replaceAll('(prefers-color-scheme: dark)', '(min-width: 0px)');
    const frame = await frame_of(shown, width);
    if (name === 'desk') judge_links(frame.contentDocument, text);
    judge(name, width, frame);
    frame.remove();
    if (name !== 'desk') continue;
    const opened = await frame_of(text, width);
    judge_words(opened.contentDocument);
    opened.remove();
  }
  const out = document.createElement('pre');
  out.id = 'judgement';
  out.textContent = lines.map(l => 'JUDGED ' + l).join('\n') + '\nJUDGED end\n';
  document.body.append(out);
}
JUDGE

for name in case warned dma decades record; do
  { echo '<!DOCTYPE html><meta charset="utf-8"><body><script>'; cat judge.js
    printf 'all(new TextDecoder().decode(Uint8Array.from(atob("'; base64 -w0 "$name.html"; echo '"), c => c.charCodeAt(0))));</script>'
  } > judge.html
  browse --virtual-time-budget=60000 --dump-dom "file://$work/judge.html" | grep -o 'JUDGED .*' > "$name.judged" || true
  grep -q 'JUDGED end' "$name.judged" || fail "$name: the browser did not come to an end: $(cat browser.log)"
  for width in telephone tablet desk paper; do
    grep -q "JUDGED $width overflow 0\$" "$name.judged" || fail "$name: wider than the $width: $(grep "$width" "$name.judged")"
  done
  for width in telephone desk paper; do # a tablet may scroll
    grep -q "JUDGED $width tables_cut 0" "$name.judged" || fail "$name: columns cut: $(grep "$width tables" "$name.judged")"
  done
  for width in telephone desk; do # the result begins on the first screen, for each kind of result
    begin=$(sed -n "s/.*JUDGED $width answer_begins //p" "$name.judged")
    [ "$begin" -ge 0 ] && [ "$begin" -lt 300 ] || fail "$name: the answer begins at $begin of the $width"
  done
  for width in telephone tablet desk paper; do
    grep -q "JUDGED $width cards [1-9][0-9]* cut 0 *\$" "$name.judged" || fail "$name: cards: $(grep "$width cards" "$name.judged")"
  done
  for width in telephone tablet desk; do # type of the figures on the cards, in px
    sed -n "s/.*JUDGED $width key_type //p" "$name.judged" | awk '$1 >= 9 { good = 1 } END { exit !good }' ||
      fail "$name: $(grep "$width key_type" "$name.judged")"
  done
  for width in desk dark; do
    grep -q "JUDGED $width contrast good" "$name.judged" || fail "$name: $(grep "$width contrast" "$name.judged")"
  done
  end=$(sed -n 's/.*JUDGED desk first_screen_ends //p' "$name.judged")
  [ "$end" -gt 0 ] && [ "$end" -le 900 ] || fail "$name: answers, remedies and limits end at $end"
  if [ $name = case ]; then
    words=$(sed -n 's/.*JUDGED words //p' "$name.judged")
    [ "$words" -gt 300 ] && [ "$words" -le 900 ] || fail "$name: $words words are not folded"
    [ "$(wc -c < "$name.html")" -lt 1000000 ] || fail "$name: $(wc -c < "$name.html") bytes"
  fi
  grep -o '<strong>Figure [0-9]*\. ' "$name.html" | awk '$2 + 0 != NR { exit 1 } END { exit !NR }' ||
    fail "$name: the figures are not numbered from 1 in their order"
  [ $name != dma ] || grep -q 'Data: dma.txt</p>' "$name.html" || fail "$name: files of the data"
  [ $name != warned ] || grep -q 'class="warned"><span>⚠' "$name.html" || fail "$name: no warning on a card"
  grep -q 'JUDGED links [1-9][0-9]* dead 0' "$name.judged" || fail "$name: $(grep links "$name.judged")"
  grep -q 'JUDGED xml whole same true' "$name.judged" || fail "$name: not the same as HTML and as XML: $(grep xml "$name.judged")"
  grep -q 'JUDGED ids [1-9][0-9]* twice 0' "$name.judged" || fail "$name: $(grep ids "$name.judged")"
done
