// SPDX-License-Identifier: BSD-3-Clause
// Fills report.html from the JSON that fild::write_report() puts into it.
'use strict';

const run = JSON.parse(document.getElementById('data').textContent);
const frameCount = run.frames.timestamp.length;

// ---- Small things -----------------------------------------------------------------------------

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
const share = value => known(value) ? number(value, 3) : '-';
const bytes = value => value >= 1e9 ? number(value / 1e9, 2) + ' GB' : number(value / 1e6, 1) + ' MB';
const words = name => name.replaceAll('_', ' ');

/** Seconds since the first frame. */
const secondsOf = frame => run.frames.timestamp[frame] - run.frames.timestamp[0];

function clock(seconds) {
  const whole = Math.round(seconds);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h > 0 ? `${h} h ${m} min` : m > 0 ? `${m} min ${s} s` : `${s} s`;
}

/** Says in a panel why there is nothing in it. */
function say(panel, ...reason) {
  panel.replaceChildren(element('div', {class: 'empty'}, ...reason));
  panel.style.height = panel.style.aspectRatio = 'auto';
}

// ---- Charts -----------------------------------------------------------------------------------

// Okabe and Ito: the colour-blind can tell them apart. Viridis for amounts.
const palette = ['#0072b2', '#e69f00', '#009e73', '#d55e00', '#cc79a7', '#56b4e9', '#b8a800', '#7f7f7f'];
const viridis = ['#440154', '#3b528b', '#21918c', '#5ec962', '#fde725'];
const drawings = [];

const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

/** Draws a chart, again whenever light changes to dark. `options` is called each time. */
function draw(id, options, prepare = () => {}) {
  const panel = byId(id);
  const chart = echarts.init(panel, null, {renderer: 'canvas'});
  const redraw = () => chart.setOption(withDefaults(options(chart)), true);
  drawings.push({chart, redraw});
  redraw();
  prepare(chart);
  return chart;
}

function withDefaults(options) {
  const text = {color: colour('faint'), fontSize: 13};
  const axis = {
    axisLabel: {...text, hideOverlap: true},
    axisLine: {lineStyle: {color: colour('line')}},
    nameTextStyle: text,
    splitLine: {lineStyle: {color: colour('line'), opacity: 0.6}},
  };
  const styled = axes => [].concat(axes || []).map(one => ({...axis, ...one}));
  return {
    animation: false,
    color: palette,
    aria: {enabled: true},
    textStyle: {fontFamily: getComputedStyle(document.body).fontFamily, fontSize: 13, color: colour('ink')},
    ...options,
    ...(options.xAxis ? {xAxis: styled(options.xAxis), yAxis: styled(options.yAxis)} : {}),
    tooltip: {
      backgroundColor: colour('page'),
      borderColor: colour('line'),
      textStyle: {color: colour('ink')},
      confine: true,
      ...options.tooltip,
    },
    legend: options.legend
      ? {textStyle: {color: colour('ink'), fontSize: 13}, type: 'scroll', top: 0, itemWidth: 14, itemHeight: 10, ...options.legend} : undefined,
  };
}

const frameAxis = {type: 'value', name: 'frame', nameLocation: 'middle', nameGap: 26, min: 0,
                   max: Math.max(1, frameCount - 1), splitLine: {show: false}};
const plotGrid = {left: 64, right: 24, top: 44, bottom: 48};
const zoom = [{type: 'inside', xAxisIndex: 0, filterMode: 'none'}];

window.addEventListener('resize', () => drawings.forEach(({chart}) => chart.resize()));
matchMedia('(prefers-color-scheme: dark)')
  .addEventListener('change', () => drawings.forEach(({redraw}) => redraw()));

// ---- Headline ---------------------------------------------------------------------------------

function card(value, what, hint = '') {
  return element('div', {class: 'card', title: hint}, element('b', {}, value), element('span', {}, what));
}

