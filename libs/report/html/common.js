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

/** ECharts keeps each turn of the wheel over a chart that zooms, though it zooms with Ctrl alone. */
function leaveWheelToPage(panel) {
  for (const kind of ['wheel', 'mousewheel'])
    panel.addEventListener(kind, event => { if (!event.ctrlKey && !event.metaKey) event.stopPropagation(); },
                           {capture: true, passive: true});
}

/** Draws a chart, again whenever light changes to dark. `options` is called each time. */
function draw(id, options) {
  byId(id).setAttribute('role', 'img');  // ECharts adds the label
  leaveWheelToPage(byId(id));
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
    progressive: 0,  // paper and screenshots would have some of the points
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
// Wheel and finger scroll the page over charts and maps; with Ctrl the wheel zooms.
const zoomOf = axis => ({type: 'inside', ...axis, filterMode: 'none', zoomOnMouseWheel: 'ctrl', preventDefaultMouseMove: false});
const zoom = [zoomOf({xAxisIndex: 0})];
const mapZoom = [zoomOf({xAxisIndex: 0}), zoomOf({yAxisIndex: 0})];
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

/** Shows a part of the map that is `factor` times as large; 0: all of it. */
function zoomMap(chart, factor) {
  chart.getOption().dataZoom.forEach(({start, end}, dataZoomIndex) => {
    const half = factor ? Math.min(50, (end - start) / 2 * factor) : 50;
    const middle = Math.min(100 - half, Math.max(half, (start + end) / 2));
    chart.dispatchAction({type: 'dataZoom', dataZoomIndex, start: middle - half, end: middle + half});
  });
}

/** Buttons, for those who have neither Ctrl nor a second finger. */
function mapButtons(chart) {
  const button = (name, title, factor) => element('button', {type: 'button', title, 'aria-label': title, onclick: () => zoomMap(chart, factor)}, name);
  return element('div', {class: 'zoom'}, button('+', 'zoom in', 0.6), button('\u2212', 'zoom out', 1 / 0.6),
                 button('whole map', 'show the whole map', 0));
}

/** A map of these positions, drawn anew when the window changes. */
function drawMapOf(positions, makeSeries, options = {}) {
  const chart = draw('map-chart', drawn => {
    const series = makeSeries();
    return {grid: mapGrid, dataZoom: mapZoom, series, ...options, legend: {top: 10, itemWidth: 24, ...options.legend},
            ...mapAxes(drawn, positions, series)};
  });
  byId('map-chart').before(mapButtons(chart));
  // One finger scrolls the page until the map is zoomed: then it moves the map.
  chart.on('datazoom', () => byId('map-chart').classList.toggle('zoomed', chart.getOption().dataZoom.some(
    ({start, end}) => end - start < 99.9)));
  return chart;
}

const trajectoryLine = (name, run, positions, style) => ({
  name, type: 'line', data: run.shown.map(frame => positions[frame]).map(p => known(p) ? [p[0], p[1]] : ['-', '-']), showSymbol: false, silent: true, z: 2,
  lineStyle: {width: 2, ...style}, itemStyle: {color: style.color, opacity: 0}});  // no mark on its line in the legend

let drawnWidth = window.innerWidth;
window.addEventListener('resize', () => {
  if (window.innerWidth === drawnWidth) return;  // a phone's address bar comes and goes
  drawnWidth = window.innerWidth;
  drawings.forEach(({chart, redraw}) => { chart.resize(); redraw(); });
});
matchMedia('(prefers-color-scheme: dark)')
  .addEventListener('change', () => drawings.forEach(({redraw}) => redraw()));

// Paper is narrower than the window, and nothing on it opens.
const paperWidth = 680;  // CSS pixels between the margins of A4
let openedForPaper = [];
window.addEventListener('beforeprint', () => {
  openedForPaper = [...document.querySelectorAll('main details:not([open])')];
  openedForPaper.forEach(one => one.open = true);
  drawings.forEach(({chart, redraw}) => {
    chart.resize({width: Math.min(paperWidth, chart.getWidth())});
    redraw();
  });
});
window.addEventListener('afterprint', () => {
  openedForPaper.forEach(one => one.open = false);
  drawings.forEach(({chart, redraw}) => { chart.resize({width: 'auto'}); redraw(); });
});

/** Stages that are parts of a frame, in the order of the pipeline. */
const frameStages = ['image_decoding', 'global_descriptor', 'local_features', 'hashing', 'depth', 'index_insertion',
                     'index_search', 'cells', 'matching', 'verification', 'evidence', 'relative_pose'];

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
    xAxis: {type: 'value', name: 'mean time per frame, ms', nameLocation: 'middle', nameGap: 26},
    yAxis: {type: 'category', data: bars.map(([name]) => name), axisTick: {show: false}, inverse: true},
    series: stages.map(stage => ({name: words(stage), type: 'bar', stack: 'all', barMaxWidth: 40, itemStyle: {color: stageColour(stage), borderColor: colour('page'), borderWidth: 0.5},
                                  data: bars.map(([, summary]) => mean(summary, stage))})),
  }));
}

