/* Panel Master curve: isotherms in colour, excluded or shifted by hand, reference temperature, options of
 * the shift.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const {element} = View;
  let ui = null, found = {};
  const celsius = (kelvin) => Number((kelvin - 273.15).toFixed(2));
  const tables = 'shift_factors master_curve prony';

  /* Isotherms by block, with their measured temperature. */
  const isotherms = () => {
    const t = found.master_curve, made = new Map();
    for (const row of t.rows) {
      const key = row.temperature;
      if (!made.has(key)) made.set(key, []);
      made.get(key).push(row);
    }
    return [...made].sort((a, b) => a[0] - b[0]);
  };
  /* An isotherm is excluded by a range of temperatures around its mean. */
  const rangeOf = (temperature) => `temperature:${(temperature - 273.15 - 0.2).toFixed(1)}degC..` +
    `${(temperature - 273.15 + 0.2).toFixed(1)}degC`;
  const toggle = (text) => View.editDocument((doc, child, insert, remove) => {
    const section = child(doc.documentElement, 'dma');
    const there = [...section.children].find((c) => c.localName === 'exclude' && c.textContent.trim() === text);
    if (there) {
      remove(there);
      return;
    }
    const made = doc.createElementNS(section.namespaceURI, 'exclude');
    made.textContent = text;
    insert(section, made);
  });
  /* A shift by hand is against the isotherm nearest to the reference temperature, which has none. */
  const shiftOf = (temperature) => found.shift_factors.rows.find((row) => row.temperature === temperature);
  const base = () => {
    const t = found.shift_factors, reference = t.keys.reference_temperature.value;
    return t.rows.find((row) => row.origin === 'reference') || t.rows.reduce((a, b) =>
      Math.abs(b.temperature - reference) < Math.abs(a.temperature - reference) ? b : a);
  };
  let held = null; /* temperature of the isotherm that was moved last */
  const shift = (temperature, decades) => {
    const at = `${celsius(temperature)}degC=`;
    held = temperature;
    View.editDocument((doc, child, insert, remove) => {
      const section = child(doc.documentElement, 'dma');
      const there = [...section.children].find((c) => c.localName === 'shift' && c.textContent.trim().startsWith(at));
      if (decades === null) {
        if (there) remove(there);
        return;
      }
      const old = there ? Number(there.textContent.trim().slice(at.length)) :
        shiftOf(temperature).log_a - base().log_a;
      const made = there || doc.createElementNS(section.namespaceURI, 'shift');
      made.textContent = at + Number((old + decades).toFixed(4));
      if (!there) insert(section, made);
    });
  };
  const handleOf = (temperature) => {
    const row = shiftOf(temperature);
    if (!row || row === base() || row.log_a === null) return null;
    return {label: `Isotherm of ${celsius(temperature)} °C, log a_T`, value: row.log_a.toFixed(4),
      focused: held === temperature && (document.activeElement === document.body ||
        ui.plot.contains(document.activeElement)),
      moved: (decades) => shift(temperature, decades)};
  };
  const excluded = () => View.all('dma/exclude');
  /* Column, fitted column, unit and label; M is E or G. */
  const quantities = {storage: ['storage_modulus', 'fitted_storage', 'Pa', "M'"],
    loss: ['loss_modulus', 'fitted_loss', 'Pa', "M''"],
    loss_factor: ['loss_factor', 'fitted_loss_factor', '1', 'tan delta'],
    own_storage: ['own_storage', null, 'Pa', "M' as measured"]};
  const draw = () => {
    const all = isotherms(), n = Math.max(1, all.length - 1);
    const [name, fitted, unit, general] = quantities[ui.quantity.value];
    const label = general.replace('M', found.master_curve.keys.deformation === 'shear' ? 'G' : 'E');
    const own = name.startsWith('own_');
    const series = all.map(([temperature, rows], k) => ({name: null, color: Plot.heat(k / n), kind: 'points',
      width: 5, x: rows.map((r) => own ? r.own_frequency : r.angular_frequency), y: rows.map((r) => r[name]),
      handle: own ? null : handleOf(temperature)}));
    if (fitted) {
      const rows = [...found.master_curve.rows].sort((a, b) => a.angular_frequency - b.angular_frequency);
      const x = rows.map((r) => r.angular_frequency);
      series.unshift({kind: 'band', color: 'var(--s4)', x, low: rows.map((r) => r[fitted + '_low']),
        high: rows.map((r) => r[fitted + '_high']), y: []});
      series.push({x, y: rows.map((r) => r[fitted]), color: 'var(--ink)', width: 1});
    }
    Plot.draw(ui.plot, {title: `Master curve, ${label}`, height: 360,
      x: {label: own ? 'angular frequency as measured (rad/s)' : 'reduced angular frequency (rad/s)', log: true},
      y: {label, unit, log: true}, series});
    const s = found.shift_factors, x = s.column('temperature').map(celsius);
    const byHand = s.rows.filter((row) => row.origin === 'by hand');
    Plot.draw(ui.shifts, {title: 'Shift factors', height: 240, x: {label: 'temperature (°C)'},
      y: {label: 'log a_T'}, series: [
        {name: 'shift factors', x, y: s.column('log_a'), kind: 'points', width: 6, color: 'var(--s0)'},
        ...(byHand.length === 0 ? [] : [{name: 'by hand', x: byHand.map((r) => celsius(r.temperature)),
          y: byHand.map((r) => r.log_a), kind: 'points', width: 9, color: 'var(--fit)'}]),
        {name: s.keys.law || 'law', x, y: s.column('law_log_a'), color: 'var(--s1)'}]});
    Plot.draw(ui.vertical, {title: 'Vertical shifts', height: 240, x: {label: 'temperature (°C)'},
      y: {label: 'log b_T'}, series: [
        {name: 'vertical shift', x, y: s.column('log_b'), kind: 'points', width: 6, color: 'var(--s0)'},
        {name: 'physical', x, y: s.column('log_b_physical'), color: 'var(--s1)'}]});
    const p = found.prony;
    const most = p ? Plot.range(p.column('modulus'))[1] : 1;
    /* terms below a billionth of the largest change nothing */
    if (p) Plot.draw(ui.prony, {title: 'Prony series', height: 240, x: {label: 'relaxation time (s)', log: true},
      y: {label: 'modulus (Pa)', log: true}, series: [{x: p.column('relaxation_time'),
        y: p.column('modulus').map((v) => v > 1e-9 * most ? v : null),
        kind: 'points', width: 5, color: 'var(--s0)'}]});
  };
  const describe = () => {
    const keys = found.shift_factors.keys;
    const number = (name, digits) => keys[name] ? Plot.inUnit(keys[name].value, keys[name].unit, digits) : '';
    ui.verdict.textContent = keys.superposition || '';
    ui.law.textContent = [keys.law, keys.wlf_c1 && `C1 = ${number('wlf_c1', 4)}, C2 = ${number('wlf_c2', 4)}`,
      keys.law_rms && `rms of the law ${number('law_rms', 2)} decade`,
      `at ${celsius(keys.reference_temperature.value)} °C`,
      found.time && `computed in ${(found.time * 1000).toFixed(0)} ms`].filter(Boolean).join('; ');
    const all = isotherms(), n = Math.max(1, all.length - 1);
    ui.isotherms.replaceChildren(...all.map(([temperature, rows], k) => {
      const i = element('i', {});
      i.style.cssText = `display:inline-block;width:.8rem;height:.8rem;margin:0 .3rem;background:${Plot.heat(k / n)}`;
      return element('label', {}, element('input', {type: 'checkbox', checked: true,
        onchange: () => toggle(rangeOf(temperature))}), i, `${celsius(temperature)} °C, ${rows.length} points`,
      (shiftOf(temperature) || {}).origin !== 'by hand' ? null : element('button', {
        'aria-label': `Shift of ${celsius(temperature)} °C as fitted`,
        onclick: () => shift(temperature, null)}, 'by hand: as fitted'));
    }), ...excluded().map((text) => element('label', {}, element('input', {type: 'checkbox',
      onchange: () => toggle(text)}), ` ${text}, excluded`)));
    const [low, high] = Plot.range(all.map(([t]) => celsius(t)));
    ui.reference.min = Math.floor(low);
    ui.reference.max = Math.ceil(high);
    ui.reference.value = celsius(keys.reference_temperature.value);
    ui.shown.textContent = `${ui.reference.value} °C`;
    document.documentElement.dataset.reference = ui.reference.value;
    document.documentElement.dataset.isotherms = all.length;
    document.documentElement.dataset.shifts = found.shift_factors.rows.map((r) => `${r.origin} ${r.log_a}`).join(', ');
  };
  const compute = async (source) => {
    const made = source === undefined ? await View.results(tables) : await View.preview(tables, 0, source);
    if (made === null) return;
    if (!made.master_curve) throw new Error(made.failures && made.failures.n > 0 ?
      made.failures.rows.map((row) => `${row.file}: ${row.message}`).join('\n') :
      'The case has no sweeps (<dma> with <files>).');
    found = made;
    draw();
  };
  /* Ends up in the case when the slider is released. */
  const move = View.guard(async (done) => {
    const values = {'dma/reference-temperature': `${ui.reference.value}degC`};
    ui.shown.textContent = `${ui.reference.value} °C`;
    if (done) View.edit(values);
    else await compute(View.changed(values));
  });
  const choices = {'dma/vertical-shift': ['Vertical shift', ['', 'none', 'physical', 'free', 'tied']],
    'dma/shift-by': ['Shift by', ['', 'moduli', 'storage', 'loss', 'loss-factor']],
    'dma/prony-terms': ['Prony terms', ['', '3', '5', '8', '10', '15', '20']]};

  /* The same fit without the case, where its files need no words of their own. */
  const masterCommand = () => {
    const section = new DOMParser().parseFromString(View.text(), 'application/xml').querySelector('dma');
    const parts = section ? [...section.children] : [], files = parts.filter((c) => c.localName === 'files');
    if (!parts.some((c) => c.localName === 'shift') || files.some((c) => c.attributes.length > 0)) return [];
    const options = ['exclude', 'shift-law', 'shift', 'reference-temperature', 'reference-at', 'vertical-shift',
      'expansion', 'sample-temperature-error', 'terms-per-decade', 'shift-by'];
    return [['weartrack master', ...parts.filter((c) => options.includes(c.localName)).map((c) =>
      `--${c.localName} ${View.quote(c.textContent.trim())}`), ...(View.get('dma/liquid') === 'yes' ? ['--liquid'] : []),
    ...files.flatMap((c) => c.textContent.trim().split(/\s+/)).map(View.quote), '-o master.h5'].join(' ')];
  };

  View.add({
    id: 'master', title: 'Master curve',
    build(host) {
      const options = (values) => values.map((v) => element('option', {value: v}, v === '' ? 'default' : v));
      ui = {selects: {}, plot: element('div', {}), shifts: element('div', {}), vertical: element('div', {}),
        prony: element('div', {}), verdict: element('p', {class: 'card'}), law: element('p', {class: 'soft'}),
        isotherms: element('div', {style: 'display:grid;gap:.15rem'}), shown: element('output', {}),
        quantity: element('select', {onchange: draw}, ...[['storage', 'storage modulus'],
          ['loss', 'loss modulus'], ['loss_factor', 'tan delta'], ['own_storage', 'isotherms as measured']]
          .map(([value, text]) => element('option', {value}, text))),
        reference: element('input', {type: 'range', step: 1, 'aria-label': 'Reference temperature',
          oninput: () => move(false), onchange: () => move(true)})};
      for (const path in choices) {
        const [label, values] = choices[path];
        const select = element('select', {onchange: () => View.edit({[path]: select.value || null})},
          ...options(values));
        ui.selects[path] = element('label', {}, label + ' ', select);
        ui.selects[path].select = select;
      }
      host.append(element('div', {class: 'tools'}, element('label', {}, 'Show ', ui.quantity),
        ...Object.values(ui.selects), element('label', {}, 'Reference temperature ', ui.reference), ui.shown),
      ui.verdict, ui.law, element('div', {class: 'columns'},
        element('div', {}, element('h2', {}, 'Isotherms'), ui.isotherms,
          element('p', {class: 'soft'}, 'Drag an isotherm in the plot, or move it with the arrow keys, to shift it by hand.')), ui.plot),
      element('div', {class: 'halves'}, element('div', {}, element('h2', {}, 'Shift factors'), ui.shifts),
        element('div', {}, element('h2', {}, 'Vertical shifts'), ui.vertical),
        element('div', {}, element('h2', {}, 'Prony series'), ui.prony)));
    },
    async show() {
      if (!View.has('dma/files')) throw new Error('The case has no sweeps (<dma> with <files>).');
      for (const path in ui.selects) ui.selects[path].select.value = View.get(path) || '';
      await compute();
      describe();
    },
    resize: () => found.master_curve && draw(),
    command: () => [...masterCommand(), `weartrack table ${View.quote(View.state().resultName || 'case.h5')} shift_factors`],
  });
})();
