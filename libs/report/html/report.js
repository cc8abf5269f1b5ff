// SPDX-License-Identifier: BSD-3-Clause
// Fills report.html from the JSON that fild::write_html_report() puts into it.
const run = data;
const frameCount = frameCountOf(run);

/** Seconds since the first frame. */
const secondsOf = frame => run.frames.timestamp[frame] - run.frames.timestamp[0];

/** Text of an option in force; undefined in runs of versions without it. */
const optionOf = (section, key) => (run.summary.options[section] || {})[key];

/** The least support of a loop closure where support is a probability, else null. */
const minProbability = optionOf('same_place', 'enabled') === 'true'
  ? Number(optionOf('same_place', 'min_probability')) : null;
const supportMeaning = known(minProbability)
  ? 'the probability that the frame shows the place of its candidate; a loop closure needs at least '
    + `[same_place] min_probability = ${minProbability}`
  : 'inliers divided by [verification] min_inliers; verified from 1 up';

// ---- Headline ---------------------------------------------------------------------------------

const card = (value, what) => element('div', {class: 'card'}, element('b', {}, value), element('span', {}, what));

/** What the words on the cards mean, of those that are there. */
function headlineWords(errors) {
  const meanings = [['loop closure', 'a frame that was recognised as a return to a place seen before']];
  if (run.evaluation) meanings.push(
    ['precision', 'loop closures that are right, of those that are right or wrong'],
    ['recall', 'frames with a right loop closure, of those that have one to find']);
  if (known(errors.ate_input_m) || known(errors.ate_optimized_m)) meanings.push(
    ['absolute trajectory error (ATE)', 'root mean square distance of the positions from the true ones, after the best '
      + 'rotation and translation; before and after the loop closures were used']);
  return meanings;
}

function fillHeadline() {
  const summary = run.summary;
  const name = baseName(summary.rawlog);
  document.title = name + ' - mrpt-fild';
  byId('title').textContent = name;
  byId('subtitle').textContent = `${summary.rawlog}, ${counting(frameCount, 'camera frame')}`
    + (frameCount > 1 ? ` in ${clock(secondsOf(frameCount - 1))}` : '');
  const cards = [
    card(number(frameCount), plural(frameCount, 'camera frame')),
    card(number(run.loops.length), plural(run.loops.length, 'loop closure')),
  ];
  const errors = run.evaluation || {};
  if (run.evaluation) cards.push(card(share(errors.precision), 'precision'), card(share(errors.recall), 'recall'));
  if (known(errors.ate_input_m)) cards.push(card(metres(errors.ate_input_m), 'trajectory error (ATE) before'));
  if (known(errors.ate_optimized_m)) cards.push(card(metres(errors.ate_optimized_m), 'trajectory error (ATE) after'));
  const whole = (summary.stage_times_ms || {}).whole_frame;
  if (whole) cards.push(card(number(whole.mean, 0) + ' ms', 'a frame, on average'));
  cards.push(card(bytes(summary.memory.peak_bytes), 'memory at most'));
  byId('headline').append(...cards);
  byId('headline-words').append(explanation('What these numbers mean', headlineWords(errors)));
  for (const remark of run.remarks)
    byId('remarks').append(element('p', {class: 'note'}, remark));
}

// ---- Pictures of pairs ------------------------------------------------------------------------

function pin(query) {
  const name = 'pinned-' + query;
  if (byId(name)) return byId(name).scrollIntoView({block: 'nearest'});
  const figure = figureOf(run, query, () => figure.remove());
  figure.id = name;
  byId('pinned').prepend(figure);
}

function rejectedWithPicture() {
  const f = run.frames;
  return f.rejection.map((_, frame) => frame)
    .filter(frame => f.rejection[frame] && known(f.candidate[frame]) && pictureOf(run, frame))
    .sort((a, b) => f.support[b] - f.support[a]);
}