function fillHeadline() {
  const summary = run.summary;
  const name = summary.rawlog.split('/').pop();
  document.title = name + ' - mrpt-fild';
  byId('title').textContent = name;
  byId('subtitle').textContent = summary.rawlog + (frameCount > 0
    ? `, ${number(frameCount)} camera frames in ${clock(secondsOf(frameCount - 1))}` : '');
  const cards = [
    card(number(frameCount), 'camera frames'),
    card(number(run.loops.length), 'loop closures', 'frames that were recognised as a return'),
  ];
  if (run.evaluation) {
    cards.push(card(share(run.evaluation.precision), 'precision', 'right / (right + wrong)'),
               card(share(run.evaluation.recall), 'recall', 'right / frames with a true loop'));
  }
  const errors = run.evaluation || {};
  if (known(errors.ate_input_m))
    cards.push(card(number(errors.ate_input_m, 2) + ' m', 'trajectory error before',
                    'ATE: RMSE of the positions after alignment with the truth'));
  if (known(errors.ate_optimized_m))
    cards.push(card(number(errors.ate_optimized_m, 2) + ' m', 'trajectory error after',
                    'ATE: RMSE of the positions after alignment with the truth'));
  const whole = (summary.stage_times_ms || {}).whole_frame;
  if (whole) cards.push(card(number(whole.mean, 0) + ' ms', 'a frame, on average'));
  cards.push(card(bytes(summary.memory.peak_bytes), 'memory at most'));
  byId('headline').append(...cards);
  for (const remark of run.remarks)
    byId('remarks').append(element('p', {class: 'note'}, remark));
}

// ---- Pictures of loop closures ----------------------------------------------------------------

const pictureOf = (query, candidate) => run.pictures[query + '_' + candidate];

function captionOf(query) {
  const f = run.frames;
  return `frame ${query} at frame ${f.candidate[query]}: ${number(f.inliers[query])} inliers of `
    + `${number(f.matches[query])} matches, support ${number(f.support[query], 2)}, similarity `
    + `${number(f.similarity[query], 3)}`;
}

function figureOf(query, onclose = null) {
  const picture = pictureOf(query, run.frames.candidate[query]);
  const caption = element('figcaption', {}, captionOf(query));
  if (onclose) caption.prepend(element('button', {onclick: onclose, 'aria-label': 'close'}, 'close'));
  const image = picture
    ? element('img', {src: picture, alt: 'match picture of ' + captionOf(query), loading: 'lazy'})
    : element('div', {class: 'empty'}, 'no picture of this pair was drawn');
  return element('figure', {}, image, caption);
}

function pin(query) {
  const panel = byId('pinned');
  const name = 'pinned-' + query;
  if (byId(name)) return byId(name).scrollIntoView({block: 'nearest'});
  const figure = figureOf(query, () => figure.remove());
  figure.id = name;
  panel.prepend(figure);
}

function fillGalleries() {
  const f = run.frames;
  const withPicture = query => pictureOf(query, f.candidate[query]);
  const accepted = run.loops.map(loop => loop.query);
  const weakest = [...accepted].filter(withPicture)
    .sort((a, b) => f.support[a] - f.support[b]).slice(0, 2);
  const rejected = f.rejection.map((reason, frame) => frame)
    .filter(frame => f.rejection[frame] && known(f.candidate[frame]) && withPicture(frame))
    .sort((a, b) => f.support[b] - f.support[a]).slice(0, 2);
  fillGallery('weakest', weakest,
              accepted.length ? 'no pictures were drawn: [render] max_match_pictures = 0' : 'no loop closure');
  fillGallery('strongest-rejected', rejected, 'no rejected pair came far enough for a picture');
  const drawn = accepted.filter(withPicture);
  byId('gallery-hint').textContent = drawn.length < accepted.length
    ? `${drawn.length} of ${accepted.length} loop closures have a picture here; [render] max_match_pictures and `
      + '[report] max_pictures say how many.' : '';
  fillGallery('gallery', drawn, accepted.length ? 'no pictures were drawn: [render] max_match_pictures = 0'
    : 'no loop closure, so no pictures');
}

/** A dozen at a time: the button shows the next ones. */
function fillGallery(id, queries, reason) {
  const atOnce = 12;
  const panel = byId(id);
  if (!queries.length) return say(panel, reason);
  panel.append(...queries.slice(0, atOnce).map(query => figureOf(query)));
  const rest = queries.slice(atOnce);
  if (!rest.length) return;
  const more = element('button', {type: 'button', onclick: () => {
    more.remove();
    fillGallery(id, rest, reason);
  }}, `show more (${rest.length})`);
  panel.append(more);
}

// ---- Map --------------------------------------------------------------------------------------

