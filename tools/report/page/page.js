// Behaviour of the report page: line charts, run and surface pickers, CSV downloads, colours. No network, no storage.
(() => {
  'use strict';
  const root = document.documentElement;
  const series = JSON.parse(document.getElementById('series').textContent);
  const style = name => getComputedStyle(root).getPropertyValue(name).trim();
  const dashes = [[], [8, 3], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2], [14, 4], [4, 4, 1, 4]];
  const wholeSteps = [0, 1, 2, 3, 4, 5, 6, 7, 8].flatMap(power => [1, 2, 5].map(digit => digit * 10 ** power));
  const compact = new Intl.NumberFormat('en', {notation: 'compact'});
  const live = new Set();

  const element = (tag, attributes, ...children) => {
    const made = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };
  const csvField = text => /[",\r\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  const csvText = rows => rows.map(row => row.map(cell => csvField(String(cell ?? ''))).join(',') + '\n').join('');
  const save = (name, text) => {
    const link = element('a', {download: name, href: URL.createObjectURL(new Blob([text], {type: 'text/csv'}))});
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };
  const tableRows = table => [...table.rows].map(row => [...row.cells].map(
      cell => cell.dataset.v ?? cell.textContent.trim()));
  // A plot with labels has the positions 0, 1, 2, ... on its x axis.
  const xText = (plot, x) => plot.x_labels ? plot.x_labels[x] ?? '' : x;
  const plotRows = plot => {
    const rows = [[plot.x_name, ...plot.series.map(line => line.name)]];
    plot.x.forEach((x, i) => rows.push([xText(plot, x), ...plot.series.map(line => line.y[i])]));
    return rows;
  };
  const shown = value => value == null ? '–' : Number(value.toPrecision(5)).toString();

  function draw(box, plot) {
    const target = box.querySelector('.lines');
    const narrow = target.clientWidth < 500;
    const axis = {stroke: style('--soft'), grid: {stroke: style('--grid'), width: 1}, ticks: {stroke: style('--line'), width: 1},
                  font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif', labelGap: 2};
    const options = {
      width: target.clientWidth, height: narrow ? 250 : 300,
      scales: {x: {time: false, distr: plot.x_log ? 3 : 1},
               y: {range: (u, low, high) => [plot.y_min, plot.y_max || (high > 0 ? plot.y_min + (high - plot.y_min) * 1.05 : 1)]}},
      axes: [{...axis, label: plot.x_unit, ...(plot.x_log ? {} : {incrs: wholeSteps}), labelSize: 20, size: 30, space: narrow ? 55 : 70,
              ...(plot.x_labels ? {splits: () => plot.x} : {}),
              values: (u, ticks) => ticks.map(tick => tick == null || tick % 1 ? '' : plot.x_log ? compact.format(tick) : String(xText(plot, tick)))},
             {...axis, label: plot.y_unit, labelSize: 20, size: 48}],
      series: [{label: plot.x_name, value: (u, value) => value == null ? '–' : plot.x_labels ? xText(plot, value) : shown(value)},
               ...plot.series.map((line, i) => ({
                 label: line.name, stroke: style('--s' + line.color % 10), width: 1.5, spanGaps: true, value: (u, value) => shown(value),
                 ...(line.points_only ? {paths: () => null, points: {show: true, size: 10, width: 2, fill: style('--paper')}}
                                      : {dash: dashes[i % dashes.length], points: {show: plot.x.length < 60, size: 5}})}))],
      legend: {live: true}, cursor: {drag: {x: true, y: false}},
      hooks: {draw: [() => { target.dataset.drawn = plot.x.length; }]},
    };
    const chart = new uPlot(options, [plot.x, ...plot.series.map(line => line.y)], target);
    chart.root.querySelectorAll('.u-legend .u-series').forEach((row, i) => {
      const head = row.querySelector('th');
      if (i === 0 || !head) return;
      head.tabIndex = 0;
      head.setAttribute('role', 'button');
      head.setAttribute('aria-label', 'show or hide ' + plot.series[i - 1].name);
      head.addEventListener('keydown', event => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        chart.setSeries(i, {show: !chart.series[i].show});
      });
    });
    return chart;
  }

  function summary(plot) {
    const rows = plot.series.map(line => {
      const known = line.y.filter(value => value != null);
      const at = known.length ? [Math.min(...known), Math.max(...known)] : [null, null];
      return `${line.name} ${shown(at[0])} to ${shown(at[1])}`;
    });
    return `${plot.title}: ${rows.join(', ')}.`;
  }

  const heading = name => name.includes('=') ? name : name.replaceAll('_', ' ');

  function fillTable(details, plot) {
    const limit = 2000, rows = plotRows(plot);
    const table = element('table', {class: 'figures'});
    const head = element('tr', {}, ...rows[0].map(name => element('th', {scope: 'col'}, heading(name))));
    table.append(element('thead', {}, head));
    const body = element('tbody');
    for (const row of rows.slice(1, limit + 1))
      body.append(element('tr', {}, ...row.map((value, i) => element('td', {'data-h': heading(rows[0][i])}, value == null ? '' : String(value)))));
    table.append(body);
    if (rows.length - 1 > limit)
      details.append(element('p', {class: 'note'}, `The first ${limit} of ${rows.length - 1} rows; the CSV has all.`));
    details.append(element('div', {class: 'scroll', tabindex: '0'}, table));
  }

  function plotBox(plot) {
    const lines = element('div', {class: 'lines', tabindex: '0', role: 'img', 'aria-label': summary(plot) +
        ' Left and right arrow keys move the cursor.'});
    const button = element('button', {type: 'button', class: 'save'}, 'Download CSV');
    button.addEventListener('click', () => save(plot.file, csvText(plotRows(plot))));
    const details = element('details', {}, element('summary', {}, 'The same as a table'));
    details.addEventListener('toggle', () => { if (details.open && !details.querySelector('table')) fillTable(details, plot); });
    const box = element('div', {class: 'chart', 'data-plot': plot.id}, element('h3', {}, plot.title),
                        element('p', {class: 'note'}, plot.note), lines, element('div', {class: 'tools'}, button), details);
    box.plot = plot;
    return box;
  }

  function start(box) {
    const entry = {box, chart: draw(box, box.plot)};
    const lines = box.querySelector('.lines');
    lines.addEventListener('keydown', event => {
      const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
      if (!step || event.target !== lines) return;
      event.preventDefault();
      const last = box.plot.x.length - 1, now = entry.chart.cursor.idx ?? (step > 0 ? -1 : last + 1);
      const index = Math.max(0, Math.min(last, now + step));
      entry.chart.setCursor({left: entry.chart.valToPos(box.plot.x[index], 'x'), top: 10});
    });
    entry.watch = new ResizeObserver(() => {
      const width = lines.clientWidth;
      if (width > 0 && width !== entry.chart.width)
        entry.chart.setSize({width, height: width < 500 ? 250 : 300});
    });
    entry.watch.observe(lines);
    live.add(entry);
  }
  function stopIn(place) {
    for (const entry of live) {
      if (!place.contains(entry.box)) continue;
      entry.watch.disconnect();
      entry.chart.destroy();
      live.delete(entry);
    }
  }
  function redraw() {
    for (const entry of live) {
      entry.chart.destroy();
      entry.chart = draw(entry.box, entry.box.plot);
    }
  }

  const sections = [...document.querySelectorAll('section.run')];
  const runPick = document.getElementById('run-pick');
  function showSurface(place, surface) {
    stopIn(place);
    place.replaceChildren(...surface.plots.map(plotBox));
    [...place.children].forEach(start);
  }
  // Charts of the first surface, and a picker if there are more.
  function showSurfaces(place, surfaces, picked) {
    const charts = element('div');
    stopIn(place);
    place.replaceChildren();
    if (surfaces.length > 1) {
      const pick = element('select', {}, ...surfaces.map((surface, i) => element('option', {value: i}, surface.label)));
      pick.addEventListener('change', () => showSurface(charts, surfaces[pick.value]));
      place.append(element('label', {class: 'pick'}, picked + ' ', pick));
    }
    place.append(charts);
    showSurface(charts, surfaces[0]);
  }
  function showRun(index) {
    sections.forEach((section, i) => { section.hidden = i !== index; });
    const place = sections[index]?.querySelector('.line-charts');
    const surfaces = series[index]?.surfaces ?? [];
    for (const section of sections) stopIn(section);
    if (place && surfaces.length > 0) showSurfaces(place, surfaces, 'Surface');
  }
  document.querySelectorAll('[data-series]').forEach(place =>
      showSurfaces(place, series[place.dataset.series].surfaces, place.dataset.picked));
  if (sections.length > 0) {
    if (runPick) runPick.addEventListener('change', () => showRun(Number(runPick.value)));
    document.querySelectorAll('a[data-run]').forEach(link => link.addEventListener('click', () => {
      if (runPick) runPick.value = link.dataset.run;
      showRun(Number(link.dataset.run));
    }));
    const wanted = sections.findIndex(section => '#' + section.id === location.hash);
    if (runPick && wanted > 0) runPick.value = String(wanted);
    showRun(Math.max(0, wanted));
  }

  document.querySelectorAll('button[data-table]').forEach(button => button.addEventListener('click', () =>
      save(button.dataset.file, csvText(tableRows(document.getElementById(button.dataset.table))))));
  document.querySelectorAll('select[data-swap]').forEach(pick => pick.addEventListener('change', () => {
    document.querySelectorAll(`[data-swap-of="${pick.dataset.swap}"]`).forEach(part => {
      part.hidden = part.dataset.swapKey !== pick.value;
    });
  }));
  const theme = document.getElementById('theme');
  theme.addEventListener('change', () => {
    if (theme.value) root.dataset.theme = theme.value; else delete root.dataset.theme;
    redraw();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
  document.getElementById('print').addEventListener('click', () => print());
  let before;
  addEventListener('beforeprint', () => {
    before = root.dataset.theme;
    root.dataset.theme = 'light';
    redraw();
  });
  addEventListener('afterprint', () => {
    if (before) root.dataset.theme = before; else delete root.dataset.theme;
    redraw();
  });
  root.dataset.ready = 'yes';
})();