function fillGalleries() {
  const f = run.frames;
  const accepted = run.loops.map(loop => loop.query);
  const drawn = accepted.filter(query => pictureOf(run, query));
  const weakest = [...drawn].sort((a, b) => f.support[a] - f.support[b]).slice(0, 2);
  const figures = queries => queries.map(query => () => figureOf(run, query));
  byId('support-hint').textContent = `Support: ${supportMeaning}.`;
  const noPictures = accepted.length ? 'no pictures were drawn: [render] max_match_pictures or [report] max_pictures is 0'
    : 'no loop closure was found';
  fillGallery(byId('weakest'), figures(weakest), noPictures);
  const rejected = rejectedWithPicture();
  fillGallery(byId('strongest-rejected'), figures(rejected.slice(0, 2)),
              'no picture: no rejected pair came far enough, or [report] max_rejected_pictures is 0');
  byId('gallery-hint').textContent = drawn.length < accepted.length
    ? `${drawn.length} of ${accepted.length} loop closures have a picture here; [render] max_match_pictures and `
      + '[report] max_pictures say how many.' : '';
  fillGallery(byId('gallery'), figures(drawn), noPictures);
  const further = rejected.slice(2);
  if (!further.length) return byId('rejected-gallery').remove();
  byId('rejected-gallery').querySelector('summary').textContent = `Further rejected pairs (${further.length})`;
  fillGallery(byId('rejected-pictures'), figures(further), '');
}

// ---- Map --------------------------------------------------------------------------------------

function fillMap() {
  const pictures = Object.entries(run.map_pictures);
  for (const [title, picture] of pictures)
    byId('map-pictures').append(
      element('figure', {}, pictureButton(element('img', {src: picture, alt: 'map ' + title})), element('figcaption', {}, title)));
  const positions = Object.values(run.trajectories).flat().filter(known);
  if (!pictures.length && positions.length) say(byId('map-pictures'),
    'this run has no map_top.png and no map_perspective.png: [render] enabled or write_map_pictures is false, or they could not be drawn');
  if (!Object.values(run.trajectories).some(trajectory => trajectory.filter(known).length > 1)) {
    for (const id of ['map-title', 'map-hint', 'map-scale']) byId(id).remove();
    return say(byId('map-chart'), positions.length ? 'a single position makes no way to draw' : run.no_map_reason);
  }
  drawMapOf(positions, mapSeries, {legend: {selected: {[rejectedPairs]: false}}, tooltip: {trigger: 'item'}})
    .on('click', item => { if (known(item.data?.query)) pin(item.data.query); });
  fillMapScale();
}

/** What the colours of the loop closures say. */
function fillMapScale() {
  if (!run.loops.length) return;
  byId('map-scale').hidden = false;
  byId('map-fewest').textContent = 'loop closures: 0 inliers';
  byId('map-most').textContent = number(mostInliers);
  const paint = () => {
    const steps = [0, 0.25, 0.5, 0.75, 1].map(part => inlierColour(part * mostInliers));
    byId('map-scale').querySelector('i').style.background = `linear-gradient(to right, ${steps.join(', ')})`;
  };
  paint();
  isDark.addEventListener('change', paint);
}

const rejectedPairs = 'rejected pairs';
const mostInliers = run.loops.reduce((most, loop) => Math.max(most, loop.inliers), 1);
const isDark = matchMedia('(prefers-color-scheme: dark)');

/** Of viridis what stands out from the page: not yellow on white, nor violet on black. */
function inlierColour(inliers) {
  const [least, most] = isDark.matches ? [0.35, 1] : [0, 0.72];
  return viridisAt(least + (most - least) * inliers / mostInliers);
}

function loopTooltip(query) {
  const picture = pictureOf(run, query);
  const image = picture ? `<img alt="" src="${picture}" style="width:100%;display:block">` : '';
  return `<div class="edge-tooltip">${image}<div>${captionOf(run, query)}</div></div>`;
}

function mapSeries() {
  const lines = [['truth', 'ground truth', {color: mapColours.truth, width: 6}],
                 ['input', 'before the loops', {color: mapColours.input}],
                 ['optimized', 'optimised path', {color: colour('ink')}]];
  return [
    ...lines.filter(([name]) => run.trajectories[name])
      .map(([name, title, style]) => trajectoryLine(title, run.trajectories[name], style)),
    ...edgeSeries(rejectedPairs, rejectedWithPicture(), () => ({color: colour('faint'), width: 2, opacity: 0.6, type: 'dotted'})),
    ...loopSeries(), ...endSeries()];
}

