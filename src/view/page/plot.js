/* Plots as SVG with linear and logarithmic axes, and markers that can be dragged or moved by keys.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
const Plot = (() => {
  const NS = 'http://www.w3.org/2000/svg';
  const node = (name, attributes, parent, text) => {
    const made = document.createElementNS(NS, name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    if (text !== undefined) made.textContent = text;
    if (parent) parent.append(made);
    return made;
  };
  const {prefixOf, inUnit} = Shared;
  const range = (values, log) => {
    let low = Infinity, high = -Infinity;
    for (const v of values) {
      if (v === null || !Number.isFinite(v) || (log && v <= 0)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
    return low <= high ? [low, high] : log ? [1, 10] : [0, 1];
  };
  const superscript = (n) => String(n).replace(/[-0-9]/g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
  const logTicks = (low, high, size) => {
    const first = Math.ceil(low - 1e-9), last = Math.floor(high + 1e-9), ticks = [];
    const step = Math.max(1, Math.ceil((last - first) / 7));
    for (let k = first; k <= last; k += step) ticks.push([10 ** k,
      size === 1 ? '10' + superscript(k) : String(Number((10 ** k / size).toPrecision(3)))]);
    if (ticks.length < 2) { /* less than a decade: the multiples */
      ticks.length = 0;
      for (let k = Math.floor(low); k <= high; k++)
        for (const m of [1, 2, 3, 5, 7]) {
          const v = m * 10 ** k;
          if (Math.log10(v) >= low - 1e-9 && Math.log10(v) <= high + 1e-9)
            ticks.push([v, String(Number((v / size).toPrecision(3)))]);
        }
    }
    return ticks;
  };
  const linearTicks = (low, high, size) => {
    const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((m) => m * power >= raw * 0.999) * power, ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++)
      ticks.push([k * step, String(Number((k * step / size).toPrecision(6)))]);
    return ticks;
  };
  /* An axis: function from value to pixel and back, ticks and label. */
  const axis = (values, log, from, to, label, unit, fixed) => {
    let [low, high] = fixed || range(values, log);
    if (log) {
      low = Math.log10(low); high = Math.log10(high);
    }
    if (high - low < 1e-12 * Math.max(1e-30, Math.abs(high))) {
      const widen = log ? 0.5 : Math.abs(high) * 0.1 || 1;
      low -= widen; high += widen;
    } else if (!fixed) {
      const margin = (high - low) * 0.04;
      low -= margin; high += margin;
    }
    /* Powers of ten need no prefix, less than two decades do. */
    const [size, prefix] = !unit || unit === '1' || (log && high - low >= 2) ? [1, ''] :
      prefixOf(log ? 10 ** ((low + high) / 2) : Math.max(Math.abs(low), Math.abs(high)) / 2);
    const scale = (to - from) / (high - low);
    return {
      pixel: (v) => from + ((log ? Math.log10(v) : v) - low) * scale,
      value: (p) => log ? 10 ** (low + (p - from) / scale) : low + (p - from) / scale,
      valid: (v) => v !== null && Number.isFinite(v) && (!log || v > 0),
      ticks: log ? logTicks(low, high, size) : linearTicks(low, high, size),
      label: label + (unit && unit !== '1' ? ` (${prefix}${unit})` : ''),
      low: log ? 10 ** low : low, high: log ? 10 ** high : high,
      step: (v, n) => log ? v * 10 ** (n * (high - low) / 200) : v + n * (high - low) / 200,
    };
  };
  const path = (x, y, s) => {
    let text = '', pen = false;
    for (let i = 0; i < s.x.length; i++) {
      if (!x.valid(s.x[i]) || !y.valid(s.y[i])) {
        pen = false;
        continue;
      }
      text += (pen ? 'L' : 'M') + x.pixel(s.x[i]).toFixed(1) + ' ' + y.pixel(s.y[i]).toFixed(1);
      pen = true;
    }
    return text;
  };
  const points = (x, y, s, r) => {
    let text = '';
    for (let i = 0; i < s.x.length; i++)
      if (x.valid(s.x[i]) && y.valid(s.y[i]))
        text += `M${(x.pixel(s.x[i]) - r).toFixed(1)} ${y.pixel(s.y[i]).toFixed(1)}h${2 * r}`;
    return text;
  };
  const band = (x, y, s) => {
    const up = [], down = [];
    for (let i = 0; i < s.x.length; i++)
      if (x.valid(s.x[i]) && y.valid(s.low[i]) && y.valid(s.high[i])) {
        up.push(x.pixel(s.x[i]).toFixed(1) + ' ' + y.pixel(s.high[i]).toFixed(1));
        down.push(x.pixel(s.x[i]).toFixed(1) + ' ' + y.pixel(s.low[i]).toFixed(1));
      }
    return up.length > 1 ? 'M' + up.join('L') + 'L' + down.reverse().join('L') + 'Z' : '';
  };
  /* A line that is moved: `moved(value, done)` is called while it moves and when it is released. */
  const marker = (svg, m, x, top, bottom, row) => {
    const g = node('g', {class: 'marker', role: 'slider', tabindex: 0, 'aria-label': m.label,
      'aria-valuenow': m.x, 'aria-valuetext': inUnit(m.x, m.unit)}, svg);
    const line = node('line', {y1: top, y2: bottom, stroke: m.color || 'var(--fit)',
      'stroke-dasharray': m.moved ? '6 3' : ''}, g);
    const text = node('text', {y: top + 12 + 14 * row, class: 'label'}, g, m.label);
    const grip = node('rect', {y: top, width: 16, height: bottom - top, class: 'grip'}, g);
    let at = m.x;
    const place = (value) => {
      at = Math.max(x.low, Math.min(x.high, value));
      const p = x.pixel(at);
      line.setAttribute('x1', p);
      line.setAttribute('x2', p);
      const isLeft = m.side ? m.side === 'left' : p > (x.pixel(x.low) + x.pixel(x.high)) / 2;
      text.setAttribute('x', isLeft ? p - 5 : p + 5);
      text.setAttribute('text-anchor', isLeft ? 'end' : 'start');
      grip.setAttribute('x', p - 8);
    };
    place(m.x);
    if (!m.moved) {
      grip.remove();
      g.removeAttribute('tabindex');
      g.setAttribute('role', 'img');
      return;
    }
    grip.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      grip.setPointerCapture(event.pointerId);
      g.classList.add('held');
      const box = svg.getBoundingClientRect(), width = svg.viewBox.baseVal.width;
      const move = (e) => {
        if (e.type !== 'pointermove') g.classList.remove('held');
        place(x.value((e.clientX - box.left) * width / box.width));
        m.moved(at, e.type !== 'pointermove');
      };
      grip.onpointermove = move;
      grip.onpointerup = grip.onpointercancel = (e) => {
        grip.onpointermove = grip.onpointerup = grip.onpointercancel = null;
        move(e);
      };
    });
    g.addEventListener('keydown', (event) => {
      const n = {ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10}[event.key];
      if (n === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      place(x.step(at, event.shiftKey ? n / 10 : n));
      m.moved(at, true, g);
    });
    if (m.focused) requestAnimationFrame(() => g.focus());
  };
  /* Points that are moved along a logarithmic axis: `handle.moved(decades)` is called when they are
   * released. */
  const handle = (svg, s, x, y, parent) => {
    const g = node('g', {class: 'handle', role: 'slider', tabindex: 0, 'aria-label': s.handle.label,
      'aria-valuenow': s.handle.value, 'aria-valuetext': s.handle.value}, parent);
    node('path', {d: points(x, y, s, (s.width || 3) / 2), stroke: s.color, 'stroke-width': s.width || 3,
      fill: 'none'}, g);
    const grip = node('path', {class: 'grip', d: points(x, y, s, 9), fill: 'none'}, g);
    const decades = (pixels) => Math.log10(x.value(pixels) / x.value(0));
    grip.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      g.focus();
      grip.setPointerCapture(event.pointerId);
      g.classList.add('held');
      const box = svg.getBoundingClientRect(), width = svg.viewBox.baseVal.width;
      grip.onpointermove = grip.onpointerup = grip.onpointercancel = (e) => {
        const way = e.type === 'pointercancel' ? 0 : (e.clientX - event.clientX) * width / box.width;
        g.setAttribute('transform', `translate(${way} 0)`);
        if (e.type === 'pointermove') return;
        g.classList.remove('held');
        grip.onpointermove = grip.onpointerup = grip.onpointercancel = null;
        if (way !== 0) s.handle.moved(decades(way));
      };
    });
    g.addEventListener('keydown', (event) => {
      const n = {ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10}[event.key];
      if (n === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      s.handle.moved(n * (event.shiftKey ? 0.001 : 0.01));
    });
    if (s.handle.focused) requestAnimationFrame(() => g.focus());
  };
  const legend = (host, series) => {
    const shown = series.filter((s) => s.name);
    if (shown.length < 2) return;
    const p = document.createElement('p');
    p.className = 'legend';
    for (const s of shown) {
      const span = document.createElement('span'), i = document.createElement('i');
      i.style.background = s.color;
      span.append(i, s.name);
      p.append(span);
    }
    host.append(p);
  };
  /* Saves the plot as a file of its own, with its legend, on white and in the colours of the light page. */
  const light = (name) => document.styleSheets[0].cssRules[0].style.getPropertyValue(name).trim();
  const save = (host, o, millimetres) => {
    const copy = host.querySelector('svg').cloneNode(true), {width, height} = copy.viewBox.baseVal;
    const shown = o.series.filter((s) => s.name), rows = shown.length > 1 ? shown.length : 0;
    const all = height + 16 * rows;
    for (const grip of copy.querySelectorAll('.grip')) grip.remove();
    copy.setAttribute('xmlns', NS);
    copy.setAttribute('viewBox', `0 0 ${width} ${all}`);
    copy.setAttribute('width', millimetres + 'mm');
    copy.setAttribute('height', (millimetres * all / width).toFixed(2) + 'mm');
    for (let k = 0; k < rows; k++) {
      node('path', {d: `M62 ${height + 16 * k + 4}h22`, stroke: shown[k].color, 'stroke-width': 3}, copy);
      node('text', {x: 90, y: height + 16 * k + 8}, copy, shown[k].name);
    }
    copy.prepend(node('style', {}, null, 'text{font:12px Helvetica,Arial,sans-serif;fill:var(--ink)}' +
      '.axis{stroke:var(--soft);fill:none}.grid{stroke:var(--line);fill:none}.marker line{stroke-width:2}'),
    node('rect', {width, height: all, fill: '#fff'}));
    const text = new XMLSerializer().serializeToString(copy).replace(/var\((--\w+)\)/g, (_, name) => light(name));
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type: 'image/svg+xml'}));
    link.download = (o.title || o.y.label).toLowerCase().replace(/[^a-z0-9]+/g, '-') + `-${millimetres}mm.svg`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const saving = (host, o) => {
    const p = document.createElement('p');
    p.className = 'saving';
    for (const millimetres of [85, 170]) {
      const button = document.createElement('button');
      button.textContent = `Save, ${millimetres} mm`;
      button.setAttribute('aria-label', `Save ${o.title || o.y.label} as SVG, ${millimetres} mm wide`);
      button.onclick = () => save(host, o, millimetres);
      p.append(button);
    }
    host.append(p);
  };
  /* o: {title, x: {label, unit, log, range}, y: the same, height, series: [{name, x, y, color, kind:
   * 'line' | 'points' | 'band', low, high, dash, width, handle: {label, value, moved}}], markers: [{x, label, unit, moved, side: of the label}]} */
  const draw = (host, o) => {
    if (host.querySelector('.held')) return host.live; /* what is dragged stays until it is released */
    const width = Math.max(280, host.clientWidth || 600), height = o.height || 300;
    const left = 62, right = width - 12, top = 10, bottom = height - 42;
    const all = (key) => o.series.flatMap((s) => s.kind === 'band' && key === 'y' ?
      [...s.low, ...s.high] : s[key]);
    const x = axis(all('x').concat((o.markers || []).map((m) => m.x)), o.x.log, left, right, o.x.label,
      o.x.unit, o.x.range);
    const y = axis(all('y'), o.y.log, bottom, top, o.y.label, o.y.unit, o.y.range);
    const svg = node('svg', {viewBox: `0 0 ${width} ${height}`, role: o.markers || o.series.some((s) => s.handle) ? 'group' : 'img',
      'aria-label': o.title || `${o.y.label} against ${o.x.label}`});
    const clip = 'clip' + Math.random().toString(36).slice(2);
    node('rect', {x: left, y: top, width: right - left, height: bottom - top},
      node('clipPath', {id: clip}, svg));
    for (const [v, text] of x.ticks) {
      const p = x.pixel(v);
      node('path', {class: 'grid', d: `M${p} ${top}V${bottom}`}, svg);
      node('text', {x: p, y: bottom + 16, 'text-anchor': 'middle'}, svg, text);
    }
    for (const [v, text] of y.ticks) {
      const p = y.pixel(v);
      node('path', {class: 'grid', d: `M${left} ${p}H${right}`}, svg);
      node('text', {x: left - 6, y: p + 4, 'text-anchor': 'end'}, svg, text);
    }
    node('rect', {class: 'axis', x: left, y: top, width: right - left, height: bottom - top}, svg);
    const inside = node('g', {'clip-path': `url(#${clip})`}, svg);
    const fill = (all) => {
      inside.replaceChildren();
      for (const s of all) {
        if (s.handle) handle(svg, s, x, y, inside);
        else if (s.kind === 'band')
          node('path', {d: band(x, y, s), fill: s.color, 'fill-opacity': 0.18}, inside);
        else if (s.kind === 'points')
          node('path', {d: points(x, y, s, (s.width || 3) / 2), stroke: s.color,
            'stroke-width': s.width || 3, fill: 'none'}, inside);
        else
          node('path', {d: path(x, y, s), stroke: s.color, fill: 'none', 'stroke-width': s.width || 2,
            'stroke-dasharray': s.dash || ''}, inside);
      }
    };
    fill(o.series);
    node('text', {x: (left + right) / 2, y: height - 6, 'text-anchor': 'middle'}, svg, x.label);
    node('text', {transform: `translate(14 ${(top + bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle'},
      svg, y.label);
    (o.markers || []).forEach((m, k) => marker(svg, m, x, top, bottom, k));
    host.classList.add('plot');
    host.replaceChildren(svg);
    legend(host, o.series);
    saving(host, o);
    return host.live = {update: fill}; /* other series in the same axes */
  };
  const shades = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const shade = (share) => {
    const at = Math.max(0, Math.min(1, share)) * (shades.length - 1);
    const i = Math.min(shades.length - 2, Math.floor(at));
    return shades[i].map((c, k) => Math.round(c + (at - i) * (shades[i + 1][k] - c)));
  };
  /* Value with its standard error, both with the prefix of the value. */
  const withError = (value, error, unit) => {
    const [size, prefix] = !unit || unit === '1' ? [1, ''] : prefixOf(Math.abs(value));
    return [Number((value / size).toPrecision(4)), ...(error > 0 ? ['±', Number((error / size).toPrecision(2))] : []),
      unit === '1' ? '' : prefix + unit].join(' ').trim();
  };
  const colors = ['var(--s0)', 'var(--s1)', 'var(--s2)', 'var(--s3)', 'var(--s4)'];
  /* Cold to warm; the lightness of each hue differs from light and dark pages. */
  const lightness = [66, 31, 31, 28, 52];
  const heat = (share) => {
    const at = 4 * share, k = Math.min(3, Math.floor(at));
    return `hsl(${Math.round(240 - 240 * share)} 75% ${Math.round(lightness[k] + (at - k) * (lightness[k + 1] - lightness[k]))}%)`;
  };
  return {draw, inUnit, withError, range, shade, colors, heat};
})();
