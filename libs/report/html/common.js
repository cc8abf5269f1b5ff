// SPDX-License-Identifier: BSD-3-Clause
// What the pages share: elements, numbers, charts, and the words about a run's frames.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);

// ---- Elements and numbers ---------------------------------------------------------------------

const byId = id => document.getElementById(id);

/** A new element with attributes and children, which are elements or text. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name === 'onclick') made.addEventListener('click', value);
    else made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const known = value => value !== null && value !== undefined;
const number = (value, digits = 0) => known(value)
  ? value.toLocaleString('en', {minimumFractionDigits: digits, maximumFractionDigits: digits}) : '-';
/** At most so many decimals, and none that are 0: for axes. */
const atMost = digits => value => value.toLocaleString('en', {maximumFractionDigits: digits});
const share = value => number(value, 3);
const bytes = value => value >= 1e9 ? number(value / 1e9, 2) + '\u00a0GB' : number(value / 1e6, 1) + '\u00a0MB';
const plural = (count, thing) => count === 1 ? thing : thing + 's';
const counting = (count, thing) => `${number(count)} ${plural(count, thing)}`;
const words = name => name.replaceAll('_', ' ');
const metres = value => number(value, value < 1 ? 3 : 2) + '\u00a0m';
/** Metres in the unit that suits them, three digits. */
const length = value => {
  const [unit, size] = value >= 1 ? ['m', 1] : value >= 0.01 ? ['cm', 0.01] : value >= 0.001 ? ['mm', 1e-3] : ['\u00b5m', 1e-6];
  return `${Number((value / size).toPrecision(3))} ${unit}`;
};
/** A number that may be of any size. */
function large(value) {
  if (Math.abs(value) < 1e6) return number(value, 1);
  const [mantissa, exponent] = value.toExponential(2).split('e+');
  return `${mantissa} × 10${[...exponent].map(digit => '⁰¹²³⁴⁵⁶⁷⁸⁹'[digit]).join('')}`;
}

function clock(seconds) {
  if (seconds < 60) return number(seconds, 1) + '\u00a0s';
  const whole = Math.round(seconds);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h > 0 ? `${h} h ${m} min` : `${m} min ${s} s`;
}

/** The name of a file or folder, that a narrow table may break after each `_`. */
const breakable = name => name.replaceAll('_', '_\u200b');

/** Says in a panel why there is nothing in it. */
function say(panel, ...reason) {
  panel.replaceChildren(element('div', {class: 'empty'}, ...reason));
  panel.style.height = panel.style.aspectRatio = 'auto';
}

/** A table of cells, which are text; the first column is words, the others are numbers. */
function tableOf(heads, rows) {
  const row = (tag, cells) => element('tr', {}, ...cells.map((cell, i) =>
    element(tag, {class: i ? '' : 'text'}, cell)));
  return [element('thead', {}, row('th', heads)), element('tbody', {}, ...rows.map(cells => row('td', cells)))];
}

/** Names and what they are, in words; they break, so that there is nothing to scroll. */
function factsTable(facts) {
  return element('table', {class: 'facts'}, element('tbody', {}, ...facts.map(([name, value]) =>
    element('tr', {}, element('th', {class: 'text', scope: 'row'}, name), element('td', {class: 'text'}, String(value))))));
}

/** Facts that are shown when they are asked for. */
const explanation = (title, facts) => element('details', {}, element('summary', {}, title), factsTable(facts));

// ---- Charts -----------------------------------------------------------------------------------

// Okabe and Ito: the colour-blind can tell them apart. Viridis for amounts. On maps, the colours of map_top.png.
const palette = ['#0072b2', '#e69f00', '#009e73', '#d55e00', '#cc79a7', '#56b4e9', '#b8a800', '#7f7f7f', '#8a6bc8', '#a8705e', '#8fce5a'];
const viridis = ['#440154', '#3b528b', '#21918c', '#5ec962', '#fde725'];
const mapColours = {truth: '#f0b050', input: '#56b4e9', start: '#0072b2', end: '#d55e00'};
const drawings = [];