/** Lines from candidate to query. One is short when the map is right: its query is marked too, so
 *  that it can be pointed at. */
function edgeSeries(name, queries, styleOf) {
  const at = bestTrajectory(run);
  const edges = queries.filter(query => known(at[query]) && known(at[run.frames.candidate[query]]));
  if (!edges.length) return [];
  const place = frame => at[frame].slice(0, 2);
  const tooltip = {formatter: item => loopTooltip(item.data.query)};
  const color = styleOf(edges[edges.length >> 1]).color;  // in the legend
  return [
    {name, type: 'lines', coordinateSystem: 'cartesian2d', z: 3, color, tooltip, emphasis: {lineStyle: {width: 6}},
     data: edges.map(query => ({query, coords: [place(run.frames.candidate[query]), place(query)], lineStyle: styleOf(query)}))},
    {name, type: 'scatter', symbolSize: (isFinger ? 4 : 0) + (edges.length > 100 ? 6 : 8), z: 4, color, tooltip,
     data: edges.map(query => ({query, value: place(query), itemStyle: {color: styleOf(query).color, opacity: styleOf(query).opacity}}))}];
}

function loopSeries() {
  const loops = new Map(run.loops.map(loop => [loop.query, loop]));
  return edgeSeries('loop closures', [...loops.keys()], query => {
    const {inliers, weight} = loops.get(query);
    return {color: inlierColour(inliers), width: 3, opacity: weight === 0 ? 0.3 : 0.9,
            type: weight === 0 ? 'dotted' : 'solid'};
  });
}

function endSeries() {
  const path = bestTrajectory(run).filter(known);
  if (path.length < 2) return [];
  const mark = (place, symbol, name, position) => ({
    value: place.slice(0, 2), symbol, itemStyle: {color: 'transparent', borderColor: mapColours[name], borderWidth: 2.5},
    label: {show: true, formatter: name, position, color: colour('ink'), textBorderColor: colour('page'), textBorderWidth: 3}});
  return [{name: 'start and end', type: 'scatter', z: 5, color: mapColours.start, silent: true, symbolSize: 12,
           data: [mark(path[0], 'circle', 'start', 'left'), mark(path[path.length - 1], 'rect', 'end', 'right')]}];
}

// ---- Verdicts ---------------------------------------------------------------------------------

/** Points of a column over frames: those of accepted and of rejected frames. */
function acceptedAndRejected(column) {
  const all = run.frames[column].map((value, frame) => ({value: [frame, value], frame}))
    .filter(({value, frame}) => known(value[1]) && known(run.frames.candidate[frame]));
  const series = (name, fill, symbol, wanted) => ({
    name, type: 'scatter', symbol, symbolSize: 5, itemStyle: {color: fill},
    data: all.filter(({frame}) => (verdictOf(run, frame) === 'accepted') === wanted),
  });
  return [series('rejected', '#e69f00', 'triangle', false), series('accepted', colour('accent'), 'circle', true)];
}

/** Of `threshold`: value, name and, for a column that has one, the greatest possible value, `most`. */
function drawOverFrames(id, column, title, threshold, digits) {
  if (!run.frames[column].some((value, frame) => known(value) && known(run.frames.candidate[frame])))
    return say(byId(id), `${title}: no frame had a candidate`);
  const line = () => ({
    silent: true, symbol: 'none', data: [{yAxis: threshold.value}],
    lineStyle: {color: '#d55e00', type: 'dashed'},
    label: {formatter: threshold.name, position: known(threshold.most) ? 'insideStartBottom' : 'insideStartTop',
            color: colour('ink'), textBorderColor: colour('page'), textBorderWidth: 3},
  });
  const room = extent => extent.max > threshold.value * 1.1 ? null : threshold.value * 1.1;
  const chart = draw(id, () => {
    const series = acceptedAndRejected(column);
    if (threshold) series[0].markLine = line();
    return {
      grid: plotGrid, legend: {}, dataZoom: zoom,
      tooltip: {formatter: item => known(item.data.frame) ? captionOf(run, item.data.frame) : ''},
      xAxis: frameAxis(frameCount),
      yAxis: {type: 'value', name: title, axisLabel: {formatter: atMost(digits)},
              max: threshold ? threshold.most ?? room : null},
      series,
    };
  });
  chart.on('click', item => { if (known(item.data?.frame)) showFrame(item.data.frame); });
}

