/* Panel Surface: height map, power spectrum with its reliable range, cut-off by dragging.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const {element} = View;
  let ui = null, found = {};
  const tables = 'power_spectrum roughness surfaces';
  const isMeasured = () => View.has('roughness/files');

  /* The server sends a map as points on a grid; the first scan of the result is shown. */
  const drawMap = (map) => {
    const first = map.rows.length ? map.rows[0].scan : 0, rows = map.rows.filter((r) => r.scan === first);
    const xs = [...new Set(rows.map((r) => r.x))].sort((a, b) => a - b);
    const ys = [...new Set(rows.map((r) => r.y))].sort((a, b) => a - b);
    const at = new Map(xs.map((v, k) => [v, k])), line = new Map(ys.map((v, k) => [v, ys.length - 1 - k]));
    const [low, high] = Plot.range(rows.map((r) => r.height));
    const canvas = ui.map, context = canvas.getContext('2d');
    canvas.width = xs.length;
    canvas.height = ys.length;
    const image = context.createImageData(xs.length, ys.length);
    for (const r of rows) {
      if (r.height === null) continue;
      const [red, green, blue] = Plot.shade((r.height - low) / (high - low || 1));
      image.data.set([red, green, blue, 255], 4 * (line.get(r.y) * xs.length + at.get(r.x)));
    }
    context.putImageData(image, 0, 0);
    ui.scale.textContent = `scan ${first}: ${Plot.inUnit(xs[xs.length - 1] - xs[0], 'm')} by ` +
      `${Plot.inUnit(ys[ys.length - 1] - ys[0], 'm')}; heights ${Plot.inUnit(low, 'm')} (dark) to ` +
      `${Plot.inUnit(high, 'm')} (light)`;
  };
  const wavenumber = (value) => `${Number(value.toPrecision(4))}rad/m`;
  const cut = (element, name) => View.guard(async (value, done) => {
    const values = {[element]: wavenumber(value)};
    ui.cut.textContent = `${name} = ${wavenumber(value)}`;
    await friction(View.changed(values));
    if (done) View.edit(values);
  });
  const friction = async (source) => {
    if (!View.has('sliding')) return;
    const made = source === undefined ? await View.results('friction') : await View.preview('friction', 0, source);
    if (made === null || !made.friction) return;
    const at = made.friction.keys.friction_at_reference, area = made.friction.keys.area_ratio_at_reference;
    if (!at) return;
    ui.mu.textContent = `Friction coefficient ${Plot.inUnit(at.value, '1', 4)} at the reference velocity, contact area ` +
      `${Plot.inUnit(area.value, '1', 4)} of the nominal one`;
    document.documentElement.dataset.mu = at.value;
  };
  const draw = () => {
    const measured = found.power_spectrum, law = found.roughness;
    const series = [], markers = [];
    if (measured) {
      const x = measured.column('wavenumber');
      series.push({kind: 'band', x, y: [], low: measured.column('density_low'), high: measured.column('density_high'),
        color: 'var(--s0)'}, {name: 'measured', x, y: measured.column('density'), kind: 'points', width: 5,
        color: 'var(--s0)'}, {name: 'self-affine law', x, y: measured.column('self_affine'), color: 'var(--s1)',
        dash: '6 3'});
      for (const [key, label] of [['reliable_from', 'reliable from'], ['reliable_to', 'reliable to']])
        if (measured.keys[key]) markers.push({x: measured.keys[key].value, label, unit: 'rad/m',
          color: 'var(--s2)'});
    }
    if (law) {
      const x = law.column('wavenumber');
      series.push({name: 'used for friction', x, y: law.column('density'), color: 'var(--ink)', width: 1.5});
      for (const [at, element, label] of [...(isMeasured() || !View.has('roughness/self-affine') ? [] :
        [[Math.min(...x), 'roughness/self-affine/q0', 'cut-off q0']]),
      [Math.max(...x), isMeasured() ? 'roughness/end' : 'roughness/self-affine/q1', 'cut-off q1']])
        markers.push({x: at, label, unit: 'rad/m', moved: cut(element, label)});
    }
    Plot.draw(ui.plot, {title: 'Power spectrum', height: 380, x: {label: 'wavenumber (rad/m)', log: true},
      y: {label: 'power spectrum C (m⁴)', log: true}, series, markers});
    const keys = (measured || law).keys;
    ui.values.textContent = [['rms_height', 'rms height'], ['rms_slope', 'rms slope'], ['hurst', 'Hurst exponent']]
      .filter(([k]) => keys[k]).map(([k, name]) =>
        `${name} ${Plot.withError(keys[k].value, keys[k].standard_error, keys[k].unit)}`).join('; ');
    document.documentElement.dataset.slope = keys.rms_slope ? keys.rms_slope.value : '';
  };
  const choices = {'roughness/scan-lines': ['Line correction', ['', 'mend', 'keep']],
    'roughness/form': ['Form', ['', 'mean', 'plane', 'quadratic']],
    'roughness/window': ['Window', ['', 'hann', 'welch', 'none']]};

  View.add({
    id: 'surface', title: 'Surface',
    build(host) {
      ui = {selects: {}, map: element('canvas', {role: 'img', 'aria-label': 'Height map'}), scale: element('p', {class: 'soft'}),
        plot: element('div', {}), values: element('p', {class: 'card'}), cut: element('p', {role: 'status'}),
        mu: element('p', {class: 'big', role: 'status'}), table: element('div', {}), choice: element('div', {class: 'tools'})};
      for (const path in choices) {
        const [label, values] = choices[path];
        const select = element('select', {onchange: () => View.edit({[path]: select.value || null})},
          ...values.map((v) => element('option', {value: v}, {'': 'default', mend: 'on', keep: 'off'}[v] || v)));
        ui.selects[path] = select;
        ui.choice.append(element('label', {}, label + ' ', select));
      }
      host.append(ui.choice, ui.values, ui.mu, ui.cut, element('div', {class: 'columns'},
        element('div', {}, ui.map, ui.scale), ui.plot), ui.table);
    },
    async show() {
      if (!View.has('roughness')) throw new Error('The case has no counter surface (<roughness>).');
      const measured = isMeasured();
      ui.choice.hidden = ui.map.hidden = !measured;
      for (const path in ui.selects) ui.selects[path].value = View.get(path) || '';
      found = await View.results(measured ? tables + ' height_map' : 'roughness') || found;
      if (!found.roughness) throw new Error(found.failures && found.failures.n ? found.failures.rows.map((r) =>
        r.message).join('\n') : 'There is no spectrum.');
      draw();
      if (found.height_map) drawMap(found.height_map);
      ui.table.replaceChildren(...(found.surfaces ? [element('h2', {}, 'Scans'), View.show(found.surfaces,
        ['file', 'rms_height', 'rms_slope', 'reliable_from', 'reliable_to', 'reliable_ends_by'])] : []));
      await friction();
    },
    resize: () => found.roughness && draw(),
  });
})();