function fillMap() {
  const pictures = Object.entries(run.map_pictures);
  for (const [title, picture] of pictures)
    byId('map-pictures').append(
      element('figure', {}, element('img', {src: picture, alt: 'map, ' + title}), element('figcaption', {}, title)));
  if (!pictures.length) say(byId('map-pictures'), 'no map pictures were drawn');
  const any = ['input', 'optimized', 'truth'].some(name => (run.trajectories[name] || []).length > 1);
  if (!any) return say(byId('map-chart'), run.no_map_reason);
  drawMap();
}

const trajectoryStyles = {
  truth: {name: 'ground truth', colour: 'faint', type: 'dotted'},
  input: {name: 'before optimisation', fixed: '#d55e00', type: 'dashed'},
  optimized: {name: 'after optimisation', fixed: '#0072b2', type: 'solid'},
};

/** Where each frame is on the best trajectory that has it. */
function positionsOfFrames() {
  const best = (run.trajectories.optimized || []).length ? 'optimized' : 'input';
  const positions = new Map();
  for (const [x, y, , frame] of run.trajectories[best] || []) if (known(frame)) positions.set(frame, [x, y]);
  return positions;
}

/** Ranges of both axes so that a metre is as long in x as in y. */
function equalRanges(chart) {
  const points = Object.values(run.trajectories).flat();
  const xs = points.map(p => p[0]), ys = points.map(p => p[1]);
  const least = list => list.reduce((a, b) => Math.min(a, b), Infinity);
  const most = list => list.reduce((a, b) => Math.max(a, b), -Infinity);
  const [x0, x1, y0, y1] = [least(xs), most(xs), least(ys), most(ys)];
  const width = Math.max(50, chart.getWidth() - 90), height = Math.max(50, chart.getHeight() - 110);
  const scale = 1.06 * Math.max((x1 - x0) / width, (y1 - y0) / height, 1e-3);
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  return {x: [cx - scale * width / 2, cx + scale * width / 2], y: [cy - scale * height / 2, cy + scale * height / 2]};
}

function loopTooltip(query) {
  const picture = pictureOf(query, run.frames.candidate[query]);
  const image = picture ? `<img alt="" src="${picture}" style="width:min(420px,70vw);display:block">` : '';
  return `<div class="edge-tooltip">${image}<div>${captionOf(query).replace(', support', '<br>support')}</div></div>`;
}

function mapSeries() {
  const positions = positionsOfFrames();
  const series = [];
  for (const [name, style] of Object.entries(trajectoryStyles)) {
    const points = run.trajectories[name] || [];
    if (points.length < 2) continue;
    series.push({name: style.name, type: 'line', data: points.map(p => [p[0], p[1]]), showSymbol: false, silent: true,
                 lineStyle: {color: style.fixed || colour(style.colour), type: style.type, width: 2},
                 itemStyle: {color: style.fixed || colour(style.colour)}, z: 2});
  }
  const edges = run.loops.filter(loop => positions.has(loop.query) && positions.has(loop.candidate));
  const most = edges.reduce((m, loop) => Math.max(m, loop.inliers), 1);
  series.push({
    name: 'loop closures', type: 'lines', coordinateSystem: 'cartesian2d', z: 3, itemStyle: {color: viridis[2]},
    data: edges.map(loop => ({
      coords: [positions.get(loop.candidate), positions.get(loop.query)], query: loop.query,
      lineStyle: {color: viridisAt(loop.inliers / most), width: 3, opacity: loop.weight === 0 ? 0.25 : 0.9,
                  type: loop.weight === 0 ? 'dotted' : 'solid'},
    })),
    emphasis: {lineStyle: {width: 6}},
    tooltip: {formatter: item => loopTooltip(item.data.query)},
  });
  // A loop edge is short when the map is right: its query is marked too, so that it can be pointed at.
  series.push({
    name: 'loop closures', type: 'scatter', symbolSize: 9, z: 4,
    data: edges.map(loop => ({value: positions.get(loop.query), query: loop.query,
                              itemStyle: {color: viridisAt(loop.inliers / most)}})),
    tooltip: {formatter: item => loopTooltip(item.data.query)},
  });
  const path = run.trajectories.optimized?.length ? run.trajectories.optimized : run.trajectories.input;
  if (path?.length) series.push({
    name: 'start and end', type: 'scatter', z: 5, itemStyle: {color: colour('ink')}, silent: true, symbolSize: 13,
    data: [{value: path[0].slice(0, 2), symbol: 'circle', label: {show: true, formatter: 'start', position: 'top',
                                                                  color: colour('ink')}},
           {value: path[path.length - 1].slice(0, 2), symbol: 'rect',
            label: {show: true, formatter: 'end', position: 'bottom', color: colour('ink')}}],
  });
  return series;
}