function drawVerdictCharts() {
  const inliers = Number(optionOf('verification', 'min_inliers'));
  drawOverFrames('inliers-chart', 'inliers', 'inliers', inliers > 0 && {value: inliers, name: `min_inliers = ${inliers}`}, 0);
  drawOverFrames('support-chart', 'support', 'support',
                 known(minProbability) ? {value: minProbability, name: `min_probability = ${minProbability}`, most: 1}
                   : {value: 1, name: 'verified from 1 up'}, 1);
  const similarity = Number(optionOf('index', 'min_similarity'));
  drawOverFrames('similarity-chart', 'similarity', 'similarity',
                 similarity > -1 && {value: similarity, name: `min_similarity = ${similarity}`}, 1);
  drawReasons();
}

function drawReasons() {
  const counts = new Map();
  for (let frame = 0; frame < frameCount; ++frame)
    counts.set(verdictOf(run, frame), (counts.get(verdictOf(run, frame)) || 0) + 1);
  const sorted = [...counts].sort((a, b) => a[1] - b[1]);
  byId('reasons-chart').style.height = 66 + 34 * sorted.length + 'px';
  draw('reasons-chart', () => ({
    grid: {left: 16, right: 60, top: 8, bottom: 30, containLabel: true},
    tooltip: {trigger: 'item'},
    xAxis: {type: 'value', name: 'frames', nameLocation: 'middle', nameGap: 26, minInterval: 1},
    yAxis: {type: 'category', data: sorted.map(([name]) => words(name)), axisLabel: {color: colour('ink')}},
    series: [{type: 'bar', name: 'frames', barMaxWidth: 26,
              data: sorted.map(([name, count]) => ({value: count, itemStyle: {
                color: name === 'accepted' ? colour('accent') : '#e69f00'}})),
              label: {show: true, position: 'right', color: colour('ink')}}],
  })).on('click', item => { byId('filter-verdict').value = sorted[item.dataIndex][0]; showPage(0); });
  byId('verdict-words').append(explanation('What the verdicts mean', [...sorted].reverse()
    .map(([name]) => [words(name), verdictMeanings[name] || 'a word of another version of mrpt-fild'])));
}

/** The words of Rejection in verdict.h, for a reader. */
const verdictMeanings = {
  accepted: 'a loop closure: the frame shows the place that its candidate shows',
  missing_image: 'the image file is not there, or is no image; the frame is passed over',
  image_size_changed: 'cannot be scaled to the size of this camera\'s first image; the frame is passed over',
  repeated_timestamp: 'it has the time stamp and the image of this camera\'s frame before; the frame is passed over',
  unsupported_image: 'neither grey nor colour of 8 or 16 bit; the frame is passed over',
  too_early: 'no frame is old enough to be returned to: [index] delay_seconds',
  no_candidate: 'the search among earlier frames had no answer',
  below_similarity: 'no earlier frame is similar enough: [index] min_similarity',
  too_few_matches: 'fewer keypoints match than inliers are asked for',
  no_model: 'no motion of the camera explains the matches',
  too_few_inliers: 'too few matches agree with one motion of the camera: [verification] min_inliers',
  may_be_chance: 'the inliers may agree by chance: the probability is below [same_place] min_probability',
  may_be_look_alike: 'the two frames may show two places that look alike: the probability is below [same_place] '
    + 'min_probability',
  not_consistent_yet: 'the pair alone convinces, but the frames before it do not confirm it: [consistency] belief or '
    + 'consecutive_frames',
};