const isFinger = matchMedia('(pointer: coarse)').matches;

const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

function viridisAt(part) {
  const at = Math.min(0.9999, Math.max(0, part)) * (viridis.length - 1);
  return echarts.color.lerp(at - Math.floor(at), [viridis[Math.floor(at)], viridis[Math.floor(at) + 1]]);
}

/** Draws a chart, again whenever light changes to dark. `options` is called each time. */
function draw(id, options) {
  byId(id).setAttribute('role', 'img');  // ECharts adds the label
  const chart = echarts.init(byId(id), null, {renderer: 'canvas', locale: 'EN'});
  const redraw = () => chart.setOption(withDefaults(chart, options(chart)), true);
  drawings.push({chart, redraw});
  redraw();
  return chart;
}

const legendWidth = chartWidth => chartWidth - 24;

/** Room for a legend above a chart of so many pixels: as many lines as its names need. */
function legendHeight(chartWidth, names) {
  let [lines, used] = [1, 0];
  for (const name of new Set(names)) {
    const width = 32 + 7.2 * name.length;
    if (used > 0 && used + width > legendWidth(chartWidth)) [lines, used] = [lines + 1, 0];
    used += width;
  }
  return 22 * lines;
}

/** Above a finger, that would hide it; where there is no room, below. */
function besideFinger([x, y], _item, _tooltip, _mark, {contentSize: [width, height]}) {
  const gap = 24;
  return [x - width / 2, y > height + gap ? y - height - gap : y + gap];
}

function withDefaults(chart, options) {
  const text = {color: colour('faint'), fontSize: 13};
  const axis = {
    axisLabel: {...text, hideOverlap: true},
    axisLine: {onZero: false, lineStyle: {color: colour('line')}},
    nameTextStyle: text,
    splitLine: {lineStyle: {color: colour('line'), opacity: 0.6}},
  };
  const styled = axes => [].concat(axes || []).map(one =>
    ({...axis, ...one, axisLabel: {...axis.axisLabel, ...one.axisLabel}}));
  const top = options.legend ? legendHeight(chart.getWidth(), options.series.map(({name}) => name)) : 0;
  return {
    animation: false,
    color: palette,
    aria: {enabled: true},
    textStyle: {fontFamily: getComputedStyle(document.body).fontFamily, fontSize: 13, color: colour('ink')},
    ...options,
    grid: {...options.grid, top: options.grid.top + top},
    ...(options.xAxis ? {xAxis: styled(options.xAxis), yAxis: styled(options.yAxis)} : {}),
    tooltip: {
      backgroundColor: colour('page'),
      borderColor: colour('line'),
      textStyle: {color: colour('ink')},
      extraCssText: 'white-space: normal; max-width: min(440px, 80vw)',
      confine: true,
      ...(isFinger ? {position: besideFinger} : {}),
      ...options.tooltip,
    },
    legend: options.legend
      ? {textStyle: {color: colour('ink'), fontSize: 13}, top: 0, itemWidth: 14, itemHeight: 10, width: legendWidth(chart.getWidth()),
         inactiveColor: colour('off'), ...options.legend} : undefined,
  };
}

const frameAxis = frames => ({type: 'value', name: 'frame', nameLocation: 'middle', nameGap: 26, min: 0, minInterval: 1,
                              max: Math.max(1, frames - 1), splitLine: {show: false},
                              axisLabel: {showMaxLabel: false, formatter: value => String(Math.round(value))}});