function viridisAt(part) {
  const at = Math.min(0.9999, Math.max(0, part)) * (viridis.length - 1);
  return echarts.color.lerp(at - Math.floor(at), [viridis[Math.floor(at)], viridis[Math.floor(at) + 1]]);
}

function drawMap() {
  const chart = draw('map-chart', drawn => {
    const ranges = equalRanges(drawn);
    const metres = {type: 'value', nameLocation: 'middle', splitLine: {show: true}};
    return {
      grid: {left: 60, right: 30, top: 50, bottom: 60},
      legend: {},
      tooltip: {trigger: 'item'},
      xAxis: {...metres, name: 'x, m', nameGap: 28, min: ranges.x[0], max: ranges.x[1], axisLabel: roundLabels},
      yAxis: {...metres, name: 'y, m', nameGap: 42, min: ranges.y[0], max: ranges.y[1], axisLabel: roundLabels},
      dataZoom: [{type: 'inside', xAxisIndex: 0, filterMode: 'none'}, {type: 'inside', yAxisIndex: 0, filterMode: 'none'}],
      series: mapSeries(),
    };
  });
  chart.on('click', item => { if (known(item.data?.query)) pin(item.data.query); });
  window.addEventListener('resize', () => {
    const ranges = equalRanges(chart);
    chart.setOption({xAxis: {min: ranges.x[0], max: ranges.x[1]}, yAxis: {min: ranges.y[0], max: ranges.y[1]}});
  });
}

const roundLabels = {showMinLabel: false, showMaxLabel: false, formatter: value => number(value, 0)};

// ---- Verdicts ---------------------------------------------------------------------------------

const verdictOf = frame => run.frames.rejection[frame] || 'accepted';

/** Points of a column over frames: those of accepted and of rejected frames. */
function acceptedAndRejected(column) {
  const all = run.frames[column].map((value, frame) => ({value: [frame, value], frame}))
    .filter(({value, frame}) => known(value[1]) && known(run.frames.candidate[frame]));
  const series = (name, fill, symbol, wanted) => ({
    name, type: 'scatter', symbol, symbolSize: 5, itemStyle: {color: fill}, large: frameCount > 20000,
    data: all.filter(({frame}) => (verdictOf(frame) === 'accepted') === wanted),
  });
  return [series('rejected', '#e69f00', 'triangle', false), series('accepted', '#0072b2', 'circle', true)];
}

function drawOverFrames(id, column, title, threshold, digits) {
  if (!run.frames[column].some((value, frame) => known(value) && known(run.frames.candidate[frame])))
    return say(byId(id), `${title}: no frame had a candidate`);
  const line = threshold && {
    silent: true, symbol: 'none', data: [{yAxis: threshold.value}],
    lineStyle: {color: '#d55e00', type: 'dashed'},
    label: {formatter: threshold.name, position: 'insideEndTop', color: colour('ink')},
  };
  const chart = draw(id, () => {
    const series = acceptedAndRejected(column);
    if (line) series[0].markLine = line;
    return {
      grid: plotGrid, legend: {}, dataZoom: zoom,
      tooltip: {formatter: item => item.data.frame === undefined ? '' : `${captionOf(item.data.frame)}<br>${
        words(verdictOf(item.data.frame))}`},
      xAxis: frameAxis,
      yAxis: {type: 'value', name: title, axisLabel: {formatter: value => number(value, digits)},
              max: threshold ? extent => extent.max > threshold.value * 1.1 ? null : threshold.value * 1.1 : null},
      series,
    };
  });
  chart.on('click', item => { if (known(item.data?.frame)) showFrame(item.data.frame); });
}