const ofCandidate = (column, digits) => frame => known(run.frames.candidate[frame]) ? number(run.frames[column][frame], digits) : '';
// What matters most first: on a phone the others are reached by scrolling.
const columns = [
  ['frame', frame => String(frame)],
  ['time, s', frame => number(secondsOf(frame), 2)],
  ['verdict', frame => words(verdictOf(run, frame)), 'text'],
  ['candidate', candidateCell],
  ['similarity', ofCandidate('similarity', 3)],
  ['matches', ofCandidate('matches', 0)],
  ['inliers', ofCandidate('inliers', 0)],
  ['support', ofCandidate('support', 3)],
  ['keypoints', frame => number(run.frames.keypoints[frame])],
  ['camera', frame => run.frames.sensors[run.frames.sensor[frame]], 'text'],
];
const columnMeanings = [
  ['candidate', 'the earlier frame with the best evidence; a button shows the picture of the pair'],
  ['similarity', 'of both images as a whole: cosine of their global descriptors, -1 to 1'],
  ['matches', 'keypoints of one image that were found in the other'],
  ['inliers', 'matches that agree with one motion of the camera'],
  ['support', supportMeaning],
  ['keypoints', 'distinctive points found in the image'],
];
const rowsPerPage = 25;
let page = 0;

/** The number of the candidate; where the pair has a picture, a button that shows it below the row. */
function candidateCell(frame) {
  const candidate = run.frames.candidate[frame];
  if (!known(candidate) || !pictureOf(run, frame)) return String(candidate ?? '');
  return element('button', {type: 'button', 'aria-expanded': 'false', 'aria-label':
    `${candidate}: picture of frame ${frame} and frame ${candidate}`, onclick: ({currentTarget}) => {
    const row = currentTarget.closest('tr');
    const isOpen = currentTarget.getAttribute('aria-expanded') === 'true';
    currentTarget.setAttribute('aria-expanded', String(!isOpen));
    if (isOpen) return row.nextElementSibling.remove();
    row.after(element('tr', {class: 'picture'}, element('td', {class: 'wide', colspan: columns.length}, figureOf(run, frame))));
  }}, String(candidate));
}

/** The frames that the filter lets through; none when a number is not one. */
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
    .filter(frame => (!verdict || verdictOf(run, frame) === verdict) && inRange(frame));
}

function showPage(wanted) {
  const frames = filteredFrames();
  const pages = Math.max(1, Math.ceil(frames.length / rowsPerPage));
  page = Math.min(Math.max(0, wanted), pages - 1);
  const head = element('tr', {}, ...columns.map(([name, , kind]) => element('th', {class: kind || ''}, name)));
  const rows = frames.slice(page * rowsPerPage, (page + 1) * rowsPerPage).map(frame =>
    element('tr', {'data-frame': frame}, ...columns.map(([, value, kind]) => element('td', {class: kind || ''}, value(frame)))));
  byId('frames').replaceChildren(element('thead', {}, head), element('tbody', {}, ...rows));
  byId('filter-count').textContent = `${number(frames.length)} of ${counting(frameCount, 'frame')}`;
  const turn = (name, to) => {
    const button = element('button', {type: 'button', onclick: () => showPage(to)}, name);
    button.disabled = to < 0 || to >= pages;
    return button;
  };
  byId('pager').replaceChildren(turn('previous', page - 1), element('span', {}, `page ${page + 1} of ${pages}`),
                                turn('next', page + 1));
}

function showFrame(frame) {
  byId('filter-verdict').value = '';
  byId('filter-frame').value = String(frame);
  showPage(0);
  byId('frames').querySelector(`tr[data-frame="${frame}"] button`)?.click();
  byId('filter').scrollIntoView({block: 'start'});
}

function fillTable() {
  const verdicts = [...new Set(Array.from({length: frameCount}, (_, frame) => verdictOf(run, frame)))].sort();
  byId('filter-verdict').append(element('option', {value: ''}, 'all'),
                                ...verdicts.map(name => element('option', {value: name}, words(name))));
  byId('filter').addEventListener('input', () => showPage(0));
  byId('filter').addEventListener('submit', event => event.preventDefault());
  byId('column-words').append(explanation('What the columns mean', columnMeanings));
  showPage(0);
}

// ---- Similarity matrix ------------------------------------------------------------------------