// `top` is counted from below the legend.
const plotGrid = {left: 64, right: 24, top: 24, bottom: 48};
const matrixGrid = {left: 64, right: 20, top: 16, bottom: 48};
const mapGrid = {left: 60, right: 30, top: 28, bottom: 60};
// Wheel and finger scroll the page over these charts: there are many of them.
const zoom = [{type: 'inside', xAxisIndex: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl', preventDefaultMouseMove: false}];
const mapZoom = [{type: 'inside', xAxisIndex: 0, filterMode: 'none'}, {type: 'inside', yAxisIndex: 0, filterMode: 'none'}];
const mapLabels = {showMinLabel: false, showMaxLabel: false, formatter: atMost(3)};

/** Both axes of a map of these positions, so that a metre is as long in x as in y. */
function mapAxes(chart, positions, series) {
  const range = axis => positions.reduce(([a, b], p) => [Math.min(a, p[axis]), Math.max(b, p[axis])], [Infinity, -Infinity]);
  const [[x0, x1], [y0, y1]] = [range(0), range(1)];
  const top = mapGrid.top + legendHeight(chart.getWidth(), series.map(({name}) => name));
  const width = Math.max(50, chart.getWidth() - mapGrid.left - mapGrid.right);
  const height = Math.max(50, chart.getHeight() - top - mapGrid.bottom);
  const scale = 1.06 * Math.max((x1 - x0) / width, (y1 - y0) / height, 1e-3);
  const labels = Math.max(2, Math.round(Math.min(width, height) / 80));
  const axis = (name, nameGap, centre, pixels) => ({
    type: 'value', name, nameGap, nameLocation: 'middle', axisLabel: mapLabels,
    splitNumber: Math.round(labels * pixels / Math.min(width, height)),
    min: centre - scale * pixels / 2, max: centre + scale * pixels / 2});
  return {xAxis: axis('x, m', 28, (x0 + x1) / 2, width), yAxis: axis('y, m', 42, (y0 + y1) / 2, height)};
}

/** A map of these positions, drawn anew when the window changes. */
function drawMapOf(positions, makeSeries, options = {}) {
  return draw('map-chart', chart => {
    const series = makeSeries();
    return {grid: mapGrid, dataZoom: mapZoom, series, ...options, legend: {top: 10, itemWidth: 24, ...options.legend},
            ...mapAxes(chart, positions, series)};
  });
}

const trajectoryLine = (name, positions, style) => ({
  name, type: 'line', data: positions.map(p => known(p) ? [p[0], p[1]] : ['-', '-']), showSymbol: false, silent: true, z: 2,
  lineStyle: {width: 2, ...style}, itemStyle: {color: style.color, opacity: 0}});  // no mark on its line in the legend

let drawnWidth = window.innerWidth;
window.addEventListener('resize', () => {
  if (window.innerWidth === drawnWidth) return;  // a phone's address bar comes and goes
  drawnWidth = window.innerWidth;
  drawings.forEach(({chart, redraw}) => { chart.resize(); redraw(); });
});
matchMedia('(prefers-color-scheme: dark)')
  .addEventListener('change', () => drawings.forEach(({redraw}) => redraw()));

/** Stages that are parts of a frame, in the order of the pipeline. */
const frameStages = ['image_decoding', 'global_descriptor', 'local_features', 'hashing', 'depth', 'index_insertion',
                     'index_search', 'matching', 'verification', 'evidence', 'relative_pose'];

const stageColour = stage => palette[frameStages.indexOf(stage)];

/** A bar for each run: the mean time of a frame by stages. `bars` are [name, summary]. */
function drawStages(id, bars) {
  const mean = (summary, stage) => ((summary.stage_times_ms || {})[stage] || {total: 0}).total
    / Math.max(1, summary.frames.camera_frames);
  const stages = frameStages.filter(stage => bars.some(([, summary]) => mean(summary, stage) > 0));
  if (!stages.length) return say(byId(id), 'no times were taken');
  const grid = {left: 16, right: 24, top: 8, bottom: 30, containLabel: true};
  byId(id).style.height = legendHeight(byId(id).clientWidth, stages.map(words)) + grid.top + grid.bottom + 24 + 52 * bars.length + 'px';
  draw(id, () => ({
    grid,
    legend: {}, tooltip: {trigger: 'item', valueFormatter: value => number(value, 2) + ' ms'},
    xAxis: {type: 'value', name: 'ms a frame, on average', nameLocation: 'middle', nameGap: 26},
    yAxis: {type: 'category', data: bars.map(([name]) => name), axisTick: {show: false}, inverse: true},
    series: stages.map(stage => ({name: words(stage), type: 'bar', stack: 'all', barMaxWidth: 40, itemStyle: {color: stageColour(stage), borderColor: colour('page'), borderWidth: 0.5},
                                  data: bars.map(([, summary]) => mean(summary, stage))})),
  }));
}

// ---- Frames of a run --------------------------------------------------------------------------

const frameCountOf = run => run.frames.timestamp.length;
const baseName = path => path.split('/').filter(Boolean).pop() || path;

/** `accepted`, or why not. */
const verdictOf = (run, frame) => run.frames.rejection[frame] || 'accepted';

const pairOf = (run, query) => query + '_' + run.frames.candidate[query];
const pictureOf = (run, query) => run.pictures[pairOf(run, query)];

/** The positions of all frames on the best trajectory that there is. */
const bestTrajectory = run => run.trajectories.optimized || run.trajectories.input || [];

function captionOf(run, query) {
  const f = run.frames;
  const verdict = f.rejection[query] ? `, ${words(f.rejection[query])}` : '';
  return `frame ${query} and frame ${f.candidate[query]}: ${number(f.inliers[query])} inliers of `
    + `${number(f.matches[query])} matches, support ${number(f.support[query], 3)}, similarity `
    + `${number(f.similarity[query], 3)}${verdict}`;
}

function showInFullSize(image) {
  const dialog = element('dialog', {class: 'full', 'aria-label': image.alt, onclick: () => dialog.close()},
                         element('img', {src: image.src, alt: image.alt}));
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

/** A picture that a click, or the enter key, shows in full size. */
const pictureButton = image => element('button', {type: 'button', class: 'picture', title: 'show in full size',
                                                  onclick: () => showInFullSize(image)}, image);

/** The match picture of a pair; where there is one in 3D too, a button changes between them. */
function pictureElement(run, query) {
  const key = pairOf(run, query);
  if (!run.pictures[key]) return element('div', {class: 'empty'}, 'no picture of this pair was drawn');
  const image = element('img', {src: run.pictures[key], alt: 'match picture of ' + captionOf(run, query), loading: 'lazy'});
  if (!run.pictures_3d[key]) return pictureButton(image);
  const button = element('button', {type: 'button', class: 'turn', 'aria-pressed': 'false', onclick: () => {
    const standing = button.getAttribute('aria-pressed') === 'false';
    button.setAttribute('aria-pressed', String(standing));
    image.src = (standing ? run.pictures_3d : run.pictures)[key];
    image.alt = (standing ? 'the pair in 3D, ' : 'match picture of ') + captionOf(run, query);
  }}, 'in 3D');
  return element('div', {class: 'views'}, pictureButton(image), button);
}

function figureOf(run, query, onclose = null) {
  const caption = element('figcaption', {}, captionOf(run, query));
  if (onclose) caption.prepend(element('button', {type: 'button', onclick: onclose}, 'close'));
  return element('figure', {}, pictureElement(run, query), caption);
}

/** A dozen at a time: the button shows the next ones. */
function fillGallery(panel, figures, reason) {
  const atOnce = 12;
  if (!figures.length) return say(panel, reason);
  panel.append(...figures.slice(0, atOnce).map(make => make()));
  const rest = figures.slice(atOnce);
  if (!rest.length) return;
  const more = element('button', {type: 'button', class: 'more', onclick: () => {
    more.remove();
    fillGallery(panel, rest, reason);
  }}, `show more (${rest.length})`);
  panel.append(more);
}