function drawVerdictCharts() {
  const option = (section, key) => Number((run.summary.options[section] || {})[key]);
  const inliers = option('verification', 'min_inliers');
  drawOverFrames('inliers-chart', 'inliers', 'inliers', inliers > 0 && {value: inliers, name: 'min_inliers'}, 0);
  drawOverFrames('support-chart', 'support', 'support', {value: 1, name: 'accepted from 1 on'}, 1);
  const similarity = option('index', 'min_similarity');
  drawOverFrames('similarity-chart', 'similarity', 'similarity',
                 similarity > -1 && {value: similarity, name: 'min_similarity'}, 1);
  const counts = new Map();
  for (let frame = 0; frame < frameCount; ++frame)
    counts.set(verdictOf(frame), (counts.get(verdictOf(frame)) || 0) + 1);
  const sorted = [...counts].sort((a, b) => a[1] - b[1]);
  if (!sorted.length) return say(byId('reasons-chart'), 'no frames');
  byId('reasons-chart').style.height = 60 + 34 * sorted.length + 'px';
  draw('reasons-chart', () => ({
    grid: {left: 8, right: 60, top: 8, bottom: 28, containLabel: true},
    tooltip: {trigger: 'item'},
    xAxis: {type: 'value', minInterval: 1},
    yAxis: {type: 'category', data: sorted.map(([name]) => words(name)), axisLabel: {color: colour('ink')}},
    series: [{type: 'bar', name: 'frames', barMaxWidth: 26,
              data: sorted.map(([name, count]) => ({value: count, itemStyle: {
                color: name === 'accepted' ? '#0072b2' : '#e69f00'}})),
              label: {show: true, position: 'right', color: colour('ink')}}],
  })).on('click', item => { byId('filter-verdict').value = sorted[item.dataIndex][0]; showPage(0); });
}

const columns = [
  ['frame', frame => number(frame)],
  ['time, s', frame => number(secondsOf(frame), 2)],
  ['camera', frame => run.frames.sensors[run.frames.sensor[frame]], 'text'],
  ['keypoints', frame => number(run.frames.keypoints[frame])],
  ['candidate', frame => number(run.frames.candidate[frame])],
  ['similarity', frame => number(run.frames.similarity[frame], 3)],
  ['matches', frame => number(run.frames.matches[frame])],
  ['inliers', frame => number(run.frames.inliers[frame])],
  ['support', frame => number(run.frames.support[frame], 2)],
  ['verdict', frame => words(verdictOf(frame)), 'text'],
];
const rowsPerPage = 50;
let page = 0;

/** The frames that the filter lets through. */
function filteredFrames() {
  const verdict = byId('filter-verdict').value;
  const text = byId('filter-frame').value.trim();
  const range = text.match(/^(\d+)(?:\s*-\s*(\d+))?$/);
  const inRange = frame => {
    if (!range) return text === '';
    const [first, last] = [Number(range[1]), Number(range[2] ?? range[1])];
    const candidate = run.frames.candidate[frame];
    return (frame >= first && frame <= last) || (!range[2] && candidate === first);
  };
  return Array.from({length: frameCount}, (_, frame) => frame)
    .filter(frame => (!verdict || verdictOf(frame) === verdict) && inRange(frame));
}

function showPage(wanted) {
  const frames = filteredFrames();
  const pages = Math.max(1, Math.ceil(frames.length / rowsPerPage));
  page = Math.min(Math.max(0, wanted), pages - 1);
  const head = element('tr', {}, ...columns.map(([name, , kind]) => element('th', {class: kind || ''}, name)));
  const rows = frames.slice(page * rowsPerPage, (page + 1) * rowsPerPage).map(frame =>
    element('tr', {}, ...columns.map(([, value, kind]) => element('td', {class: kind || ''}, value(frame)))));
  byId('frames').replaceChildren(element('thead', {}, head), element('tbody', {}, ...rows));
  byId('filter-count').textContent = `${number(frames.length)} of ${number(frameCount)} frames`;
  byId('pager').replaceChildren(
    element('button', {type: 'button', onclick: () => showPage(page - 1)}, 'back'),
    element('span', {}, `page ${page + 1} of ${pages}`),
    element('button', {type: 'button', onclick: () => showPage(page + 1)}, 'on'));
}

function showFrame(frame) {
  byId('filter-verdict').value = '';
  byId('filter-frame').value = String(frame);
  showPage(0);
  byId('filter').scrollIntoView({block: 'nearest'});
}

