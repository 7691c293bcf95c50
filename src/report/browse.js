/* Goes through force curves: list, map, histogram, curve with its fit, manual overrides.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const $ = (id) => document.getElementById(id);
  const root = document.documentElement;
  addEventListener('error', (event) => {
    root.dataset.error = event.message;
    $('fault').textContent = 'This page has failed: ' + event.message;
    $('fault').hidden = false;
  });

  /* ---- data ---------------------------------------------------------------------------------- */

  const data = JSON.parse($('data').textContent);
  const usable = (curve) => ['accepted', 'wide', 'doubtful'].includes(curve.verdict);
  const wordsOf = (verdict) => data.verdicts[verdict] || verdict;
  const groups = data.groups.map((group) => ({
    name: group.name,
    curves: group.curves.map((row, index) => ({
      index, file: group.files[row[0]], number: row[1], verdict: row[2], reason: row[3],
      modulus: row[4], error: row[5], contact: row[6], x: row[7], y: row[8], packed: row[9],
      group: group.name,
    })),
  }));
  /* the folder that all files have in common is not shown */
  for (const group of groups) {
    const folders = group.curves.map((c) => c.file.split('/').slice(0, -1));
    let common = folders.length > 0 ? folders[0].length : 0;
    for (const folder of folders)
      while (folder.slice(0, common).join('/') !== folders[0].slice(0, common).join('/')) common--;
    for (const curve of group.curves) curve.short = curve.file.split('/').slice(common).join('/');
  }
  root.dataset.curves = groups.reduce((sum, group) => sum + group.curves.length, 0);

  const PACKED_MOST = 65534, PACKED_NONE = 65535;
  const samplesOf = (curve) => {
    if (curve.packed === null) return null;
    const [n, approach, contact, zLow, zHigh, fLow, fHigh, compliance, text] = curve.packed;
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const numbers = new DataView(bytes.buffer);
    const value = (i, low, high) => {
      const packed = numbers.getUint16(2 * i, true);
      return packed === PACKED_NONE ? null : low + (high - low) * packed / PACKED_MOST;
    };
    const samples = [];
    for (let i = 0; i < n; i++) {
      const displacement = value(i, zLow, zHigh), force = value(n + i, fLow, fHigh);
      let fit = null;
      if (i < approach && curve.modulus !== null)
        fit = i < contact ? 0 : value(2 * n + i - contact, fLow, fHigh);
      samples.push({
        displacement, force, fit, approach: i < approach,
        indentation: displacement - force * (compliance || 0),
      });
    }
    return samples;
  };

  /* ---- numbers ------------------------------------------------------------------------------- */

  const {prefixOf, inUnit} = Shared;
  const largest = (values) => values.reduce((most, v) => v === null ? most :
    Math.max(most, Math.abs(v)), 0);

  /* ---- manual overrides ----------------------------------------------------------------------- */

  const keyOf = (curve) => curve.group + '\t' + curve.index;
  let chosen = {}; /* by key: {out, contact, note} */
  const kept = []; /* rows of before that are not for a curve of this page */
  const curveOf = (file, number, group) => {
    for (const g of groups)
      if (group === '' || g.name === group) {
        const found = g.curves.find((c) => c.file === file && c.number === number) ||
          g.curves.find((c) => ('/' + c.file).endsWith('/' + file) && c.number === number);
        if (found) return found;
      }
    return null;
  };
  const choiceOf = (curve) => chosen[keyOf(curve)] || {};
  for (const row of data.choices) {
    const [group, file, choice, value, note, number] = row;
    const curve = number === null ? null : curveOf(file, number, group);
    const contact = choice === 'contact-point' ? Shared.lengthOf(value) : NaN;
    if (curve === null || (choice !== 'exclude' && Number.isNaN(contact))) {
      kept.push(row);
      continue;
    }
    const to = chosen[keyOf(curve)] = choiceOf(curve);
    if (choice === 'exclude') to.out = true;
    else to.contact = contact;
    if (note !== '') to.note = note;
  }
  let at = null; /* the curve that was shown: {group, index} */
  try {
    if (location.hash.length > 1)
      ({chosen = {}, at = null} = JSON.parse(decodeURIComponent(location.hash.slice(1))));
  } catch (problem) {
    history.replaceState(null, '', '#'); /* an address by another hand */
  }

  const choicesText = () => {
    const rows = kept.map(([group, file, choice, value, note, number]) =>
      [group, file, number === null ? 'nan' : String(number), choice, value, note]);
    for (const group of groups)
      for (const curve of group.curves) {
        const {out, contact, note} = choiceOf(curve);
        const row = (choice, value) =>
          rows.push([group.name, curve.file, String(curve.number), choice, value, note || '']);
        if (out) row('exclude', '');
        if (typeof contact === 'number') row('contact-point', Number(contact.toPrecision(12)) + 'm');
      }
    return {n: rows.length, text: Shared.overridesText(rows)};
  };
  const showChoices = () => {
    const {n, text} = choicesText();
    $('chosen').textContent = n;
    $('text').textContent = text;
    $('text').hidden = n === 0;
    $('save').disabled = n === 0;
    root.dataset.choices = n;
  };
  const choose = (curve, change) => {
    const choice = {...choiceOf(curve), ...change};
    if (!choice.out && typeof choice.contact !== 'number' && !choice.note) delete chosen[keyOf(curve)];
    else chosen[keyOf(curve)] = choice;
    const state = {chosen, at: {group: curve.group, index: curve.index}};
    history.replaceState(null, '', '#' + encodeURIComponent(JSON.stringify(state)));
    showChoices();
    const entry = entries.get(curve);
    if (entry) entry.classList.toggle('out', Boolean(choice.out));
    show();
  };

  /* ---- which curves -------------------------------------------------------------------------- */

  let group = groups[0], shown = [], current = null;
  const entries = new Map();
  const kindOf = (curve) => curve.verdict === 'accepted' ? '' :
    usable(curve) ? 'doubtful' : 'refused';
  const relative = (curve) => curve.modulus > 0 && curve.error !== null ?
    curve.error / curve.modulus : -1;
  const orders = {
    file: () => 0,
    refused: (a, b) => usable(a) - usable(b),
    error: (a, b) => relative(b) - relative(a),
    modulus: (a, b) => (b.modulus === null ? -1 : b.modulus) - (a.modulus === null ? -1 : a.modulus),
  };
  const filters = () => {
    const counts = new Map();
    for (const curve of group.curves) counts.set(curve.verdict, (counts.get(curve.verdict) || 0) + 1);
    const options = [['', 'all'], ['usable', 'usable'], ['refused', 'refused'], ['byhand', 'chosen by hand']];
    for (const [verdict, n] of counts) options.push(['=' + verdict, `${wordsOf(verdict)} (${n})`]);
    $('filter').replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  };
  const passes = (curve) => {
    const filter = $('filter').value;
    if (filter === 'usable') return usable(curve);
    if (filter === 'refused') return !usable(curve);
    if (filter === 'byhand') return keyOf(curve) in chosen;
    return filter === '' || curve.verdict === filter.slice(1);
  };
  const list = () => {
    shown = group.curves.filter(passes).sort(orders[$('order').value]);
    entries.clear();
    $('list').replaceChildren(...shown.map((curve) => {
      const entry = document.createElement('li');
      entry.textContent = `${curve.number}: ` +
        (usable(curve) ? inUnit(curve.modulus, 'Pa') : wordsOf(curve.verdict)) + `, ${curve.short}`;
      entry.className = kindOf(curve);
      entry.classList.toggle('out', Boolean(choiceOf(curve).out));
      entry.addEventListener('click', () => select(curve));
      entries.set(curve, entry);
      return entry;
    }));
    $('count').textContent = `${shown.length} of ${group.curves.length} curves`;
    const next = shown.includes(current) ? current : shown[0] || null;
    drawHistogram();
    select(next);
    drawMap();
  };

  /* ---- histogram and map --------------------------------------------------------------------- */

  const plain = {legend: 'never', drawGrid: true, axisLineColor: '#888', gridLineColor: '#ddd',
    interactionModel: {}, highlightCircleSize: 0};
  let histogram = null, map = null, mapFile = null, span = [0, 0];
  const spanOf = (values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)],
    [Infinity, -Infinity]);
  const drawHistogram = () => {
    const logs = shown.filter((c) => usable(c) && c.modulus > 0).map((c) => Math.log10(c.modulus));
    if (histogram) histogram.destroy();
    histogram = null;
    span = spanOf(logs);
    $('histogram').hidden = logs.length === 0;
    if (logs.length === 0) return;
    /* bins of the rule of Freedman and Diaconis would be empty for few curves: the square root */
    const some = span[1] - span[0] > 1e-6;
    const n = some ? Math.max(4, Math.min(40, Math.ceil(Math.sqrt(logs.length)))) : 1;
    const width = some ? (span[1] - span[0]) / n : 1e-3, counts = new Array(n).fill(0);
    const digits = Math.max(2, Math.ceil(1 - Math.log10(n * width)) + 1);
    for (const log of logs) counts[Math.min(n - 1, Math.floor((log - span[0]) / width))]++;
    const rows = [[span[0] - width, 0], ...counts.map((c, i) => [span[0] + i * width, c]),
      [span[0] + n * width, 0], [span[0] + (n + 1) * width, 0]];
    histogram = new Dygraph($('histogram'), rows, {...plain, labels: ['log E', 'curves'],
      stepPlot: true, fillGraph: true, colors: ['#0b5394'], includeZero: true,
      dateWindow: [rows[0][0], rows[rows.length - 1][0]],
      axes: {x: {axisLabelFormatter: (v) => inUnit(10 ** v, 'Pa', digits), axisLabelWidth: 60,
        pixelsPerLabel: 70}, y: {axisLabelWidth: 36}},
      underlayCallback: (context, area, graph) => {
        if (current === null || !(current.modulus > 0)) return;
        const x = graph.toDomXCoord(Math.log10(current.modulus));
        context.fillStyle = '#c60';
        context.fillRect(x - 1, area.y, 2, area.h);
      }});
  };

  const shades = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const shade = (share) => {
    const at = Math.max(0, Math.min(1, share)) * (shades.length - 1);
    const i = Math.min(shades.length - 2, Math.floor(at));
    return 'rgb(' + shades[i].map((c, k) => Math.round(c + (at - i) * (shades[i + 1][k] - c))) + ')';
  };
  const drawMap = () => {
    if (map) map.destroy();
    map = null;
    /* files that are maps have one each, about places of their own */
    const one = current !== null && group.curves.filter((c) => c.file === current.file).length > 1;
    mapFile = one ? current.file : null;
    const placed = shown.filter((c) => c.x !== null && c.y !== null && (!one || c.file === mapFile));
    const xs = new Set(placed.map((c) => c.x)), ys = new Set(placed.map((c) => c.y));
    const isMap = xs.size > 1 && ys.size > 1;
    $('map').hidden = !isMap;
    $('scale').hidden = !isMap || !(span[1] >= span[0]);
    if (!isMap) return;
    const sorted = [...placed].sort((a, b) => a.x - b.x);
    const [xLow, xHigh] = spanOf([...xs]), [yLow, yHigh] = spanOf([...ys]);
    const [size, prefix] = prefixOf(Math.max(xHigh - xLow, yHigh - yLow));
    const edge = (low, high, n) => (high - low) / Math.max(1, n - 1) * 0.6;
    const ex = edge(xLow, xHigh, xs.size), ey = edge(yLow, yHigh, ys.size);
    const point = (graph, name, context, cx, cy, color, radius, row) => {
      const curve = sorted[row], share = span[1] > span[0] && curve.modulus > 0 ?
        (Math.log10(curve.modulus) - span[0]) / (span[1] - span[0]) : 0.5;
      const area = graph.getArea();
      const w = Math.max(2, Math.ceil(area.w / (xs.size + 0.2)));
      const h = Math.max(2, Math.ceil(area.h / (ys.size + 0.2)));
      const side = xs.size * ys.size > 2 * placed.length ? 6 : null; /* no grid */
      context.fillStyle = usable(curve) ? shade(share) : '#fff';
      context.fillRect(cx - (side || w) / 2, cy - (side || h) / 2, side || w, side || h);
      if (!usable(curve)) {
        context.fillStyle = '#a11';
        context.fillRect(cx - 1.5, cy - 1.5, 3, 3);
      }
    };
    map = new Dygraph($('map'), sorted.map((c) => [c.x / size, c.y / size]), {...plain,
      labels: ['x', 'y'], strokeWidth: 0, drawPoints: true, pointSize: 4,
      drawPointCallback: point, xlabel: `x (${prefix}m)`, ylabel: `y (${prefix}m)`,
      drawGrid: false, dateWindow: [(xLow - ex) / size, (xHigh + ex) / size],
      valueRange: [(yLow - ey) / size, (yHigh + ey) / size],
      axes: {y: {axisLabelWidth: 40}},
      underlayCallback: null,
      drawCallback: (graph) => {
        if (current === null || current.x === null) return;
        const context = graph.hidden_ctx_;
        const x = graph.toDomXCoord(current.x / size), y = graph.toDomYCoord(current.y / size);
        context.lineWidth = 2;
        context.strokeStyle = '#c00';
        context.strokeRect(x - 6, y - 6, 12, 12);
      }});
    const nearest = (event) => {
      const [px, py] = map.eventToDomCoords(event);
      let best = null, least = Infinity;
      for (const curve of sorted) {
        const d = Math.hypot(map.toDomXCoord(curve.x / size) - px, map.toDomYCoord(curve.y / size) - py);
        if (d < least) [best, least] = [curve, d];
      }
      return best;
    };
    $('map').onclick = (event) => select(nearest(event));
    if ($('scale').hidden) return;
    $('low').textContent = inUnit(10 ** span[0], 'Pa');
    $('high').textContent = inUnit(10 ** span[1], 'Pa');
    $('scale').querySelector('i').style.background =
      `linear-gradient(to right, ${[0, .25, .5, .75, 1].map(shade)})`;
  };

  /* ---- one curve ----------------------------------------------------------------------------- */

  let graph = null, residual = null, moving = false, metres = 1;
  const select = (curve) => {
    if (current && entries.has(current)) entries.get(current).removeAttribute('aria-current');
    current = curve;
    moving = false;
    const entry = entries.get(curve);
    if (entry) {
      entry.setAttribute('aria-current', 'true');
      const box = $('list');
      if (entry.offsetTop < box.scrollTop + box.offsetTop ||
          entry.offsetTop + entry.offsetHeight > box.scrollTop + box.offsetTop + box.clientHeight)
        box.scrollTop = entry.offsetTop - box.offsetTop - box.clientHeight / 2;
    }
    show();
    if (histogram) histogram.updateOptions({});
    if (mapFile !== null && curve !== null && curve.file !== mapFile) drawMap();
    else if (map) map.updateOptions({});
  };
  const step = (by) => {
    const at = shown.indexOf(current) + by;
    if (at >= 0 && at < shown.length) select(shown[at]);
  };
  const words = (curve) => {
    const b = document.createElement('b');
    b.textContent = wordsOf(curve.verdict);
    b.className = kindOf(curve);
    const rest = [];
    if (curve.modulus !== null)
      rest.push('E = ' + inUnit(curve.modulus, 'Pa') + (curve.error === null ? '' :
        ' ± ' + (100 * curve.error / Math.abs(curve.modulus)).toPrecision(2) + ' %'));
    if (curve.contact !== null) rest.push('contact at ' + inUnit(curve.contact, 'm', 6));
    const contact = choiceOf(curve).contact;
    if (typeof contact === 'number') rest.push('by hand at ' + inUnit(contact, 'm', 6));
    const says = curve.reason.startsWith(curve.verdict);
    const reason = says ? curve.reason.slice(curve.verdict.length).replace(/^[;:] /, '') : curve.reason;
    if (reason !== '') rest.push(reason);
    $('verdict').replaceChildren(b, rest.length > 0 ? ': ' + rest.join('; ') : '');
  };
  const line = (context, area, x, color, dash) => {
    context.strokeStyle = color;
    context.lineWidth = 1.5;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(x, area.y);
    context.lineTo(x, area.y + area.h);
    context.stroke();
    context.setLineDash([]);
  };
  const clearCurve = (message) => {
    if (graph) graph.destroy();
    if (residual) residual.destroy();
    graph = residual = null;
    const p = document.createElement('p');
    p.id = 'empty';
    p.textContent = message;
    $('curve').replaceChildren(p);
    $('residual').replaceChildren();
  };
  const draw = (curve, samples) => {
    const axis = $('axis').value;
    const [xSize, xPrefix] = prefixOf(largest(samples.map((s) => s[axis])) / 2 || 1);
    const [ySize, yPrefix] = prefixOf(largest(samples.map((s) => s.force)) / 2 || 1);
    metres = xSize;
    /* without a contact point: from its first sample, and no baseline is taken off */
    const from = curve.contact !== null ? ' from the contact point' :
      axis === 'displacement' ? ' from the first sample' : ' without a contact point';
    const at = (v, size) => v === null ? null : v / size;
    const rows = samples.map((s) => [s[axis] / xSize, s.approach ? at(s.force, ySize) : null,
      s.approach ? null : at(s.force, ySize), at(s.fit, ySize),
      s.fit === null ? null : (s.force - s.fit) / ySize]).sort((a, b) => a[0] - b[0]);
    const lines = axis === 'displacement' ? 1 : 0;
    /* half a label: without room at the end the last would be moved away from its place */
    const common = {rightGap: 26, connectSeparatedPoints: true, axisLineColor: '#888',
      gridLineColor: '#ddd',
      highlightCircleSize: 3, drawPoints: true, pointSize: 1.2,
      underlayCallback: (context, area, g) => {
        if (curve.contact === null) return;
        line(context, area, g.toDomXCoord(0), '#0b5394', []);
        const contact = choiceOf(curve).contact;
        if (typeof contact === 'number')
          line(context, area, g.toDomXCoord((contact - curve.contact) / xSize), '#c60', [6, 4]);
      }};
    const labels = [axis, 'approach', 'retract', 'fit'];
    const options = {...common, labels, colors: ['#222', '#999', '#c00'],
      series: {approach: {strokeWidth: lines}, retract: {strokeWidth: lines},
        fit: {strokeWidth: 2, drawPoints: false}},
      xlabel: `${axis}${from} (${xPrefix}m)`,
      ylabel: `force${curve.contact === null ? ' as measured' : ''} (${yPrefix}N)`, legend: 'always',
      axes: {x: {pixelsPerLabel: 45}, y: {axisLabelWidth: 52}},
      legendFormatter: (legend) => legend.series.map((s) =>
        `<span style="color:${s.color}">&#9644; ${s.label}${s.y === undefined ? '' :
          ' ' + Number(s.y.toPrecision(4))}</span>`).join(' &nbsp; ')};
    const [rSize, rPrefix] = prefixOf(largest(rows.map((r) => r[4])) * ySize / 2 || 1);
    const left = rows.filter((r) => r[4] !== null).map((r) => [r[0], r[4] * ySize / rSize]);
    if (graph) graph.destroy();
    if (residual) residual.destroy();
    $('curve').replaceChildren();
    $('residual').replaceChildren();
    graph = new Dygraph($('curve'), rows.map((r) => r.slice(0, 4)), options);
    residual = left.length < 2 ? null : new Dygraph($('residual'), left, {...common,
      labels: [axis, 'residual'], colors: ['#222'], strokeWidth: lines, legend: 'never',
      dateWindow: graph.xAxisRange(), xlabel: '', ylabel: `residual (${rPrefix}N)`,
      axes: {x: {pixelsPerLabel: 45}, y: {axisLabelWidth: 52, pixelsPerLabel: 20}}});
    graph.updateOptions({zoomCallback: (from, to) => {
      if (residual) residual.updateOptions({dateWindow: [from, to]});
    }}, true);
  };
  const show = () => {
    const curve = current;
    const canMove = curve !== null && curve.contact !== null && curve.packed !== null;
    for (const id of ['exclude', 'note', 'previous', 'next']) $(id).disabled = curve === null;
    $('move').disabled = !canMove;
    $('move').setAttribute('aria-pressed', moving);
    $('curve').classList.toggle('moving', moving);
    if (curve === null) {
      $('name').textContent = 'No curve';
      $('verdict').replaceChildren();
      clearCurve('No curve is like that.');
      return;
    }
    const choice = choiceOf(curve);
    $('name').textContent = `${curve.short}, curve ${curve.number}`;
    $('name').title = curve.file;
    words(curve);
    $('exclude').checked = Boolean(choice.out);
    $('note').value = choice.note || '';
    $('back').disabled = !(keyOf(curve) in chosen);
    const samples = samplesOf(curve);
    if (samples === null)
      clearCurve('The samples of this curve are not in the result: weartrack indent --curves all');
    else if (samples.length < 2) clearCurve('This curve has no samples.');
    else draw(curve, samples);
  };
  /* At this displacement from the fitted contact point; in an axis of indentation the two agree
   * where the cantilever is straight, which is where contact begins. */
  const place = (x) => {
    moving = false;
    choose(current, {contact: current.contact + x * metres});
  };
  const startMove = () => {
    if ($('move').disabled) return;
    moving = !moving;
    if (moving) $('axis').value = 'displacement';
    show();
  };

  /* ---- what is pressed ----------------------------------------------------------------------- */

  $('previous').onclick = () => step(-1);
  $('next').onclick = () => step(1);
  $('exclude').onchange = () => choose(current, {out: $('exclude').checked});
  $('note').onchange = () => choose(current, {note: $('note').value.trim()});
  $('move').onclick = startMove;
  $('back').onclick = () => choose(current, {out: false, contact: null, note: ''});
  $('curve').addEventListener('pointerup', (event) => {
    if (moving && graph) place(graph.toDataXCoord(graph.eventToDomCoords(event)[0]));
  });
  $('axis').onchange = show;
  $('filter').onchange = $('order').onchange = list;
  $('group').onchange = () => {
    group = groups[$('group').selectedIndex];
    filters();
    list();
  };
  $('save').onclick = () => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([choicesText().text], {type: 'text/tab-separated-values'}));
    link.download = 'choices.tsv';
    link.click();
    URL.revokeObjectURL(link.href);
  };
  const keys = {ArrowRight: () => step(1), ArrowDown: () => step(1), ArrowLeft: () => step(-1),
    ArrowUp: () => step(-1), Home: () => select(shown[0] || null),
    End: () => select(shown[shown.length - 1] || null), c: startMove,
    x: () => current && choose(current, {out: !choiceOf(current).out}),
    r: () => $('back').disabled || $('back').onclick()};
  addEventListener('keydown', (event) => {
    const typing = event.target.matches('input[type=text], select');
    if (typing || event.ctrlKey || event.altKey || event.metaKey || !(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });

  $('group').replaceChildren(...groups.map((g) => new Option(g.name, g.name)));
  if (at !== null && groups.some((g) => g.name === at.group)) {
    group = groups.find((g) => g.name === at.group);
    current = group.curves[at.index] || null;
    $('group').value = group.name;
  }
  filters();
  showChoices();
  list();
  root.dataset.opened = Math.round(performance.now()); /* milliseconds */
})();