// ---- Frames of a run --------------------------------------------------------------------------

const frameCountOf = run => run.frame_count;

/** A long recording's page holds some of its frames. Columns become arrays with gaps, so that a frame's
 *  number is its index; `shown` are the numbers. */
function prepare(run) {
  const {number: numbers, sensors, ...columns} = run.frames;
  run.shown = numbers || Array.from({length: run.frame_count}, (_, frame) => frame);
  if (!numbers) return;
  const spread = column => {
    const whole = new Array(run.frame_count);
    column.forEach((value, i) => whole[numbers[i]] = value);
    return whole;
  };
  const spreadAll = lists => Object.fromEntries(Object.entries(lists).map(([name, list]) => [name, list.length ? spread(list) : list]));
  run.frames = {sensors, ...spreadAll(columns)};
  run.trajectories = spreadAll(run.trajectories);
  if (run.truth) run.truth.judgement = spread(run.truth.judgement);
}

for (const run of data.runs || [data]) prepare(run);

/** How many loop closures the run has; the page may hold fewer. */
const loopCountOf = run => run.verdicts.accepted || 0;
const isWhole = run => run.shown.length === run.frame_count;
const baseName = path => path.split('/').filter(Boolean).pop() || path;

/** `accepted`, or why not. */
const verdictOf = (run, frame) => run.frames.rejection[frame] || 'accepted';

const pairOf = (run, query) => query + '_' + run.frames.candidate[query];
const pictureOf = (run, query) => run.pictures[pairOf(run, query)];

/** The positions of all frames on the best trajectory that there is. */
const bestTrajectory = run => run.trajectories.optimized || run.trajectories.input || [];

/** Text of an option in force; undefined in runs of versions without it. */
const optionOf = (run, section, key) => (run.summary.options[section] || {})[key];

/** The least support of a loop closure where support is a probability, else null. */
const minProbabilityOf = run => optionOf(run, 'same_place', 'enabled') === 'true'
  ? Number(optionOf(run, 'same_place', 'min_probability')) : null;

/** Not rounded over the threshold. */
function supportText(run, frame) {
  const support = run.frames.support[frame];
  const least = minProbabilityOf(run) ?? 1;
  const isBelow = support < least;
  return `${number(isBelow ? Math.floor(1000 * support) / 1000 : support, 3)} (${isBelow ? 'below' : 'needed'} ${least})`;
}

// ---- Ground truth -----------------------------------------------------------------------------

/** What the truth says of a loop closure, or of a frame without one. */
const truthKinds = {
  right: {colour: '#009e73', symbol: 'circle', meaning: 'a loop closure that the ground truth confirms'},
  wrong: {colour: '#dc1414', symbol: 'diamond', meaning: 'a loop closure that the ground truth contradicts'},
  doubtful: {colour: '#8a6bc8', symbol: 'rect', meaning: 'a loop closure of which the ground truth cannot tell; it counts for nothing'},
  missed: {colour: 'ink', symbol: 'circle', meaning: 'no loop closure, but the ground truth has one to find'},
};
const kindColour = kind => kind === 'missed' ? colour('ink') : truthKinds[kind].colour;

/** A missed loop is hollow; ECharts fills its own hollow marks with white, also in the dark. */
const markStyle = kind => kind === 'missed' ? {color: 'transparent', borderColor: kindColour(kind), borderWidth: 2}
  : {color: kindColour(kind)};

/** Of each loop query without a right loop closure: `place`, a frame that shows it, and `why`. */
const missedLoops = run => run.missed ??= new Map(((run.truth || {}).missed || []).map(lost => [lost.frame, lost]));

/** A key of truthKinds; null without truth, and of a frame that is rightly no loop closure. */
function kindOf(run, frame) {
  if (!run.truth || frame >= run.truth.judgement.length) return null;
  if (!run.frames.rejection[frame]) return run.truth.judgement[frame];
  return missedLoops(run).has(frame) ? 'missed' : null;
}

function missedText(run, frame) {
  const {place, why} = missedLoops(run).get(frame);
  return 'missed' + (known(place) ? `: frame ${place} shows its place` : '') + (why ? `; ${why}` : '');
}

/** Frames of a kind, in order. */
const framesOfKind = (run, kind) => run.shown.filter(frame => kindOf(run, frame) === kind);