function fillTable() {
  const verdicts = [...new Set(Array.from({length: frameCount}, (_, frame) => verdictOf(frame)))].sort();
  byId('filter-verdict').append(element('option', {value: ''}, 'all'),
                                ...verdicts.map(name => element('option', {value: name}, words(name))));
  byId('filter').addEventListener('input', () => showPage(0));
  byId('filter').addEventListener('submit', event => event.preventDefault());
  showPage(0);
}

// ---- Similarity matrix ------------------------------------------------------------------------

function drawMatrix() {
  if (!run.similarity) return say(byId('matrix-chart'), 'this run has no similarity.png: no frame could be used, or '
    + '[report] similarity_frames = 0');
  const image = new Image();
  image.src = run.similarity;
  image.decode().then(() => draw('matrix-chart', () => ({
    grid: {left: 64, right: 20, top: 40, bottom: 48},
    legend: {},
    tooltip: {formatter: item => known(item.data.query) ? captionOf(item.data.query) : ''},
    xAxis: {...frameAxis, name: 'earlier frame', max: frameCount},
    yAxis: {...frameAxis, name: 'frame', nameGap: 44, max: frameCount, inverse: true},
    series: [
      {type: 'custom', name: 'similarity', silent: true, data: [0], itemStyle: {color: '#21918c'},
       renderItem: (parameters, api) => {
         const [x0, y0] = api.coord([0, 0]);
         const [x1, y1] = api.coord([frameCount, frameCount]);
         return {type: 'image', style: {image, x: x0, y: y0, width: x1 - x0, height: y1 - y0}};
       }},
      {type: 'scatter', name: 'accepted loop closures', symbol: 'circle', symbolSize: 6, z: 3,
       itemStyle: {color: 'transparent', borderColor: '#d55e00', borderWidth: 1.5},
       data: run.loops.map(loop => ({value: [loop.candidate, loop.query], query: loop.query}))},
    ],
  })).on('click', item => { if (known(item.data?.query)) showFrame(item.data.query); }));
}

// ---- Time and memory --------------------------------------------------------------------------

/** Stages that are parts of a frame, in the order of the pipeline. */
const frameStages = ['image_decoding', 'global_descriptor', 'local_features', 'hashing', 'depth', 'index_insertion',
                     'index_search', 'matching', 'verification', 'relative_pose'];

function fillTime() {
  const times = run.summary.stage_times_ms || {};
  if (!Object.keys(times).length) {
    for (const id of ['stages-chart', 'stages', 'costs-chart', 'memory-chart']) say(byId(id), 'no times were taken');
    return;
  }
  const stages = frameStages.filter(name => times[name]);
  const perFrame = name => times[name].total / Math.max(1, frameCount);
  draw('stages-chart', () => ({
    grid: {left: 12, right: 24, top: 60, bottom: 44},
    legend: {}, tooltip: {trigger: 'item', valueFormatter: value => number(value, 2) + ' ms'},
    xAxis: {type: 'value', name: 'ms a frame, on average', nameLocation: 'middle', nameGap: 26},
    yAxis: {type: 'category', data: [''], axisTick: {show: false}},
    series: stages.map(name => ({name: words(name), type: 'bar', stack: 'all', data: [perFrame(name)], barMaxWidth: 60})),
  }));
  const cells = (name, digits = 2) => [words(name), number(times[name].calls),
    ...['mean', 'median', 'p95', 'max'].map(key => number(times[name][key], digits)), number(times[name].total / 1000, 1)];
  const heads = ['stage', 'calls', 'mean, ms', 'median, ms', '95 % below, ms', 'longest, ms', 'together, s'];
  const names = [...stages, ...Object.keys(times).filter(name => !stages.includes(name))];
  byId('stages').append(
    element('thead', {}, element('tr', {}, ...heads.map((head, i) => element('th', {class: i ? '' : 'text'}, head)))),
    element('tbody', {}, ...names.map(name => element('tr', {}, ...cells(name).map((cell, i) =>
      element('td', {class: i ? '' : 'text'}, cell))))));
  drawCosts();
}

