/* The page: talks to the server, edits the text of the case, and shows the panels. It computes no
 * number of a result. SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
const View = (() => {
  const $ = (id) => document.getElementById(id);
  const root = document.documentElement;
  const panels = [];
  let state = null, current = null;

  const fail = (message) => {
    root.dataset.error = message;
    $('fault').textContent = message;
    $('fault').hidden = false;
  };
  addEventListener('error', (event) => fail('This page has failed: ' + event.message));
  addEventListener('unhandledrejection', (event) => fail(event.reason.message || String(event.reason)));

  /* ---- server -------------------------------------------------------------------------------- */

  const posts = new Set(['check', 'preview', 'curve', 'save', 'new-case', 'run', 'page']);
  const address = (action, parameters) => {
    const query = new URLSearchParams(parameters || {}).toString();
    return action + (query === '' ? '' : '?' + query);
  };
  const call = async (action, parameters, body) => {
    let reply = null;
    try {
      reply = await fetch(address(action, parameters), posts.has(action) ?
        {method: 'POST', body: body === undefined ? '' : body} : {});
    } catch (problem) {
      throw new Error('The server does not answer: weartrack view has ended. Start it again.');
    }
    const data = await reply.json().catch(() => ({error: `The server refused: ${reply.status}`}));
    if (data.error) throw new Error(data.error);
    if (!reply.ok) throw new Error(`The server refused: ${reply.status}`);
    return data;
  };
  /* Calls of one kind follow one another; of those that wait only the last is made. */
  const latest = (work) => {
    let running = false, waiting = null;
    const next = async () => {
      running = true;
      while (waiting) {
        const {values, resolve, reject} = waiting;
        waiting = null;
        try {
          resolve(await work(...values));
        } catch (problem) {
          reject(problem);
        }
      }
      running = false;
    };
    return (...values) => new Promise((resolve, reject) => {
      if (waiting) waiting.resolve(null);
      waiting = {values, resolve, reject};
      if (!running) next();
    });
  };

  /* ---- tables -------------------------------------------------------------------------------- */

  /* A table of the server with its columns as arrays. */
  const table = (raw) => {
    if (!raw) return null;
    const names = raw.columns.map((c) => c.name);
    const made = {name: raw.table, title: raw.title, keys: raw.keys, names, units: {}, labels: {},
      rows: raw.rows, n: raw.rows.length};
    raw.columns.forEach((c, k) => {
      made.units[c.name] = c.unit;
      made.labels[c.name] = c.long_name;
      made[':' + c.name] = k;
    });
    made.column = (name) => {
      const k = names.indexOf(name);
      return k < 0 ? null : raw.rows.map((row) => Array.isArray(row) ? row[k] : row[name]);
    };
    return made;
  };
  const tables = (reply) => {
    const found = {time: reply.time};
    for (const raw of reply.tables) found[raw.table] = table(raw);
    return found;
  };
  const element = (name, attributes, ...children) => {
    const made = document.createElement(name);
    for (const key in attributes || {}) {
      if (key.startsWith('on')) made.addEventListener(key.slice(2), attributes[key]);
      else if (key === 'class') made.className = attributes[key];
      else if (attributes[key] === true) made.setAttribute(key, '');
      else if (attributes[key] !== false && attributes[key] !== null)
        made.setAttribute(key, attributes[key]);
    }
    made.append(...children.filter((c) => c !== null && c !== undefined));
    return made;
  };
  const show = (t, names) => {
    const shown = (names || t.names).filter((name) => t.names.includes(name));
    const isNumber = (name) => t.units[name] !== undefined && t.units[name] !== '' &&
      t.units[name] !== null;
    return element('div', {class: 'scroll', tabindex: 0}, element('table', {},
      element('thead', {}, element('tr', {}, ...shown.map((name) =>
        element('th', {scope: 'col', class: isNumber(name) ? 'number' : ''},
          (t.labels[name] || name))))),
      element('tbody', {}, ...t.rows.map((row) => element('tr', {}, ...shown.map((name) => {
        const value = row[name];
        return typeof value === 'number' ?
          element('td', {class: 'number'}, Plot.inUnit(value, t.units[name] || '1', 4)) :
          element('td', {}, value === null ? '' : String(value));
      }))))));
  };

  /* ---- the case ------------------------------------------------------------------------------ */

  /* Sections whose elements have an order in the schema. */
  const orders = {
    dma: ['poisson-ratio', 'reference-temperature', 'moduli', 'extrapolation', 'exclude', 'shift-law', 'shift',
      'reference-at', 'vertical-shift', 'expansion', 'sample-temperature-error',
      'terms-per-decade', 'liquid', 'shift-by', 'at',
      'peak-points', 'prony-terms', 'prony-error', 'prony-long-term', 'files'],
    roughness: ['form', 'window', 'scan-lines', 'points-per-wave', 'tip-radius', 'end', 'end-slope',
      'files'],
  };
  let text = '', saved = '';
  const before = [], after = [];
  const parse = (source) => {
    const made = new DOMParser().parseFromString(source, 'application/xml');
    return made.querySelector('parsererror') || !made.documentElement ? null : made;
  };
  const child = (parent, name) => [...parent.children].find((c) => c.localName === name) || null;
  const find = (doc, path) => path.split('/').reduce((at, name) => at && child(at, name),
    doc && doc.documentElement);
  const get = (path) => {
    const at = find(parse(text), path);
    return at ? at.textContent.trim() : null;
  };
  /* Texts of all elements of a name in a section. */
  const texts = (path) => {
    const [section, name] = path.split('/'), at = find(parse(text), section);
    return at ? [...at.children].filter((c) => c.localName === name).map((c) => c.textContent.trim()) : [];
  };
  const has = (path) => find(parse(text), path) !== null;
  const insert = (section, made) => {
    const order = orders[section.localName] || [];
    const rank = order.indexOf(made.localName);
    const next = rank < 0 ? null :
      [...section.children].find((c) => order.indexOf(c.localName) > rank) || null;
    const doc = section.ownerDocument, depth = '\n' + '  '.repeat(2);
    if (next) {
      section.insertBefore(made, next);
      section.insertBefore(doc.createTextNode(depth), next);
    } else {
      section.append(doc.createTextNode('  '), made, doc.createTextNode('\n  '));
    }
  };
  const remove = (at) => {
    const space = at.previousSibling;
    if (space && space.nodeType === Node.TEXT_NODE && space.data.trim() === '') space.remove();
    at.remove();
  };
  /* Sets the text of an element, creates it, or removes it for null. */
  const put = (doc, path, value) => {
    const names = path.split('/'), last = names.pop();
    let section = doc.documentElement;
    for (const name of names) {
      const found = child(section, name);
      if (!found) throw new Error(`The case has no section <${name}>.`);
      section = found;
    }
    const at = child(section, last);
    if (value === null) {
      if (at) remove(at);
      return;
    }
    if (at) {
      at.textContent = value;
      return;
    }
    const made = doc.createElementNS(section.namespaceURI, last);
    made.textContent = value;
    insert(section, made);
  };
  /* Text of the document with the head of the file as it was. */
  const serialize = (doc, source) => {
    const head = source.slice(0, Math.max(0, source.search(/<case[\s>]/)));
    return head + new XMLSerializer().serializeToString(doc.documentElement) + '\n';
  };
  /* Text of the case with other values, {path: text or null}, and without some sections. */
  const changed = (values, without = []) => {
    const doc = parse(text);
    if (!doc) throw new Error('The case is not well-formed XML; see the panel Start.');
    for (const path in values) put(doc, path, values[path]);
    for (const name of without) {
      const section = child(doc.documentElement, name);
      if (section) remove(section);
    }
    return serialize(doc, text);
  };
  const replace = (made) => {
    if (made === text) return;
    before.push(text);
    after.length = 0;
    text = made;
    caseChanged();
  };
  const edit = (values) => replace(changed(values));
  const madeDocument = (work) => {
    const doc = parse(text);
    if (!doc) throw new Error('The case is not well-formed XML; see the panel Start.');
    work(doc, child, insert, remove);
    return serialize(doc, text);
  };
  const editDocument = (work) => replace(madeDocument(work));
  const undo = (from, to) => {
    if (from.length === 0) return;
    to.push(text);
    text = from.pop();
    caseChanged();
  };
  const showChanged = () => {
    const open = text !== saved;
    $('changed').textContent = state === null || state.case.text === null ? 'There is no case yet.' :
      open ? 'The case has changes that are not saved.' :
        state.current ? 'Saved; the result is up to date.' : state.resultName === null ?
          'Saved; not run yet.' : 'Saved; the result is older than the case.';
    $('save').disabled = !open;
    $('save').classList.toggle('main', open);
    $('run').textContent = open ? 'Save and run' : 'Run the case';
    $('run').classList.toggle('main', !open && state !== null && !state.current);
    $('run').disabled = text === '' && !(state && state.resultName);
    $('undo').disabled = before.length === 0;
    $('redo').disabled = after.length === 0;
    root.dataset.changed = open;
  };
  const caseChanged = () => {
    showChanged();
    for (const panel of panels) {
      panel.old = true;
      if (panel === current) refresh(panel);
    }
    command();
  };
  const save = async () => {
    if (text === saved) return;
    const {digest} = await call('save', {name: state.case.name, was: state.case.digest}, text);
    saved = text;
    await load(false);
    root.dataset.saved = digest;
  };

  /* ---- run ----------------------------------------------------------------------------------- */

  const quote = (word) => /^[\w./:=,@%+-]+$/.test(word) ? word : `'${word.replace(/'/g, '\'\\\'\'')}'`;
  const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const wait = async (what) => {
    let now = await call('progress');
    $('stop').hidden = false;
    while (now.running) {
      $('progress').textContent = `${what}: ${now.time.toFixed(0)} s`;
      await pause(300);
      now = await call('progress');
    }
    $('stop').hidden = true;
    $('progress').textContent = now.succeeded ? `${what} took ${now.time.toFixed(1)} s.` : '';
    if (!now.succeeded) throw new Error(`weartrack ${now.arguments.map(quote).join(' ')}\n${now.words}`);
    root.dataset.runs = now.ended;
    await load(true);
  };
  const run = async () => {
    $('fault').hidden = true;
    await save();
    await call('run');
    await wait('The run');
  };
  const create = async () => {
    await call('new-case');
    await wait('weartrack new-case');
  };
  const command = () => {
    if (!state) return;
    const lines = ['cd ' + quote(state.folder)];
    if (text !== saved) lines.push(`# after saving the case`);
    lines.push(`weartrack run ${quote(state.case.name)}`);
    if (current && current.command) lines.push(...current.command());
    $('command').textContent = lines.join('\n');
  };

  /* ---- panels -------------------------------------------------------------------------------- */

  const refresh = async (panel) => {
    if (!state) return;
    panel.old = false;
    panel.problem.textContent = '';
    try {
      await panel.show(state);
    } catch (problem) {
      panel.problem.textContent = problem.message;
    }
    if (panel === current) root.dataset.shown = panel.id; /* another may have been opened meanwhile */
  };
  const select = (panel) => {
    for (const other of panels) {
      other.tab.setAttribute('aria-selected', other === panel);
      other.tab.tabIndex = other === panel ? 0 : -1;
      other.host.hidden = other !== panel;
    }
    current = panel;
    history.replaceState(null, '', '#' + panel.id);
    command();
    if (panel.old) refresh(panel);
    else if (panel.width !== innerWidth && panel.resize) panel.resize();
    panel.width = innerWidth;
  };
  /* A panel: {id, title, build(host), show(state), command()}. */
  const add = (panel) => {
    panel.old = true;
    panel.problem = element('p', {class: 'problem', role: 'alert'});
    panel.host = element('section', {id: panel.id, role: 'tabpanel', hidden: true,
      'aria-labelledby': 'tab-' + panel.id}, panel.problem);
    panel.tab = element('button', {role: 'tab', id: 'tab-' + panel.id, 'aria-controls': panel.id,
      onclick: () => select(panel)}, panel.title);
    panels.push(panel);
    document.querySelector('nav').append(panel.tab);
    $('panels').append(panel.host);
    panel.build(panel.host);
  };
  const guard = (work) => async (...values) => {
    try {
      return await work(...values);
    } catch (problem) {
      fail(problem.message);
      return null;
    }
  };
  const load = async (all) => {
    state = await call('state');
    if (state.case.text === null && state.resultCase !== null) {
      state.case.text = state.resultCase; /* as saved in the result */
      state.caseProblem = '';
    }
    state.current = state.resultCase !== null && state.resultCase === state.case.text && !state.overridesAreLater;
    if (all || text === saved) {
      text = saved = state.case.text || '';
      before.length = after.length = 0;
    }
    $('title').textContent = state.title || state.case.name;
    document.title = `${state.title || state.case.name} – weartrack view`;
    $('place').textContent = `${state.folder}/${state.case.name}` +
      (state.resultName ? `, result ${state.resultName}` : '') + `, weartrack ${state.version}`;
    showChanged();
    command();
    for (const panel of panels) panel.old = true;
    if (current) await refresh(current);
  };

  /* ---- start --------------------------------------------------------------------------------- */

  const tell = (name) => call('page', {name}).catch((problem) => fail(problem.message));
  addEventListener('pagehide', () => navigator.sendBeacon(address('page', {name: 'leave'})));
  addEventListener('DOMContentLoaded', guard(async () => {
    await tell('open');
    setInterval(tell, 20000, 'alive');
    $('undo').onclick = () => undo(before, after);
    $('redo').onclick = () => undo(after, before);
    $('save').onclick = guard(save);
    $('run').onclick = guard(run);
    $('stop').onclick = guard(() => tell('stop'));
    $('copy').onclick = () => navigator.clipboard.writeText($('command').textContent);
    addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.target.matches('textarea')) return;
      const work = {s: () => $('save').click(), z: () => undo(before, after),
        y: () => undo(after, before)}[event.key];
      if (!work) return;
      event.preventDefault();
      work();
    });
    document.querySelector('nav').addEventListener('keydown', (event) => {
      const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
      if (!step) return;
      const next = panels[(panels.indexOf(current) + step + panels.length) % panels.length];
      select(next);
      next.tab.focus();
    });
    await load(true);
    select(panels.find((p) => '#' + p.id === location.hash) || panels[0]);
    root.dataset.opened = Math.round(performance.now());
  }));
  addEventListener('beforeunload', (event) => {
    if (text !== saved) event.preventDefault();
  });
  let resized = 0;
  addEventListener('resize', () => {
    clearTimeout(resized);
    resized = setTimeout(() => current && select(current), 150);
  });
  const preview = latest(async (names, replicates, source) =>
    tables(await call('preview', {name: names, replicates}, source === undefined ? text : source)));

  /* Tables of the result if it is that of the text, else of a preview without draws. */
  const stored = async (names) => tables(await call('table', {name: names}));
  const results = async (names) => state.current && text === state.case.text ? stored(names) : preview(names, 0);

  return {$, call, results, stored, latest, tables, table, element, show, get, all: texts, has, edit, editDocument, madeDocument, changed, replace,
    text: () => text, state: () => state, add, guard, preview, create, run, save, quote, command, load, fail, wait,
    setOverrides: (value, digest) => { state.overrides.text = value; state.overrides.digest = digest;
      state.current = false; showChanged(); }};
})();