/** What similarity.png holds: cosines of row and column, 0 to 1. */
async function readSimilarities() {
  const image = new Image();
  image.src = run.similarity;
  await image.decode();
  const canvas = element('canvas', {width: image.width, height: image.height});
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(image, 0, 0);
  const pixels = context.getImageData(0, 0, image.width, image.height);
  const at = (row, column) => pixels.data[4 * (row * image.width + column)] / 255;
  return {canvas, context, pixels, side: image.width, at, framesPerRow: run.summary.frames.frames_per_similarity_row || 1};
}

/** Makes every pixel a square of several, so that the browser does not blur them. */
function enlarge(matrix) {
  const times = Math.ceil(1200 / matrix.side);
  const small = matrix.canvas;
  matrix.canvas = element('canvas', {width: times * matrix.side, height: times * matrix.side});
  const context = matrix.canvas.getContext('2d');
  context.imageSmoothingEnabled = false;
  context.drawImage(small, 0, 0, matrix.canvas.width, matrix.canvas.height);
}

/** Paints the matrix; the brightest 0.5 % are all of one colour. \return the value of that colour. */
function paintSimilarities(matrix) {
  const {pixels, side, at, context} = matrix;
  const values = [];
  for (let row = 0; row < side; ++row) for (let column = 0; column < row; ++column) values.push(at(row, column));
  values.sort((a, b) => a - b);
  const brightest = Math.max(0.05, values[Math.floor(0.995 * (values.length - 1))] || 0);
  const colours = Array.from({length: 256}, (_, grey) => echarts.color.parse(viridisAt(grey / 255 / brightest)));
  for (let row = 0; row < side; ++row)
    for (let column = 0; column < side; ++column) {
      const first = 4 * (row * side + column);
      const [red, green, blue] = colours[pixels.data[first]];
      pixels.data.set(column < row ? [red, green, blue, 255] : [0, 0, 0, 0], first);
    }
  context.putImageData(pixels, 0, 0);
  enlarge(matrix);
  return brightest;
}

// Above the diagonal, where the matrix has nothing: on it they would hide what they are to be compared with.
const mirroredLoops = 'accepted loop closures (mirrored)';

async function drawMatrix() {
  if (!run.similarity || frameCount < 2)
    return say(byId('matrix-chart'), frameCount < 2 ? 'a single frame is like no other'
      : 'this run has no similarity.png: no frame could be used, or [report] similarity_frames is 0');
  const matrix = await readSimilarities();
  const grey = Uint8ClampedArray.from(matrix.pixels.data);
  const brightest = paintSimilarities(matrix);
  const covered = matrix.side * matrix.framesPerRow;
  byId('matrix-scale').hidden = false;
  byId('matrix-brightest').textContent = `${number(brightest, 2)} or more`;
  const chart = draw('matrix-chart', () => ({
    grid: matrixGrid,
    legend: {data: [mirroredLoops]},
    tooltip: {formatter: item => known(item.data.query) ? captionOf(run, item.data.query) : ''},
    xAxis: {...frameAxis(frameCount), name: 'earlier frame', max: frameCount},
    yAxis: {...frameAxis(frameCount), name: 'frame', nameGap: 44, max: frameCount, inverse: true},
    series: [
      {type: 'custom', name: 'similarity', silent: true, data: [0],
       renderItem: (parameters, api) => {
         const [x0, y0] = api.coord([0, 0]);
         const [x1, y1] = api.coord([covered, covered]);
         return {type: 'image', style: {image: matrix.canvas, x: x0, y: y0, width: x1 - x0, height: y1 - y0}};
       }, clip: true},
      {type: 'scatter', name: mirroredLoops, symbolSize: run.loops.length > 100 ? 4 : 7, z: 3, itemStyle: {color: colour('accent')},
       data: run.loops.map(loop => ({value: [loop.query, loop.candidate], query: loop.query}))},
    ],
  }));
  chart.on('click', item => { if (known(item.data?.query)) showFrame(item.data.query); });
  chart.getZr().on('mousemove', ({offsetX, offsetY}) => {
    const [column, row] = chart.convertFromPixel('grid', [offsetX, offsetY]).map(v => Math.floor(v / matrix.framesPerRow));
    const inside = column >= 0 && column < row && row < matrix.side;
    byId('matrix-status').textContent = inside
      ? `frame ${row * matrix.framesPerRow} and frame ${column * matrix.framesPerRow}: ${
        number(grey[4 * (row * matrix.side + column)] / 255, 2)}` : '';
  });
}