function drawCosts() {
  const costs = run.costs;
  if (!costs) {
    say(byId('costs-chart'), 'this run has no costs.csv');
    return say(byId('memory-chart'), 'this run has no costs.csv');
  }
  const stages = frameStages.filter(name => costs.ms[name]);
  const lines = (list, scale) => list.map((value, i) => [costs.frame[i], value === null ? null : value * scale]);
  draw('costs-chart', () => ({
    grid: plotGrid, legend: {}, dataZoom: zoom,
    tooltip: {trigger: 'axis', valueFormatter: value => number(value, 2) + ' ms'},
    xAxis: frameAxis, yAxis: {type: 'value', name: 'ms'},
    series: stages.map(name => ({name: words(name), type: 'line', stack: 'all', areaStyle: {opacity: 0.8}, showSymbol: false,
                                 lineStyle: {width: 0}, sampling: 'average', data: lines(costs.ms[name], 1)})),
  }));
  draw('memory-chart', () => ({
    grid: plotGrid, legend: {}, dataZoom: zoom,
    tooltip: {trigger: 'axis', valueFormatter: value => number(value, 1) + ' MB'},
    xAxis: frameAxis, yAxis: {type: 'value', name: 'MB'},
    series: [{name: 'process', type: 'line', showSymbol: false, data: lines(costs.resident_bytes, 1e-6)},
             {name: 'map of places', type: 'line', showSymbol: false, data: lines(costs.map_bytes, 1e-6)}],
  }));
}

// ---- Pose graph -------------------------------------------------------------------------------

function factsTable(facts) {
  return element('div', {class: 'scroll'}, element('table', {}, element('tbody', {}, ...facts.map(([name, value]) =>
    element('tr', {}, element('td', {class: 'text'}, name), element('td', {class: 'text'}, String(value)))))));
}

/** A nested object as rows "a b c | value". */
function flattened(object, prefix = '') {
  return Object.entries(object).flatMap(([key, value]) => {
    const name = (prefix ? prefix + ', ' : '') + words(key);
    if (value !== null && typeof value === 'object' && !Array.isArray(value)) return flattened(value, name);
    return [[name, Array.isArray(value) ? value.join(', ') : typeof value === 'number' && !Number.isInteger(value)
      ? number(value, 3) : known(value) ? value : '-']];
  });
}

function fillGraph() {
  const graph = run.summary.graph;
  if (!graph) {
    say(byId('graph-content'), run.no_map_reason);
    return say(byId('edges-chart'), 'no loop edges');
  }
  byId('graph-content').append(factsTable(flattened(graph)));
  const edges = run.loops.filter(loop => known(loop.weight) && loop.translation_sd_m !== undefined);
  if (!edges.length) return say(byId('edges-chart'), 'no loop closure became an edge of the graph');
  draw('edges-chart', () => ({
    grid: plotGrid, legend: {}, dataZoom: zoom,
    tooltip: {formatter: item => `${captionOf(item.data.query)}<br>standard deviation ${
      number(100 * item.data.value[1], 2)} cm, weight ${number(item.data.weight, 2)}`},
    xAxis: {...frameAxis, name: 'frame'}, yAxis: {type: 'value', name: 'standard deviation of the loop edge, m'},
    series: [['kept by the optimiser', '#0072b2', 'circle', loop => loop.weight > 0],
             ['without weight', '#d55e00', 'triangle', loop => loop.weight === 0]].map(([name, fill, symbol, wanted]) => ({
      name, type: 'scatter', symbol, symbolSize: 7, itemStyle: {color: fill},
      data: edges.filter(wanted).map(loop => ({value: [loop.query, loop.translation_sd_m], query: loop.query,
                                               weight: loop.weight}))})),
  }));
}

// ---- Configuration ----------------------------------------------------------------------------

function fillRun() {
  const summary = run.summary;
  const panel = byId('run-content');
  if (summary.command) panel.append(element('h3', {}, 'Command'), element('pre', {}, summary.command));
  panel.append(element('h3', {}, 'Versions and model'), factsTable([
    ...Object.entries(summary.versions), ['model', summary.model.file], ['SHA-256 of the model', summary.model.sha256],
    ['seed', (summary.options.runtime || {}).seed ?? '-']]));
  panel.append(element('h3', {}, 'Options in force'));
  for (const [section, options] of Object.entries(summary.options))
    panel.append(element('details', {}, element('summary', {}, '[' + section + ']'), factsTable(Object.entries(options))));
  byId('footer').textContent = `mrpt-fild ${summary.versions['mrpt-fild'] || ''}. Charts: Apache ECharts (Apache-2.0), `
    + 'in this file.';
}

fillHeadline();
fillMap();
fillGalleries();
drawVerdictCharts();
fillTable();
drawMatrix();
fillTime();
fillGraph();
fillRun();
