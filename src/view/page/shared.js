/* Shared by the page for browsing curves and by the page of weartrack view: numbers with units, and the
 * file of manual overrides. SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
const Shared = (() => {
  const prefixes = [[1e12, 'T'], [1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'],
    [1e-9, 'n'], [1e-12, 'p'], [1e-15, 'f']];
  const prefixOf = (value) => value === 0 ? [1, ''] :
    prefixes.find(([size]) => Math.abs(value) >= size * 0.9995) || prefixes[prefixes.length - 1];
  /* A number as a person reads it, rounded for the screen. */
  const inUnit = (value, unit, digits = 3) => {
    if (value === null || value === undefined || Number.isNaN(value)) return 'unknown';
    if (unit === '1' || unit === '') return String(Number(value.toPrecision(digits)));
    const [size, prefix] = prefixOf(value);
    return Number((value / size).toPrecision(digits)) + ' ' + prefix + unit;
  };
  /* A length with its unit in metres, NaN if it is none. */
  const lengthOf = (text) => {
    const parts = /^([-+0-9.eE]+) *(m|mm|um|µm|nm|pm)$/.exec(text);
    const sizes = {m: 1, mm: 1e-3, um: 1e-6, 'µm': 1e-6, nm: 1e-9, pm: 1e-12};
    return parts === null ? NaN : Number(parts[1]) * sizes[parts[2]];
  };
  /* A cell of a text stream, and its text. */
  const escapeCell = (text) => {
    if (text === '') return '-';
    const made = text.replace(/[\\\t\n\r\x00-\x1f\x7f]/g, (c) =>
      ({'\\': '\\\\', '\t': '\\t', '\n': '\\n', '\r': '\\r'}[c] ||
        '\\x' + c.charCodeAt(0).toString(16).toUpperCase().padStart(2, '0')));
    return made === '-' || made.startsWith('#') ? '\\' + made : made;
  };
  const unescapeCell = (cell) => cell === '-' ? '' : cell.replace(/\\(x[0-9A-Fa-f]{2}|.)/g, (_, c) =>
    ({n: '\n', t: '\t', r: '\r'}[c] || (c.length > 1 ? String.fromCharCode(parseInt(c.slice(1), 16)) : c)));
  /* Rows of group, file, curve, choice, value and note, all text. */
  const overridesText = (rows) => '## table: choices\n' +
    '# group[text]\tfile[text]\tcurve[1]\tchoice[text]\tvalue[text]\tnote[text]\n' +
    rows.map((row) => row.map(escapeCell).join('\t') + '\n').join('') + '##\n';
  return {prefixOf, inUnit, lengthOf, unescapeCell, overridesText};
})();
