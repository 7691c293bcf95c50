/* Panel Friction and layer: values of the case by sliders within their intervals, and what they do.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const {element} = View;
  let ui = null, found = {}, moving = null, measured = null;
  const sliders = [['sliding/pressure', 'Nominal pressure'], ['sliding/temperature', 'Temperature'],
    ['sliding/reference-velocity', 'Velocity'], ['sliding/shear-stress', 'Shear stress of the contact'],
    ['layer/critical-energy', 'Critical energy U_c'], ['layer/specific-wear-rate', 'Specific wear rate']];

  /* "5MPa +- 10%" as its number, unit and error, to set the ends of a slider. */
  const parts = (text) => {
    const m = /^([-+0-9.eE]+) *([^+±]*?) *(?:(?:\+-|±) *([-0-9.eE]+) *(%|.*))?$/.exec(text || '');
    if (!m || !Number.isFinite(Number(m[1]))) return null;
    const value = Number(m[1]);
    const error = m[3] === undefined ? null : m[4] === '%' ? Math.abs(value) * Number(m[3]) / 100 : Number(m[3]);
    return {value, unit: m[2], error, rest: m[3] === undefined ? '' : ` +- ${m[3]}${m[4]}`};
  };
  /* Ends: two standard errors, else a factor of 2, or 30 degrees for a temperature. The velocity goes
   * over the velocities of the case. */
  const ends = (p, path) => path.endsWith('velocity') ?
    p.unit === 'm/s' ? Plot.range(found.friction.column('velocity')) : [p.value / 10, p.value * 10] :
    p.error !== null ? [p.value - 2 * p.error, p.value + 2 * p.error] :
    /degC|K$/.test(p.unit) ? [p.value - 30, p.value + 30] : [p.value / 2, p.value * 2];
  /* "5MPa +- 10%" as it is read: 5 MPa ± 10 %. */
  const words = (text) => text.replace('+-', '±').replace('degC', '°C').replace(/(\d)(?=[a-zA-Zµ°%])(?!e[-+\d])/g, '$1 ')
    .replace(/\^-?\d/g, (power) => ({'^2': '²', '^3': '³'}[power] || power));
  const row = ([path, label]) => {
    const p = parts(View.get(path)), id = 'slider-' + path.replace('/', '-');
    if (!p || (path.endsWith('velocity') && !found.friction)) return [];
    const isLog = path.endsWith('velocity'), to = isLog ? Math.log10 : Number;
    const [low, high] = ends(parts(View.state().case.text && savedValue(path)) || p, path).map(to);
    const output = element('output', {for: id, style: 'font-weight:600'}, words(View.get(path)));
    const input = element('input', {type: 'range', class: 'wide', id, min: low, max: high, step: (high - low) / 100});
    input.value = to(p.value);
    const text = () => {
      const value = isLog ? 10 ** input.value : Number(input.value);
      return `${Number(value.toPrecision(4))}${p.unit}${p.rest}`;
    };
    input.addEventListener('input', () => {
      output.textContent = words(text());
      moving = id;
      compute({[path]: text()});
    });
    input.addEventListener('change', () => {
      moving = null;
      View.edit({[path]: text()});
    });
    return [element('label', {for: id, class: 'wide'}, label, ': ', output), input];
  };
  const savedValue = (path) => {
    const doc = new DOMParser().parseFromString(View.state().case.text, 'application/xml');
    const at = path.split('/').reduce((e, name) => e && [...e.children].find((c) => c.localName === name),
      doc.documentElement);
    return at ? at.textContent.trim() : null;
  };
  const names = () => View.has('layer') ? 'friction contact_area layer' : 'friction contact_area';
  /* While a slider moves, the measured modulus ratio is stated in place of the curves, which do not
   * depend on the sliders. The values are the same. */
  const quick = (values) => {
    const ratio = found.friction && found.friction.keys.layer_modulus_ratio;
    return ratio && View.has('layer') && !View.has('layer/modulus-ratio') && !View.has('layer/material') ?
      View.changed({...values, 'layer/modulus-ratio': String(ratio.value)}, ['indentation', 'compare']) :
      View.changed(values);
  };
  const compute = View.guard(async (values) => {
    const made = values ? await View.preview(names(), 0, quick(values)) : await View.results(names());
    if (made === null) return;
    if (!made.friction) throw new Error(made.failures && made.failures.n ? made.failures.rows.map((r) =>
      `${r.file}: ${r.message}`).join('\n') : 'Friction needs <dma>, <roughness> and <sliding>.');
    found = made;
    draw();
  });
  const errors = View.guard(async () => {
    ui.full.disabled = true;
    const made = await View.preview(names(), 200);
    ui.full.disabled = false;
    if (made && made.friction) {
      found = made;
      draw();
    }
  });
  const card = (name, value) => value && value.value !== null ? element('div', {class: 'card'}, element('b', {}, name),
    element('p', {class: 'big'}, Plot.inUnit(value.value, value.unit, 3)),
    element('p', {class: 'soft'}, value.standard_error ? `± ${Plot.inUnit(value.standard_error, value.unit, 2)} (standard error)` :
      'without its error')) : null;
  const draw = () => {
    const t = found.friction, x = t.column('velocity'), with_layer = t.column('friction_with_layer');
    const series = [];
    const around = (name, color, label) => {
      const y = t.column(name), e = t.column(name + '_standard_error');
      if (e && e.some((v) => v > 0)) series.push({kind: 'band', x, y: [], color,
        low: y.map((v, i) => v - 2 * e[i]), high: y.map((v, i) => v + 2 * e[i])});
      series.push({name: label, x, y, color});
    };
    around('friction', 'var(--s0)', 'without a layer');
    if (with_layer && with_layer.some((v) => v !== null)) around('friction_with_layer', 'var(--s1)', 'with the layer');
    series.push({name: 'hysteresis', x, y: t.column('hysteresis'), color: 'var(--s4)', dash: '6 3'});
    if (measured) series.push({name: 'measured, last run', x: measured.column('velocity'),
      y: measured.column('friction_coefficient'), kind: 'points', width: 7, color: 'var(--fit)'});
    const reference = t.keys.reference_velocity;
    Plot.draw(ui.plot, {title: 'Friction against velocity', height: 340, x: {label: 'velocity (m/s)', log: true},
      y: {label: 'friction coefficient'}, series, markers: reference ? [{x: reference.value, label: 'reference', unit: 'm/s',
        color: 'var(--s2)'}] : []});
    const a = found.contact_area;
    if (a) {
      const velocities = [...new Set(a.rows.map((r) => r.velocity))];
      Plot.draw(ui.area, {title: 'Contact area against magnification', height: 240,
        x: {label: 'magnification', log: true}, y: {label: 'real over nominal area', log: true},
        series: velocities.map((v, k) => {
          const rows = a.rows.filter((r) => r.velocity === v);
          return {name: Plot.inUnit(v, 'm/s'), x: rows.map((r) => r.magnification),
            y: rows.map((r) => r.area_ratio), color: Plot.colors[k % Plot.colors.length]};
        })});
    }
    const l = found.layer;
    ui.course.hidden = !l || l.n === 0;
    if (l && l.n > 0) Plot.draw(ui.course, {title: 'Thickness against time', height: 240, x: {label: 'time (s)', log: true},
      y: {label: 'thickness', unit: 'm'}, series: [{x: l.column('time'), y: l.column('thickness'), color: 'var(--s1)'}]});
    const k = t.keys;
    ui.cards.replaceChildren(...[card('Friction without a layer', k.friction_at_reference),
      card('Friction with the layer', k.friction_with_layer_at_reference),
      card('Contact area, real over nominal', k.area_ratio_at_reference),
      card('Thickness of the layer', l && l.keys.balance_thickness)].filter(Boolean));
    ui.time.textContent = found.time ? `computed in ${(found.time * 1000).toFixed(0)} ms` : 'of the last run';
    const root = document.documentElement.dataset;
    root.mu = k.friction_at_reference ? k.friction_at_reference.value : '';
    root.thickness = l && l.keys.balance_thickness ? l.keys.balance_thickness.value : '';
    root.previewtime = found.time || '';
  };
  View.add({
    id: 'sliding', title: 'Friction and layer',
    build(host) {
      ui = {form: element('div', {class: 'form card'}), plot: element('div', {}), area: element('div', {}),
        course: element('div', {}), cards: element('div', {class: 'halves'}), time: element('p', {class: 'soft', role: 'status'}),
        full: element('button', {onclick: errors}, 'Standard errors by 200 draws')};
      host.append(element('div', {class: 'columns'}, element('div', {}, element('h2', {}, 'Values of the case'), ui.form,
        ui.full, ui.time, ui.cards), element('div', {}, ui.plot, element('div', {class: 'halves'}, ui.area, ui.course))));
    },
    async show() {
      if (!View.has('sliding')) throw new Error('The case has no sliding contact (<sliding>).');
      const tables = View.state().tables;
      measured = tables.includes('record') ? (await View.stored('record')).record : null;
      await compute();
      if (moving === null && !ui.form.contains(document.activeElement))
        ui.form.replaceChildren(...sliders.flatMap(row));
    },
    resize: () => found.friction && draw(),
    command: () => ['# values while a slider moves: without draws, as weartrack run --replicates 0'],
  });
})();
