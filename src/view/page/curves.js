/* Panel Curves: list, map and histogram of the force curves of a group; one curve with its fit, refitted
 * while contact point or fit range is dragged; manual overrides.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const {element} = View, inUnit = Plot.inUnit;
  const usable = (verdict) => ['accepted', 'wide', 'doubtful'].includes(verdict);
  const words = (verdict) => View.state().verdicts[verdict] || verdict;
  const AUTOMATIC = 1000; /* larger groups are refitted by a button */
  const wanted = 'indentation/bulk indentation/track modulus_groups comparison modulus_depth';
  let ui = null, groups = {}, group = 'bulk', rows = [], shown = [], at = -1, fit = null, origin = 0, originOf = '';
  let live = null;
  /* A result without a case, of weartrack indent, is shown as it is; no curve is fitted. */
  const hasCase = () => View.text() !== '';

  /* ---- overrides: rows of the file that indent reads ------------------------------------------ */

  let overrides = [];
  const undone = [];
  const names = ['group', 'file', 'curve', 'choice', 'value', 'note'];
  const readOverrides = (text) => {
    let columns = names;
    overrides = [];
    for (const line of (text || '').split('\n')) {
      if (line.startsWith('# ')) columns = line.slice(2).split('\t').map((c) => c.replace(/\[.*/, ''));
      if (line === '' || line.startsWith('#')) continue;
      const cells = line.split('\t').map(Shared.unescapeCell), row = {};
      columns.forEach((name, k) => { row[name] = cells[k] || ''; });
      overrides.push(row);
    }
  };
  const overridesText = () => Shared.overridesText(overrides.map((row) => names.map((name) => row[name] || '')));
  const fileChoices = ['spring-constant'];
  const isOfFile = (row, curve) => (row.group === '' || row.group === group) && row.file === curve.file;
  const belongs = (row, curve) => isOfFile(row, curve) && row.curve === String(curve.curve);
  const chosen = (curve, choice) => overrides.find((row) => row.choice === choice &&
    (fileChoices.includes(choice) ? isOfFile : belongs)(row, curve));
  /* Writes follow one another, as each replaces the file of the one before. Meanwhile the rows here are
   * newer than those of the state. */
  let writing = 0, last = Promise.resolve();
  const writeNow = async () => {
    const text = overridesText(), state = View.state();
    if (state.overrides.name === null)
      throw new Error('The overrides of the case are in another folder: move the file beside the case and correct <overrides>.');
    const {digest} = await View.call('save', {name: state.overrides.name, was: state.overrides.digest}, text);
    View.setOverrides(text, digest);
    if (hasCase() && !View.has('indentation/overrides')) View.edit({'indentation/overrides': state.overrides.name});
    document.documentElement.dataset.overrides = overrides.length;
  };
  const write = async () => {
    writing++;
    const mine = last.then(writeNow);
    last = mine.catch(() => null);
    try {
      await mine;
    } finally {
      writing--;
    }
  };
  /* Sets or removes (null) overrides of the curve or its file, writes the file and fits again. */
  const choose = View.guard(async (curve, values, note) => {
    undone.push(overrides.map((row) => ({...row})));
    for (const [choice, value] of Object.entries(values)) {
      const old = chosen(curve, choice);
      overrides = overrides.filter((row) => row !== old);
      if (value !== null)
        overrides.push({group, file: curve.file, curve: fileChoices.includes(choice) ? 'nan' : String(curve.curve),
          choice, value, note: note || ''});
    }
    await write();
    await refit(curve);
    groupFit();
  });
  const undo = View.guard(async () => {
    if (undone.length === 0) return;
    overrides = undone.pop();
    await write();
    if (rows[at]) await refit(rows[at]);
    groupFit();
  });

  /* ---- the curve ------------------------------------------------------------------------------ */

  const request = View.latest(async (curve, option, source) => {
    const parameters = {group, file: curve.file, number: curve.curve, ...option};
    const reply = await View.call('curve', parameters, source || View.text());
    const [row, samples] = reply.tables.map(View.table);
    return {row: row.rows[0], keys: row.keys, samples, time: reply.time};
  });
  /* Samples of the segments; positions count from the contact point that is marked `as fitted`. */
  const series = () => {
    const t = fit.samples, axis = ui.axis.value;
    const shift = axis === 'displacement' && fit.row.contact_point !== null ?
      fit.row.contact_point - origin : 0;
    const x = t.column(axis).map((v) => v === null ? null : v + shift);
    const force = t.column('force'), model = t.column('fitted_force'), segment = t.column('segment');
    const part = (name) => segment.map((s, i) => s === name ? force[i] : null);
    return {x, model, force, lines: [
      {name: 'retract', x, y: part('retract'), color: 'var(--s4)', width: 1.5},
      {name: 'approach', x, y: part('approach'), color: 'var(--s0)', kind: 'points', width: 3},
      {name: 'fit', x, y: model, color: 'var(--fit)', width: 2.5}],
    residual: [{x, y: force.map((f, i) => model[i] === null ? null : f - model[i]),
      color: 'var(--s0)', kind: 'points', width: 2.5}]};
  };
  const describe = (curve) => {
    const row = fit.row;
    ui.modulus.textContent = row.modulus === null ? words(row.verdict) :
      `E = ${Plot.withError(row.modulus, row.modulus_standard_error, 'Pa')}`;
    ui.verdict.textContent = [row.reason === '' || row.reason.startsWith(row.verdict) ? row.reason || words(row.verdict) :
      `${words(row.verdict)}: ${row.reason}`,
      `contact point ${inUnit(row.contact_point, 'm', 6)}`,
      `noise ${inUnit(row.noise, 'N', 2)}`, `lack of fit ${inUnit(row.lack_of_fit, '1', 2)}`,
      hasCase() ? `refitted in ${(fit.time * 1000).toFixed(0)} ms` : 'as in the result'].join('; ');
    const out = chosen(curve, 'exclude');
    ui.exclude.checked = Boolean(out);
    ui.note.value = out ? out.note : '';
    ui.free.disabled = !byHand.some((choice) => chosen(curve, choice));
    const stated = chosen(curve, 'spring-constant');
    ui.spring.value = stated ? stated.value : '';
    document.documentElement.dataset.modulus = row.modulus;
    document.documentElement.dataset.contact = row.contact_point;
  };
  const metres = (text, missing) => {
    const length = Shared.lengthOf(text || '');
    return Number.isNaN(length) ? missing : length;
  };
  const byHand = ['contact-point', 'baseline-from', 'baseline-to'];
  const rangeValues = {'fit-depth': 'End of the fit', 'fit-depth-from': 'Begin of the fit'};
  const markers = (curve) => {
    if (fit.row.contact_point === null || !hasCase()) return [];
    if (ui.axis.value === 'displacement') {
      const contact = fit.row.contact_point - origin;
      const first = Math.min(...fit.samples.column('displacement').filter((v) => v !== null)) + contact;
      const now = (choice, missing) => {
        const row = chosen(curve, choice);
        return metres(row && row.value, missing + origin) - origin;
      };
      /* The end stands beside the contact point while the baseline reaches it. */
      const places = {'contact-point': [contact, 'contact point'],
        'baseline-from': [now('baseline-from', first), 'begin of the baseline'],
        'baseline-to': [now('baseline-to', contact + 0.06 * (first - contact)), chosen(curve, 'baseline-to') ?
          'end of the baseline' : 'baseline to contact']};
      return Object.entries(places).map(([choice, [x, label]]) => ({x, label, unit: 'm',
        color: choice === 'contact-point' ? null : 'var(--s2)', side: choice === 'baseline-to' ? 'left' : 'right',
        focused: document.activeElement && label === document.activeElement.getAttribute('aria-label'),
        moved: (to, done) => drag(curve, choice, to + origin, done)}));
    }
    const high = Plot.range(fit.samples.column('indentation'))[1];
    return Object.entries(rangeValues).map(([name, label]) => ({x: metres(View.get('indentation/' + name), name === 'fit-depth' ? high : 0),
      label, unit: 'm', moved: (x, done) => dragRange(curve, name, x, done)}));
  };
  const draw = (curve) => {
    const s = series();
    const x = {label: ui.axis.value === 'displacement' ? 'displacement from the first contact point' :
      'indentation', unit: 'm'};
    live = Plot.draw(ui.plot, {title: `Force against ${ui.axis.value}`, height: 340, x,
      y: {label: 'force', unit: 'N'}, series: s.lines, markers: markers(curve)});
    Plot.draw(ui.residual, {title: 'Residual', height: 150, x, y: {label: 'residual', unit: 'N'},
      series: s.residual});
    describe(curve);
  };
  const update = async (curve, option, source, done) => {
    const made = await request(curve, option, source);
    if (made === null || rows[at] !== curve) return;
    fit = made;
    if (done) draw(curve);
    else {
      live.update(series().lines);
      describe(curve);
    }
  };
  const lengthText = (value) => Number(value.toPrecision(12)) + 'm';
  /* The text of the override is what is fitted, so that its digits are those of the shell. */
  const drag = View.guard(async (curve, choice, position, done) => {
    const value = lengthText(position);
    await update(curve, {name: choice === 'contact-point' ? 'fixed-contact-point' : choice, value}, null, false);
    if (done) await choose(curve, {[choice]: value}, ui.note.value);
  });
  const nanometres = (value) => Number((value * 1e9).toPrecision(4)) + 'nm';
  const dragRange = View.guard(async (curve, name, value, done) => {
    const values = {['indentation/' + name]: value > 0 ? nanometres(value) : null};
    await update(curve, null, View.changed(values), false);
    if (done) View.edit(values);
  });
  const refit = async (curve) => {
    await update(curve, null, null, true);
    if (!fit || rows[at] !== curve) return;
    Object.assign(curve, fit.row);
    list();
  };
  const select = View.guard(async (curve) => {
    at = rows.indexOf(curve);
    if (at < 0) return;
    for (const [k, entry] of [...ui.list.children].entries()) {
      entry.setAttribute('aria-selected', shown[k] === curve);
      if (shown[k] === curve) entry.scrollIntoView({block: 'nearest'});
    }
    ui.name.textContent = `${curve.file}, curve ${curve.curve}`;
    const made = await request(curve, null, null);
    if (made === null) return;
    fit = made;
    /* The same curve, fitted again with its group, stays where it is on the axis. */
    const name = `${group} ${curve.file} ${curve.curve}`;
    if (name !== originOf) origin = fit.row.contact_point || 0;
    originOf = name;
    draw(curve);
    drawMap();
  });
  const step = (n) => {
    const k = shown.indexOf(rows[at]) + n;
    if (shown[k]) select(shown[k]);
  };

  /* ---- the group ------------------------------------------------------------------------------ */

  const orders = {
    file: () => 0,
    rejected: (a, b) => usable(a.verdict) - usable(b.verdict),
    error: (a, b) => b.modulus_standard_error / b.modulus - a.modulus_standard_error / a.modulus,
    modulus: (a, b) => b.modulus - a.modulus,
  };
  const passes = (curve) => ({all: true, usable: usable(curve.verdict), rejected: !usable(curve.verdict),
    chosen: overrides.some((row) => belongs(row, curve))}[ui.filter.value]);
  const list = () => {
    shown = rows.filter(passes).sort(orders[ui.order.value]);
    ui.list.replaceChildren(...shown.map((curve) => {
      const entry = element('li', {role: 'option', 'aria-selected': curve === rows[at],
        class: chosen(curve, 'exclude') ? 'out' : usable(curve.verdict) ? '' : 'bad',
        onclick: () => select(curve)}, `${curve.curve}: ` + (usable(curve.verdict) ?
        inUnit(curve.modulus, 'Pa') : words(curve.verdict)) + `, ${curve.file}`);
      return entry;
    }));
    ui.count.textContent = `${shown.length} of ${rows.length} curves`;
    document.documentElement.dataset.curves = rows.length;
    histogram();
  };
  const histogram = () => {
    const values = shown.filter((c) => usable(c.verdict) && c.modulus > 0).map((c) => c.modulus);
    ui.histogram.hidden = values.length < 2;
    if (values.length < 2) return;
    const [low, high] = Plot.range(values, true), n = Math.max(4, Math.min(40, Math.ceil(Math.sqrt(values.length))));
    const width = Math.log(high / low) / n || 1e-3, counts = new Array(n).fill(0);
    for (const v of values) counts[Math.min(n - 1, Math.floor(Math.log(v / low) / width))]++;
    const x = [], y = [];
    counts.forEach((c, k) => {
      x.push(low * Math.exp(k * width), low * Math.exp((k + 1) * width));
      y.push(c, c);
    });
    Plot.draw(ui.histogram, {title: 'Histogram of E', height: 150, x: {label: 'E', unit: 'Pa'},
      y: {label: 'curves', range: [0, Math.max(...counts) * 1.05]},
      series: [{x: [x[0], ...x, x[x.length - 1]], y: [0, ...y, 0], color: 'var(--s0)'}]});
  };
  /* Map of the file of the selected curve. */
  const drawMap = () => {
    const curve = rows[at], placed = curve ? rows.filter((c) => c.file === curve.file && c.x !== null) : [];
    const xs = [...new Set(placed.map((c) => c.x))].sort((a, b) => a - b);
    const ys = [...new Set(placed.map((c) => c.y))].sort((a, b) => a - b);
    const isMap = xs.length > 1 && ys.length > 1 && xs.length * ys.length <= 2 * placed.length;
    ui.map.hidden = ui.scale.hidden = !isMap;
    if (!isMap) return;
    const side = Math.max(1, Math.floor(320 / xs.length)), canvas = ui.map;
    canvas.width = side * xs.length;
    canvas.height = side * ys.length;
    const context = canvas.getContext('2d');
    const [low, high] = Plot.range(placed.filter((c) => usable(c.verdict)).map((c) => c.modulus), true);
    const place = new Map(xs.map((v, k) => [v, k])), line = new Map(ys.map((v, k) => [v, ys.length - 1 - k]));
    for (const c of placed) {
      const share = high > low ? Math.log(c.modulus / low) / Math.log(high / low) : 0.5;
      context.fillStyle = usable(c.verdict) ? `rgb(${Plot.shade(share)})` : '#888';
      context.fillRect(place.get(c.x) * side, line.get(c.y) * side, side, side);
      if (chosen(c, 'exclude') || !usable(c.verdict)) {
        context.fillStyle = '#c00';
        context.fillRect((place.get(c.x) + 0.35) * side, (line.get(c.y) + 0.35) * side, side * 0.3, side * 0.3);
      }
    }
    context.strokeStyle = '#e00000';
    context.lineWidth = Math.min(4, Math.max(1, side / 8));
    context.strokeRect(place.get(curve.x) * side, line.get(curve.y) * side, side, side);
    canvas.onclick = (event) => {
      const box = canvas.getBoundingClientRect();
      const x = xs[Math.floor((event.clientX - box.left) / box.width * xs.length)];
      const y = ys[ys.length - 1 - Math.floor((event.clientY - box.top) / box.height * ys.length)];
      const found = placed.find((c) => c.x === x && c.y === y);
      if (found) select(found);
    };
    ui.scale.textContent = `${inUnit(low, 'Pa')} (dark) to ${inUnit(high, 'Pa')} (light)`;
  };
  const showGroup = () => {
    const before = rows[at], t = groups['indentation/' + group];
    rows = t ? t.rows : [];
    at = before ? rows.findIndex((c) => c.file === before.file && c.curve === before.curve) : -1;
    list();
    if (rows.length === 0) return null;
    return select(rows[at] || shown[0] || rows[0]);
  };
  /* E against depth from the fitted contact points of both groups. */
  const drawDepth = () => {
    const all = groups.modulus_depth, series = [];
    for (const [k, name] of ['bulk', 'track'].entries()) {
      const part = all ? all.rows.filter((row) => row.group === name) : [];
      if (part.length === 0) continue;
      const x = part.map((row) => row.depth), color = Plot.colors[k];
      series.push({kind: 'band', x, y: [], low: part.map((row) => row.low), high: part.map((row) => row.high), color},
        {name, x, y: part.map((row) => row.modulus), color});
    }
    ui.depth.hidden = series.length === 0;
    if (series.length > 0) Plot.draw(ui.depth, {title: 'E against depth', height: 220, x: {label: 'indentation', unit: 'm'},
      y: {label: 'E at this depth', unit: 'Pa'}, series});
  };
  const showCards = () => {
    const g = groups.modulus_groups, c = groups.comparison;
    const cards = [];
    for (let i = 0; g && i < g.n; i++) {
      const row = g.rows[i];
      cards.push(element('div', {class: 'card'}, element('b', {}, row.group),
        element('p', {class: 'big'}, inUnit(row.geometric_mean, 'Pa')),
        element('p', {class: 'soft'}, (row.low === null ? 'one spot: no interval; ' :
          `${inUnit(row.low, 'Pa')} to ${inUnit(row.high, 'Pa')} (95 %); `) +
          `${row.n} curves, ${row.n_rejected} rejected`)));
    }
    const ratio = c && c.keys.modulus_ratio;
    if (ratio) cards.push(element('div', {class: 'card'}, element('b', {}, 'track to bulk'),
      element('p', {class: 'big'}, inUnit(ratio.value, '1')),
      element('p', {class: 'soft'}, `± ${inUnit(ratio.standard_error, '1', 2)} (standard error)`)));
    ui.cards.replaceChildren(...cards);
    drawDepth();
  };
  const groupFit = View.guard(async (always) => {
    if (!hasCase()) return;
    if (!always && rows.length > AUTOMATIC) {
      ui.refit.hidden = false;
      return;
    }
    ui.cards.classList.add('busy');
    const made = await View.preview(wanted, 0);
    if (made === null) return;
    ui.cards.classList.remove('busy');
    ui.refit.hidden = true;
    groups = made;
    showCards();
    document.documentElement.dataset.grouptime = made.time;
    await showGroup();
  });

  /* The box may still show the curve before, so that the overrides decide. */
  const exclude = () => rows[at] && choose(rows[at], {exclude: chosen(rows[at], 'exclude') ? null : ''},
    ui.note.value);

  /* ---- the panel ------------------------------------------------------------------------------ */

  const options = (entries) => entries.map(([value, text]) => element('option', {value}, text));
  const label = (text, control) => element('label', {}, text + ' ', control);
  View.add({
    id: 'curves', title: 'Curves',
    build(host) {
      const e = (name, attributes, ...children) => element(name, attributes, ...children);
      ui = {
        group: e('select', {onchange: () => { group = ui.group.value; at = -1; showGroup(); }}),
        filter: e('select', {onchange: () => { list(); drawMap(); }}, ...options([['all', 'all'], ['usable', 'usable'],
          ['rejected', 'rejected'], ['chosen', 'with an override']])),
        order: e('select', {onchange: () => list()}, ...options([['file', 'file'], ['rejected', 'rejected first'],
          ['error', 'error of E'], ['modulus', 'E']])),
        axis: e('select', {onchange: () => rows[at] && fit && draw(rows[at])}, ...options([
          ['displacement', 'displacement'], ['indentation', 'indentation, with the fit range']])),
        count: e('span', {class: 'soft', role: 'status'}), map: e('canvas', {hidden: true, role: 'img',
          'aria-label': 'Map of E; the list has the same curves'}),
        scale: e('p', {class: 'soft'}), histogram: e('div', {}),
        list: e('ol', {class: 'list', tabindex: 0, role: 'listbox', 'aria-label': 'Curves'}),
        name: e('h2', {}), modulus: e('p', {class: 'big'}), verdict: e('p', {class: 'soft'}),
        plot: e('div', {}), residual: e('div', {}), depth: e('div', {}), cards: e('div', {class: 'halves'}),
        exclude: e('input', {type: 'checkbox', onchange: () => choose(rows[at],
          {exclude: ui.exclude.checked ? '' : null}, ui.note.value)}),
        note: e('input', {type: 'text', size: 22, placeholder: 'reason', onchange: () => ui.exclude.checked &&
          choose(rows[at], {exclude: ''}, ui.note.value)}),
        free: e('button', {onclick: () => choose(rows[at], Object.fromEntries(byHand.map((choice) => [choice, null])))},
          'As fitted (r)'),
        spring: e('input', {type: 'text', size: 9, placeholder: 'as in the file', onchange: () =>
          choose(rows[at], {'spring-constant': ui.spring.value.trim() || null}, ui.note.value)}),
        undo: e('button', {onclick: undo}, 'Undo override (u)'),
        refit: e('button', {hidden: true, class: 'main', onclick: () => groupFit(true)}, 'Fit the group again'),
        tip: e('input', {type: 'text', size: 34, onchange: () => View.edit({'indentation/tip': ui.tip.value})}),
      };
      host.append(e('div', {class: 'tools'}, label('Group', ui.group), label('Show', ui.filter),
        label('Sort by', ui.order), label('Tip', ui.tip), ui.count, ui.refit),
      e('div', {class: 'columns'}, e('div', {}, ui.map, ui.scale, ui.histogram, ui.list),
        e('div', {}, ui.name, ui.modulus, ui.verdict, e('div', {class: 'tools'}, label('Axis', ui.axis),
          e('button', {onclick: () => step(-1)}, '← previous'), e('button', {onclick: () => step(1)}, 'next →'),
          e('label', {}, ui.exclude, ' exclude (x)'), ui.note, label('Spring constant of the file', ui.spring), ui.free, ui.undo),
        ui.plot, ui.residual, e('h2', {}, 'Groups'), ui.cards, ui.depth)));
      const keys = {ArrowDown: () => step(1), ArrowUp: () => step(-1), x: exclude,
        r: () => ui.free.click(), u: undo};
      host.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.target.matches('input[type=text], select') ||
          !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
      });
    },
    async show(state) {
      if (writing === 0) readOverrides(state.overrides.text);
      ui.tip.value = View.get('indentation/tip') || '';
      const there = hasCase() ? ['bulk', 'track'].filter((name) => View.has('indentation/' + name)) :
        state.tables.filter((name) => name.startsWith('indentation/')).map((name) => name.slice(12));
      if (!there.includes(group)) group = there[0] || 'bulk';
      ui.group.replaceChildren(...options(there.map((name) => [name, name])));
      ui.group.value = group;
      if (there.length === 0) throw new Error('The case has no force curves (<indentation>).');
      if (!hasCase() || state.current && View.text() === state.case.text) {
        groups = await View.stored([wanted, ...there.map((name) => 'indentation/' + name)].join(' '));
        showCards();
        await showGroup();
      } else if (state.tables.includes('indentation/' + group) && rows.length === 0) {
        groups = View.tables(await View.call('table', {name: wanted}));
        showCards();
        await showGroup();
        await groupFit();
      } else {
        if (rows.length > 0 && rows[at]) await refit(rows[at]);
        await groupFit();
      }
    },
    resize: () => rows[at] && fit && draw(rows[at]),
    command: () => overrides.length === 0 ? [] :
      [`# with ${View.quote(View.state().overrides.name || 'overrides.tsv')}, which this page writes`],
  });
})();