const badge = kind => element('b', {class: 'kind ' + kind, title: truthKinds[kind].meaning}, kind);

function captionOf(run, query) {
  const f = run.frames;
  const verdict = f.rejection[query] ? `rejected: ${words(f.rejection[query])}` : 'loop closure';
  const missed = kindOf(run, query) === 'missed' ? `; ${missedText(run, query)}` : '';
  return `frame ${query} and frame ${f.candidate[query]}: ${verdict}, support ${supportText(run, query)}, `
    + `${number(f.inliers[query])} inliers of ${number(f.matches[query])} matches, similarity `
    + `${number(f.similarity[query], 3)}${missed}`;
}

/** The same for a tooltip, beginning with what the truth says. */
function tooltipOf(run, query) {
  const kind = kindOf(run, query);
  return (kind ? `<b>${kind}</b> ` : '') + (known(run.frames.candidate[query]) ? captionOf(run, query)
    : `frame ${query}: rejected: ${words(verdictOf(run, query))}` + (kind === 'missed' ? `; ${missedText(run, query)}` : ''));
}

// ---- Pictures in full size --------------------------------------------------------------------

/** Shows a picture pixel by pixel; the file beside the page, if there is one, has more of them. */
function showInFullSize(buttons, first) {
  const image = element('img', {});
  const caption = element('span', {class: 'caption', role: 'status'});
  let at = first;
  const show = to => {
    at = (to + buttons.length) % buttons.length;
    const shown = buttons[at].querySelector('img');
    image.src = shown.src;
    image.alt = shown.alt;
    const about = shown.dataset.caption || shown.alt;
    caption.textContent = about;
    if (!shown.dataset.file) return;
    const file = new Image();
    const isStillShown = () => buttons[at].querySelector('img') === shown;
    file.onload = () => { if (isStillShown()) image.src = file.src; };
    file.onerror = () => { if (isStillShown()) caption.textContent = `${about} (scaled down: ${shown.dataset.file} is not beside this page)`; };
    file.src = shown.dataset.file;
  };
  const button = (name, title, act) => element('button', {type: 'button', title, 'aria-label': title, onclick: act}, name);
  const turns = buttons.length > 1 ? [button('\u2190', 'previous picture', () => show(at - 1)),
                                      button('\u2192', 'next picture', () => show(at + 1))] : [];
  const dialog = element('dialog', {class: 'full', 'aria-label': 'picture in full size',
                                    onclick: event => { if (event.target === dialog) dialog.close(); }},
    element('div', {class: 'bar'}, caption, ...turns, button('close', 'close', () => dialog.close())),
    element('div', {class: 'pixels'}, image));
  dialog.addEventListener('keydown', event => {
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (step && buttons.length > 1) show(at + step);
  });
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  show(first);
  dialog.showModal();
}

/** A picture that a click, or the enter key, shows in full size; from there on to its neighbours. */
function pictureButton(image) {
  const button = element('button', {type: 'button', class: 'picture', title: 'show in full size', onclick: () => {
    const group = button.closest('.gallery, .pair, table') || button.parentElement;
    const buttons = [...group.querySelectorAll('.picture')];
    showInFullSize(buttons, buttons.indexOf(button));
  }}, image);
  return button;
}

/** The match picture of a pair; where there is one in 3D too, a button changes between them. */
function pictureElement(run, query) {
  const key = pairOf(run, query);
  if (!run.pictures[key]) return element('div', {class: 'empty'}, 'no picture of this pair was drawn');
  const kind = kindOf(run, query);
  const caption = (kind ? kind + ': ' : '') + captionOf(run, query);
  const image = element('img', {src: run.pictures[key], alt: 'match picture of ' + caption, loading: 'lazy', 'data-caption': caption});
  const fileOf = variant => run.has_matches_beside ? image.dataset.file = `matches/${key}${variant}.jpg` : '';
  fileOf('');
  if (!run.pictures_3d[key]) return pictureButton(image);
  const button = element('button', {type: 'button', class: 'turn', 'aria-pressed': 'false', onclick: () => {
    const standing = button.getAttribute('aria-pressed') === 'false';
    button.setAttribute('aria-pressed', String(standing));
    image.src = (standing ? run.pictures_3d : run.pictures)[key];
    image.alt = (standing ? 'the pair in 3D, ' : 'match picture of ') + caption;
    fileOf(standing ? '_3d' : '');
  }}, 'in 3D');
  return element('div', {class: 'views'}, pictureButton(image), button);
}

function figureOf(run, query, onclose = null) {
  const kind = kindOf(run, query);
  const caption = element('figcaption', {}, ...(kind ? [badge(kind), ' '] : []), captionOf(run, query));
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