// ---- Time and memory --------------------------------------------------------------------------

function fillTime() {
  const times = run.summary.stage_times_ms || {};
  if (times.whole_frame)
    byId('stages-hint').textContent = `A frame takes ${number(times.whole_frame.mean, 0)} ms on average; stages that run side `
      + 'by side count in full, so that their sum can be more.';
  drawStages('stages-chart', [['', run.summary]]);
  if (Object.keys(times).length) fillStages(times);
  drawCosts();
}

/** Stages of a frame, their sum, and what is done once. */
function fillStages(times) {
  const stages = [...frameStages, 'whole_frame'].filter(name => times[name]);
  byId('stages').append(...tableOf(
    ['stage', 'calls', 'mean of a call, ms', 'median, ms', '95 % are below, ms', 'longest, ms', 'in all, s'],
    [...stages, ...Object.keys(times).filter(name => !stages.includes(name))].map(name => [
      words(name), number(times[name].calls), ...['mean', 'median', 'p95', 'max'].map(key => number(times[name][key], 2)),
      number(times[name].total / 1000, 1)])));
  byId('stages').querySelectorAll('tbody tr')[stages.indexOf('whole_frame')]?.classList.add('sum');
}

function drawCosts() {
  const costs = run.costs;
  const missing = !costs ? 'this run has no costs.csv' : costs.frame.length < 2 ? 'a single frame makes no curve' : '';
  if (missing) {
    say(byId('costs-chart'), missing);
    return say(byId('memory-chart'), missing);
  }
  const step = costs.frame[1] - costs.frame[0];
  byId('costs-hint').textContent = step > 1 ? `One frame in ${step} is shown.` : '';
  const stages = frameStages.filter(name => (costs.ms[name] || []).some(value => value > 0));
  const points = (list, scale) => list.map((value, i) => [costs.frame[i], value === null ? null : value * scale]);
  const chart = (id, unit, digits, series) => draw(id, () => ({
    grid: plotGrid, legend: {icon: 'roundRect'}, dataZoom: zoom,
    tooltip: {trigger: 'axis', valueFormatter: value => number(value, digits) + ' ' + unit},
    xAxis: frameAxis(frameCount), yAxis: {type: 'value', name: unit},
    series: series().map(one => ({type: 'line', showSymbol: false, ...one})),
  }));
  byId('costs-chart').style.height = 260 + legendHeight(byId('costs-chart').clientWidth, stages.map(words)) + 'px';
  chart('costs-chart', 'ms', 2, () => stages.map(name => ({
    name: words(name), stack: 'all', areaStyle: {opacity: 0.85}, lineStyle: {width: 0}, color: stageColour(name),
    data: points(costs.ms[name], 1)})));
  chart('memory-chart', 'MB', 1, () => [
    {name: 'memory of the process', data: points(costs.resident_bytes, 1e-6)},
    {name: 'held to recognise places', data: points(costs.map_bytes, 1e-6)}]);
}

// ---- Pose graph -------------------------------------------------------------------------------

/** `{a: 3, b: 1, c: 0}` as "3 a, 1 b". */
const counted = counts => Object.entries(counts || {}).filter(([, count]) => count)
  .map(([word, count]) => `${number(count)} ${words(word)}`).join(', ') || 'none';

