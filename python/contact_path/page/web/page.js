// Hands the data of the page to plotly.js, and moves them with the slider. Python has made the data: python/contact_path/page/.
'use strict';
(() => {
  const TYPES = {f8: Float64Array, f4: Float32Array, i4: Int32Array, u2: Uint16Array, u1: Uint8Array};
  const ABSENT = 65535; // code of a coordinate that is not there
  const DIGITS = 10; // of values
  const CONTACT_DIGITS = 6; // of values in single precision
  const FEW_CONTACTS = 8; // all of which are in the table, else those that touch
  const MOST_CONTACTS = 40; // in the table
  const SECONDS = 12; // of a path that is played
  const CONFIG = {responsive: true, displaylogo: false, showSendToCloud: false, plotlyServerURL: '',
    modeBarButtonsToRemove: ['select2d', 'lasso2d']};
  const data = JSON.parse(document.getElementById('data').textContent);
  const element = (id) => document.getElementById(id);
  let number = 0; // of the path that the slider moves
  let step = 0;

  // Arrays.

  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const plain = (array) => new TYPES[array.dtype](bytes(array.bdata).buffer);

  function inflated(text) {
    const stream = new Blob([bytes(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(stream).arrayBuffer();
  }

  const unpacked = async (array) => new TYPES[array.dtype](await inflated(array.zlib));

  // Coordinates [steps][m] from the differences of their codes [m][steps].
  async function trajectories(entry, steps) {
    const low = plain(entry.low), unit = plain(entry.unit), differences = await unpacked(entry.codes);
    const rows = Array.from({length: steps}, () => new Float64Array(low.length));
    for (let i = 0; i < low.length; i++) {
      for (let k = 0, code = 0; k < steps; k++) {
        code = (code + differences[i * steps + k]) & 65535;
        rows[k][i] = code === ABSENT ? NaN : low[i] + code * unit[i];
      }
    }
    return rows;
  }

  // Places of points that a list names; not a number where the list has a gap.
  function gather(places, list) {
    const x = new Float64Array(list.length), y = new Float64Array(list.length);
    for (let i = 0; i < list.length; i++) {
      x[i] = list[i] < 0 ? NaN : places[2 * list[i]];
      y[i] = list[i] < 0 ? NaN : places[2 * list[i] + 1];
    }
    return {x, y};
  }

  // A trace whose places are arrays.
  const decoded = (trace) => trace.x.bdata ? {...trace, x: plain(trace.x), y: plain(trace.y)} : trace;

  function digits(value, count) {
    if (!Number.isFinite(value)) {
      return '';
    }
    const [mantissa, exponent] = value.toExponential(count - 1).split('e');
    return Math.abs(value) >= 1e-3 || value === 0 ? String(Number(value.toPrecision(count))) : `${Number(mantissa)}e${exponent}`;
  }

  // The structure of a path: traces, and for a step what changes in them.

  async function unpackStructure(given, steps) {
    const own = {...given, steps: await trajectories(given.points, steps), still: given.still.map(decoded)};
    own.moving = given.moving.map((part) => {
      const points = plain(part.points);
      return {...part, points, names: Array.from(points, (point) => given.names[point] || '')};
    });
    own.obstacles = given.obstacles.map((part) => ({trace: decoded(part.trace), motion: part.motion &&
      Object.fromEntries(Object.entries(part.motion).map(([name, values]) => [name, plain(values)]))}));
    if (given.solids) {
      own.solids = {...given.solids, boundaries: plain(given.solids.boundaries), classes: await unpacked(given.solids.classes)};
    }
    if (given.contacts) {
      own.contacts = {...given.contacts, nodes: plain(given.contacts.nodes)};
      for (const field of ['gap', 'rn', 'rt', 'layer', 'state']) {
        own.contacts[field] = await unpacked(given.contacts[field]);
      }
    }
    own.template = `%{text}<br>x %{x:.${given.decimals}f}<br>y %{y:.${given.decimals}f}<extra></extra>`;
    return own;
  }

  function placedObstacle(part, at) {
    const {angle, x, y} = part.motion, c = Math.cos(angle[at]), s = Math.sin(angle[at]);
    const before = part.trace;
    return {x: before.x.map((value, i) => c * value - s * before.y[i] + x[at]),
      y: before.x.map((value, i) => s * value + c * before.y[i] + y[at])};
  }

  function elementsByClass(solids, places, at) {
    const width = solids.width, count = solids.boundaries.length / width;
    const lists = solids.traces.map(() => []);
    for (let i = 0; i < count; i++) {
      lists[solids.classes[at * count + i]].push(...solids.boundaries.subarray(i * width, (i + 1) * width));
    }
    return lists.map((list) => gather(places, list));
  }

  function contactMarks(contacts, places, at) {
    const count = contacts.nodes.length;
    const marks = {...gather(places, contacts.nodes), sizes: [], colours: [], texts: []};
    for (let i = 0; i < count; i++) {
      const layer = contacts.layer[at * count + i], state = contacts.state[at * count + i];
      marks.sizes.push(layer ? contacts.size / Math.sqrt(2 * layer - 1) : 0);
      marks.colours.push(contacts.colours[state]);
      marks.texts.push(contactValues(contacts, at, i).join('<br>'));
    }
    return marks;
  }

  function contactValues(contacts, at, i) {
    const k = at * contacts.nodes.length + i;
    return [contacts.names[i], contacts.states[contacts.state[k]],
      ...['rn', 'rt', 'gap'].map((field) => field + ' ' + digits(contacts[field][k], CONTACT_DIGITS))];
  }

  // Traces that no step moves, drawn below all others.
  const stillTraces = (own) => [...own.obstacles.filter((part) => !part.motion).map((part) => part.trace), ...own.still,
    ...(own.solids ? own.solids.legend : []), ...(own.contacts ? own.contacts.legend : [])];

  // Traces that a step moves, from the bottom up, the same ones in each step.
  function movingTraces(own, at) {
    const places = own.steps[at];
    const traces = own.obstacles.filter((part) => part.motion).map((part) => ({...part.trace, ...placedObstacle(part, at)}));
    if (own.solids) {
      elementsByClass(own.solids, places, at).forEach((found, i) => traces.push({...own.solids.traces[i], ...found}));
    }
    for (const part of own.moving) {
      const told = part.named ? {text: part.names, hovertemplate: own.template} : {};
      traces.push({...part.trace, ...gather(places, part.points), ...told});
    }
    if (own.contacts) {
      const {sizes, colours, texts, ...found} = contactMarks(own.contacts, places, at);
      const trace = own.contacts.trace;
      traces.push({...trace, ...found, text: texts, marker: {...trace.marker, size: sizes, color: colours}});
    }
    return traces;
  }

  let drawn = null; // the structure that is drawn

  function drawStructure(own, at) {
    const still = stillTraces(own), moving = movingTraces(own, at);
    if (own === drawn) {
      return moved('structure', moving, still.length);
    }
    drawn = own;
    return Plotly.react('structure', [...still, ...moving], own.layout, CONFIG);
  }

  // Gives the traces from the first one on new places, and draws these traces alone.
  const moved = (figure, traces, first) => Plotly.animate(figure, {data: traces, traces: traces.map((_, i) => first + i)},
    {mode: 'immediate', transition: {duration: 0}, frame: {duration: 0, redraw: false}});

  // The curves: the points that tell their values, and a mark where the slider is.

  function texts(path) {
    const columns = path.columns.map(({label, values}) => ({label, values: plain(values)}));
    path.values = (at) => columns.map(({label, values}) => [label, digits(values[at], DIGITS)]);
    return path.headings.map((heading, at) =>
      heading + path.values(at).map(([label, value]) => `<br>${label}: ${value}`).join(''));
  }

  let marks = 0; // the first trace of the curves that the slider moves

  // The curves of paths, which `meta` of the traces counts.
  function drawCurves(figure, paths) {
    const traces = [...figure.data], told = paths.map(texts);
    const points = traces.filter((trace) => trace.meta);
    paths.forEach((path, i) => {
      path.points = points.filter((trace) => trace.meta.path === i)
        .map((trace) => ({xaxis: trace.xaxis, x: plain(trace.x), y: plain(trace.y)}));
    });
    for (const trace of points) {
      trace.text = told[trace.meta.path];
    }
    const mark = {type: 'scatter', mode: 'markers', hoverinfo: 'skip', showlegend: false, x: [], y: [],
      marker: {size: 13, color: 'rgba(255,255,255,0.4)', line: {color: 'black', width: 2}}};
    marks = traces.length;
    traces.push({...mark, xaxis: 'x', yaxis: 'y'}, {...mark, xaxis: 'x2', yaxis: 'y2'});
    return Plotly.react('curves', traces, figure.layout, CONFIG);
  }

  function clickedCurve({points: [point]}) {
    if (point.data.meta) {
      stop();
      choose(data.curves ? point.data.meta.path : number, point.pointNumber);
    }
  }

  function moveMarks(path) {
    const of = (axis) => path.points.filter((curve) => curve.xaxis === axis);
    return moved('curves', ['x', 'x2'].map((axis) =>
      ({x: of(axis).map((curve) => curve.x[step]), y: of(axis).map((curve) => curve.y[step])})), marks);
  }

  // The map of a study: a point for each line of its table.

  function drawMap() {
    const study = data.study, columns = study.columns;
    const [across, up, colour] = ['across', 'up', 'colour'].map((id) => columns[element(id).value]);
    const chosen = study.paths.indexOf(number);
    const axis = (column) => ({title: {text: column.label}, type: column.kind, automargin: true, gridcolor: '#ebebeb'});
    const lines = study.paths.map((_, i) =>
      [`line ${i + 1}`, ...columns.map(({label, values}) => `${label}: ${values[i] ?? ''}`)].join('<br>'));
    const symbols = study.paths.map((path) => path === null ? 'x-thin-open' : 'circle'); // a line without path, one with it
    const point = {type: 'scatter', mode: 'markers', showlegend: false};
    const coloured = colour ? {color: colour.values.map((value) => value ?? NaN), colorscale: 'Viridis',
      colorbar: {title: {text: colour.label, side: 'right'}, thickness: 12}} : {color: '#1f77b4'};
    return Plotly.react('map', [
      {...point, x: across.values, y: up.values, text: lines, hovertemplate: '%{text}<extra></extra>',
        marker: {size: 12, symbol: symbols, ...coloured}},
      {...point, x: [across.values[chosen]], y: [up.values[chosen]], hoverinfo: 'skip',
        marker: {size: 18, color: 'rgba(0,0,0,0)', line: {color: 'red', width: 2.5}}},
    ], {xaxis: axis(across), yaxis: axis(up), margin: {l: 60, r: 10, t: 32, b: 50}, hovermode: 'closest'}, CONFIG);
  }

  async function beginStudy() {
    const study = data.study;
    for (const [id, start] of Object.entries(study.start)) {
      const usable = study.columns.map((_, i) => i).filter((i) => id !== 'colour' || study.columns[i].kind !== 'category');
      element(id).append(...usable.map((i) => new Option(study.columns[i].label, i, i === start, i === start)));
      element(id).addEventListener('change', drawMap);
    }
    element('coloured').hidden = !element('colour').options.length; // without a column of numbers
    await drawMap();
    element('map').on('plotly_click', ({points: [point]}) => {
      const path = study.paths[point.pointNumber];
      if (point.curveNumber === 0 && path !== null) {
        stop();
        choose(path, 0);
      }
    });
  }

  // Beside the figures.

  function fillTable(table, rows) {
    table.replaceChildren(...rows.map(([kind, ...cells]) => {
      const row = document.createElement('tr');
      row.append(...cells.map((content) => {
        const cell = document.createElement(kind);
        cell.append(...[].concat(content));
        cell.title = cell.textContent;
        return cell;
      }));
      return row;
    }));
  }

  function stateMark(colour) {
    const mark = document.createElement('i');
    mark.className = 'state';
    mark.style.background = colour;
    return mark;
  }

  function contactRows(contacts) {
    const count = contacts.nodes.length;
    const touching = Array.from(contacts.nodes.keys()).filter((i) => contacts.states[contacts.state[step * count + i]] !== 'open');
    const shown = count <= FEW_CONTACTS ? Array.from(contacts.nodes.keys()) : touching.slice(0, MOST_CONTACTS);
    const value = (field, i) => digits(contacts[field][step * count + i], CONTACT_DIGITS);
    const rows = shown.map((i) => {
      const state = contacts.state[step * count + i], name = [stateMark(contacts.colours[state]), contacts.names[i]];
      return ['td', name, contacts.states[state], value('rn', i), value('rt', i)];
    });
    return [['th', `contacts, ${touching.length} of ${count} touch`, 'state', 'rn', 'rt'], ...rows];
  }

  function tell(path) {
    const [heading, ...branches] = path.headings[step].split('<br>');
    element('heading').textContent = heading;
    element('branches').replaceChildren(...branches.flatMap((line) => [line, document.createElement('br')]));
    fillTable(element('values'), path.values(step).map((row) => ['td', ...row]));
    const contacts = path.unpacked && path.unpacked.contacts;
    fillTable(element('contacts'), contacts ? contactRows(contacts) : []);
  }

  function remarks(path) {
    const said = [path.end];
    if (path.steps < path.increments) {
      said.push(`The slider goes through ${path.steps} of ${path.increments} increments.`);
    }
    if (!path.structure) {
      said.push('The structure is drawn where the scene of the path is given (--scene).');
    }
    element('remarks').textContent = said.filter(Boolean).join(' ');
  }

  // The slider.

  async function show() {
    const path = data.paths[number];
    element('slider').value = step;
    tell(path);
    const shown = [moveMarks(path)];
    if (path.unpacked) {
      shown.push(drawStructure(path.unpacked, step));
    }
    await Promise.all(shown);
  }

  let pending = null; // what is being shown; one more waits at most
  let again = false;

  function update() {
    again = true;
    pending = pending || (async () => {
      try {
        while (again) {
          again = false;
          await new Promise(requestAnimationFrame);
          await show();
        }
      } finally {
        pending = null;
      }
    })();
    return pending;
  }

  async function load(path) {
    const own = data.paths[path];
    if (own.zlib) {
      Object.assign(own, JSON.parse(new TextDecoder().decode(await inflated(own.zlib))), {zlib: null});
    }
    return own;
  }

  let choices = 0; // counts choices: a path that is unpacked after a later choice is not shown

  async function choose(path, at) {
    const mine = ++choices, own = await load(path);
    if (own.structure && !own.unpacked) {
      own.unpacked = await unpackStructure(own.structure, own.steps);
    }
    if (mine !== choices) {
      return undefined;
    }
    const redraws = own.curves && (path !== number || !own.points);
    number = path;
    step = at;
    element('path').value = path;
    element('slider').max = own.steps - 1;
    element('structure').style.visibility = own.structure ? 'visible' : 'hidden';
    remarks(own);
    await Promise.all([redraws && drawCurves(own.curves, [own]), data.study && drawMap()]);
    return update();
  }

  let playing = 0; // counts plays: an earlier one ends when a later one begins

  async function play() {
    const mine = ++playing, steps = data.paths[number].steps;
    const from = step < steps - 1 ? step : 0, start = performance.now();
    element('play').textContent = '\u23f8';
    while (mine === playing) {
      const at = from + Math.floor((performance.now() - start) / 1000 * Math.max(steps, 60) / SECONDS);
      step = Math.min(at, steps - 1);
      await update();
      if (step === steps - 1) {
        stop();
      }
    }
  }

  function stop() {
    playing++;
    element('play').textContent = '\u25b6';
  }

  async function begin() {
    element('path').append(...data.paths.map((path, i) => new Option(path.title || `path ${i + 1}`, i)));
    element('chosen').hidden = data.paths.length < 2;
    element('path').addEventListener('change', () => { stop(); choose(Number(element('path').value), 0); });
    element('slider').addEventListener('input', () => { stop(); step = Number(element('slider').value); update(); });
    element('play').addEventListener('click', () => element('play').textContent === '\u25b6' ? play() : stop());
    document.querySelector('main').classList.toggle('study', data.study !== null); // before the figures take their sizes
    element('study').hidden = data.study === null;
    if (data.curves) {
      await drawCurves(data.curves, await Promise.all(data.paths.map((_, i) => load(i))));
    } else {
      await drawCurves((await load(0)).curves, [data.paths[0]]);
      await beginStudy();
    }
    element('curves').on('plotly_click', clickedCurve);
    const wanted = Number(location.hash.slice(1)); // page.html#40: at increment 40
    await choose(0, Math.max(0, plain(data.paths[0].indices).findLastIndex((index) => index <= wanted)));
  }

  window.page = {data, choose, ready: begin()};
})();
