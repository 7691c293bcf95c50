/* Panels Start and Answer: files, what conditioning found, the text of the case, the report.
 * SPDX-License-Identifier: GPL-3.0-or-later */
'use strict';
(() => {
  const {element, call} = View;
  let files, added, conditioning, form, source, status, create, missing, missingTitle, more;

  const info = async (number, host) => {
    const {tables} = await call('info', {number});
    const [metadata, ...remarks] = tables.map(View.table);
    const value = (item) => {
      const row = metadata.column('item').indexOf(item);
      return row < 0 ? '' : metadata.column('value')[row];
    };
    host.replaceChildren(element('summary', {}, element('b', {}, host.dataset.name), ' ',
      element('span', {class: 'soft'}, value('format') || value('kind') || ''),
      remarks.some((t) => t.n > 0) ? element('span', {}, ' – with remarks') : null),
    ...remarks.map((t) => View.show(t)), View.show(metadata));
  };
  const list = async (state) => {
    const entries = state.files.map((path) => {
      const name = path.startsWith(state.folder + '/') ? path.slice(state.folder.length + 1) : path;
      const host = element('details', {class: 'card'}, element('summary', {}, name));
      host.dataset.name = name;
      return host;
    });
    files.replaceChildren(...entries);
    for (let i = 0; i < entries.length && i < 200; i++)
      await info(i, entries[i]).catch((problem) => {
        entries[i].replaceChildren(element('summary', {}, element('b', {}, entries[i].dataset.name),
          ' – not read'), element('p', {class: 'problem'}, problem.message));
      });
  };

  /* Files of the desktop are written beside the case; the server replaces none. */
  const LIMIT = 64 * 2 ** 20;
  const addFiles = View.guard(async (chosen) => {
    const faults = [], done = [];
    for (const file of chosen)
      try {
        if (file.size > LIMIT) throw new Error(`${file.name}: larger than 64 MiB; copy it into the folder of the case.`);
        await call('save', {name: file.name, was: ''}, await file.arrayBuffer().catch(() => {
          throw new Error(`${file.name}: it cannot be read; drop files, no folder.`);
        }));
        done.push(file.name);
      } catch (problem) {
        faults.push(problem.message);
      }
    if (done.length > 0) await View.load(false);
    added.textContent = done.length === 0 ? '' : `Added ${done.join(', ')}.` +
      (View.state().case.text === null ? '' : ' A case uses the files that its text names.');
    if (faults.length > 0) throw new Error(faults.join('\n'));
  });

  /* Values that most cases need, with their units checked while typing. */
  const fields = [['indentation/tip', 'Tip'], ['indentation/fit-depth', 'Largest indentation of the fit'],
    ['indentation/temperature', 'Temperature of the indentation'],
    ['dma/reference-temperature', 'Reference temperature'], ['sliding/pressure', 'Nominal pressure'],
    ['sliding/temperature', 'Temperature of sliding'], ['sliding/velocity', 'Velocity'],
    ['sliding/shear-stress', 'Shear stress of the contact'],
    ['layer/critical-energy', 'Critical energy U_c'], ['layer/specific-wear-rate', 'Specific wear rate'],
    ['layer/damage', 'Damage']];
  const check = View.latest(async (text) => {
    await call('check', {}, text);
    return true;
  });
  const unfilled = 'FILL IN'; /* as new-case marks what is in no file */
  /* Comment before an element, in which new-case gives examples. */
  const hint = (at) => {
    let before = at.previousSibling;
    while (before && before.nodeType === Node.TEXT_NODE) before = before.previousSibling;
    return before && before.nodeType === Node.COMMENT_NODE ? before.data.trim() : '';
  };
  /* Elements and attributes that have to be filled in, in the order of the file. */
  const gaps = (doc) => [...doc.querySelectorAll('*')].flatMap((at) => [
    ...[...at.attributes].filter((a) => a.value.includes(unfilled)).map((a) => ({label: `${a.name} of <${at.localName}>`,
      value: a.value, set: (text) => { if (text === null) at.removeAttribute(a.name); else a.value = text; }})),
    ...(at.children.length === 0 && at.textContent.includes(unfilled) ? [{
      label: `${at.localName} in <${at.parentNode.localName}>`, value: at.textContent, hint: hint(at),
      set: (text) => { if (text === null) at.remove(); else at.textContent = text; }}] : [])]);
  /* A field whose text is checked in the case while it is typed, and put into it with the last key. */
  const checked = (id, label, attributes, made) => {
    const problem = element('span', {class: 'problem wide', role: 'status', id: id + '-problem'});
    const input = element('input', {type: 'text', id, 'aria-describedby': id + '-problem', ...attributes});
    input.addEventListener('input', async () => {
      try {
        await check(made(input.value.trim() || null));
        problem.textContent = '';
        input.removeAttribute('aria-invalid');
      } catch (error) {
        /* What is missing elsewhere is not the fault of this value. */
        if (error.message.includes(unfilled)) return;
        problem.textContent = error.message;
        input.setAttribute('aria-invalid', true);
      }
    });
    input.addEventListener('change', () => {
      if (!input.hasAttribute('aria-invalid')) View.replace(made(input.value.trim() || null));
    });
    return [element('label', {for: id}, label), input, problem];
  };
  const gap = (found, k) => checked('gap-' + k, found.label, {placeholder: found.value === unfilled ? found.hint :
    found.value.replace(unfilled + ', ', '')}, (text) => View.madeDocument((doc) => gaps(doc)[k].set(text)));
  /* Sections that new-case wrote as a comment become part of the case. */
  const sections = ['indentation', 'dma', 'roughness', 'sliding', 'layer', 'record'];
  const commented = (name) => new RegExp(`<!--[^<]*(<${name}>(?:(?!-->)[\\s\\S])*</${name}>)\\s*-->`);
  const add = (name) => element('button', {onclick: () =>
    View.replace(View.text().replace(commented(name), '$1'))}, `Add <${name}>`);
  const field = ([path, label]) => checked('field-' + path.replace('/', '-'), label,
    {value: View.get(path) || '', placeholder: 'not stated'}, (text) => View.changed({[path]: text}));
  const showForm = () => {
    if (form.contains(document.activeElement)) return; /* a value is being typed */
    const doc = new DOMParser().parseFromString(View.text(), 'application/xml');
    const open = doc.querySelector('parsererror') ? [] : gaps(doc);
    missing.replaceChildren(...open.flatMap(gap));
    missing.hidden = missingTitle.hidden = open.length === 0;
    more.replaceChildren(...sections.filter((name) => !View.has(name) && commented(name).test(View.text())).map(add));
    document.documentElement.dataset.missing = open.length;
    form.replaceChildren(...fields.filter(([path]) => View.has(path.split('/')[0]) &&
      !(View.get(path) || '').includes(unfilled)).flatMap(field));
  };
  const checkText = async () => {
    try {
      await check(source.value);
      status.textContent = 'The case is valid.';
    } catch (problem) {
      status.textContent = problem.message;
    }
  };
  const conditions = async (state) => {
    const names = ['data_quality', 'notes', 'failures'].filter((name) => state.tables.includes(name));
    if (names.length === 0) {
      conditioning.replaceChildren(element('p', {class: 'soft'}, state.resultName ?
        'The data needed no correction.' : 'Run the case to see what was corrected or left out.'));
      return;
    }
    const found = View.tables(await call('table', {name: names.join(' ')}));
    conditioning.replaceChildren(...names.filter((name) => found[name] && found[name].n > 0).flatMap((name) =>
      [element('h3', {}, found[name].title), View.show(found[name])]));
  };

  View.add({
    id: 'start', title: 'Start',
    build(host) {
      create = element('p', {hidden: true}, 'There is no case file yet. ',
        element('button', {class: 'main', onclick: View.guard(() => View.create())},
          'Write a case for these files'));
      files = element('div', {});
      added = element('span', {class: 'soft', role: 'status'});
      const picker = element('input', {type: 'file', multiple: true, onchange: () => addFiles(picker.files)});
      addEventListener('dragover', (event) => event.preventDefault());
      addEventListener('drop', (event) => {
        event.preventDefault(); /* the browser would leave this page */
        if (!host.hidden) addFiles([...event.dataTransfer.files]);
      });
      conditioning = element('div', {});
      form = element('div', {class: 'form card'});
      missing = element('div', {class: 'form card'});
      missingTitle = element('h2', {}, 'What is missing');
      more = element('p', {class: 'tools'});
      status = element('p', {role: 'status'});
      source = element('textarea', {spellcheck: 'false', 'aria-label': 'Text of the case', oninput: checkText,
        onchange: () => View.replace(source.value)});
      host.append(create, element('div', {class: 'halves'},
        element('div', {}, element('h2', {}, 'Files'), files,
          element('p', {class: 'tools'}, element('label', {}, 'Drop files here, or ', picker), added),
          element('h2', {}, 'What conditioning found'), conditioning),
        element('div', {}, missingTitle, missing, element('h2', {}, 'Values'), form, more,
          element('h2', {}, 'Case file'), source, status)));
    },
    async show(state) {
      create.hidden = state.case.text !== null;
      if (document.activeElement !== source) source.value = View.text();
      status.textContent = state.case.text === null ? '' : state.caseProblem;
      showForm();
      if (files.dataset.of !== state.files.join('\n')) {
        files.dataset.of = state.files.join('\n');
        list(state);
      }
      await conditions(state);
    },
    command: () => View.state().case.text === null ?
      [`weartrack new-case -o ${View.quote(View.state().case.name)} .`] : [],
  });

  let frame, none, page, tables, drawn, loads = 0; /* another address loads the frame again */
  /* A file of this page is saved as any download. */
  const save = (name, media, text) => {
    const link = element('a', {href: URL.createObjectURL(new Blob([text], {type: media})), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const saveTable = View.guard(async () => {
    const name = tables.value, t = (await View.stored(name))[name];
    const cell = (value) => value === null ? '' : String(value).replace(/[\t\r\n]+/g, ' ');
    save(name.replace('/', '-') + '.tsv', 'text/tab-separated-values', [
      t.names.map((column) => column + (t.units[column] ? `[${t.units[column]}]` : '')),
      ...t.rows.map((row) => t.names.map((column) => cell(row[column])))]
      .map((row) => row.join('\t') + '\n').join(''));
  });
  const drawFigures = (millimetres) => View.guard(async () => {
    await call('run', {number: millimetres});
    await View.wait(`Drawing figures of ${millimetres} mm`);
    drawn.textContent = `The figures are in ${View.state().folder}/${View.state().reportName}-${millimetres}mm/figures.`;
  });
  View.add({
    id: 'answer', title: 'Answer',
    build(host) {
      none = element('p', {}, 'There is no report yet: run the case.');
      tables = element('select', {'aria-label': 'Table'});
      drawn = element('span', {class: 'soft', role: 'status'});
      page = element('p', {class: 'tools'}, element('a', {href: 'report', target: '_blank'}, 'Open the page'),
        element('a', {href: 'report', download: 'answer.html'}, 'Save the page'),
        element('button', {onclick: () => save(View.state().case.name, 'application/xml', View.text())}, 'Save the case'),
        tables, element('button', {onclick: saveTable}, 'Save the table'),
        ...[85, 170].map((millimetres) => element('button', {onclick: drawFigures(millimetres)},
          `Draw all figures, ${millimetres} mm`)), drawn);
      frame = element('iframe', {title: 'Report', sandbox: 'allow-same-origin allow-popups'});
      host.append(none, page, frame);
    },
    async show(state) {
      const has = state.reportName !== null;
      none.hidden = has;
      page.hidden = frame.hidden = !has;
      tables.replaceChildren(...state.tables.map((name) => element('option', {value: name}, name)));
      if (has) frame.src = 'report?number=' + ++loads;
    },
    command: () => [`weartrack report ${View.quote(View.state().resultName || 'case.h5')} -o answer.html`],
  });
})();