function graphFacts(map) {
  const parts = map.parts || [];
  const {none, ...sources} = map.depth_sources || {};
  return [
    ['trajectory before', map.trajectory_source ? `${map.trajectory}: ${map.trajectory_source}` : map.trajectory],
    ['keyframes', number(map.nodes)],
    ['edges of the motion', number(map.odometry_edges)],
    ['loop edges', number(map.loop_edges)],
    ['loop edges without weight: the optimiser does not believe them', counted(map.loops_without_weight)],
    ['loop closures without an edge', counted(map.loops_withheld)],
    ['chi\u00b2: sum of the squared errors of the edges, in standard deviations',
     `${large(map.chi2_before)} before, ${large(map.chi2_after)} after`],
    ['parts that nothing connects', parts.length > 1 ? `${parts.length}, of ${parts.map(p => number(p)).join(', ')} keyframes` : 'none: it is whole'],
    ['optimisations', number(map.optimizations)],
    ['frames without a pose', number(map.frames_without_pose)],
    ['faults of the odometry', counted({resets: map.resets, gaps: map.gaps, clock_jumps: map.clock_jumps,
                                        unusable_readings: map.unusable_readings})],
    ['frames by where their depths come from', counted({...sources, without_depth: none})],
    ['frames whose depths are of no use', counted(map.depth_defects)],
  ];
}

function fillGraph() {
  const map = run.summary.map || {};
  for (const note of (map.notes || []).filter(text => text !== run.no_map_reason)) byId('graph-notes').append(element('p', {class: 'note'}, note));
  if (!map.nodes) {
    byId('edges').remove();
    return say(byId('graph-content'), bestTrajectory(run).some(known) ? 'this run made no pose graph' : run.no_map_reason);
  }
  byId('graph-content').append(factsTable(graphFacts(map)));
  drawEdges();
}

/** Points over frames on a logarithmic axis, metres. `series` are [name, colour, symbol, key]. */
function drawEdgeNumbers(id, series, nothing) {
  const shown = series.filter(([, , , key]) => run.loops.some(loop => known(loop[key])));
  if (!shown.length) return say(byId(id), nothing);
  const least = 1e-6;  // the logarithm has no 0, and the data no smaller step
  draw(id, () => ({
    grid: plotGrid, legend: {}, dataZoom: zoom,
    tooltip: {formatter: ({seriesName, data: {value, query, loop}}) => `${captionOf(run, query)}<br>${seriesName}: ${
      length(value[1])}${known(loop.weight) ? `, weight ${number(loop.weight, 2)}` : ''}`},
    xAxis: frameAxis(frameCount),
    yAxis: {type: 'log', axisLabel: {formatter: length}},
    series: shown.map(([name, fill, symbol, key]) => ({
      name, type: 'scatter', symbol, symbolSize: 6, itemStyle: {color: fill === 'accent' ? colour(fill) : fill},
      data: run.loops.filter(loop => known(loop[key])).map(loop => ({
        value: [loop.query, Math.max(least, loop[key])], query: loop.query, loop,
        itemStyle: {opacity: loop.weight === 0 ? 0.35 : 1}}))})),
  }));
}

function drawEdges() {
  const nothing = run.loops.length ? 'no loop closure became an edge of the graph' : 'no loop closure was found';
  drawEdgeNumbers('edges-chart', [
    ['before optimisation', '#d55e00', 'triangle', 'residual_before_m'],
    ['after optimisation', 'accent', 'circle', 'residual_after_m']], nothing);
  drawEdgeNumbers('deviations-chart', [
    ['standard deviation that the edge claims', '#009e73', 'rect', 'translation_sd_m'],
    ['error against the ground truth', '#cc79a7', 'diamond', 'truth_error_m']], nothing);
}

// ---- Configuration ----------------------------------------------------------------------------

/** Broken between words only. */
function commandLine(command) {
  return element('pre', {id: 'command'}, ...command.split(' ').flatMap((word, i) =>
    i ? [' ', element('span', {}, word)] : [element('span', {}, word)]));
}

function fillRun() {
  const summary = run.summary;
  const panel = byId('run-content');
  if (summary.command) panel.append(element('h3', {}, 'Command'), commandLine(summary.command));
  panel.append(element('h3', {}, 'Versions and model'), factsTable([
    ...Object.entries(summary.versions), ['model', summary.model.file], ['SHA-256 of the model', summary.model.sha256],
    ['seed', (summary.options.runtime || {}).seed ?? '-'],
    ['time of the whole run', known(summary.wall_seconds) ? clock(summary.wall_seconds) : '-']]));
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
