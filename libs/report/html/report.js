// SPDX-License-Identifier: BSD-3-Clause
// Fills report.html from the JSON that fild::write_html_report() puts into it.
const run = data;
const frameCount = frameCountOf(run);

/** Seconds since the first frame. */
const secondsOf = frame => run.frames.timestamp[frame] - run.frames.timestamp[0];

const minProbability = minProbabilityOf(run);
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
    ...Object.entries(truthKinds).map(([kind, {meaning}]) => [kind, meaning]),
    ['precision', 'right loop closures, divided by right and wrong ones'],
    ['recall', 'right loop closures, divided by the frames that have a loop to find']);
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
    card(number(loopCountOf(run)), plural(loopCountOf(run), 'loop closure')),
  ];
  const errors = run.evaluation || {};
  if (run.evaluation) {
    const {name} = run.protocols[0];
    cards.push(card(share(errors.precision), `precision (${name})`), card(share(errors.recall), `recall (${name})`),
               card(number(errors.wrong), `wrong ${plural(errors.wrong, 'loop closure')}`),
               card(number(errors.missed), `missed ${plural(errors.missed, 'loop')}`));
  }
  if (known(errors.ate_input_m)) cards.push(card(metres(errors.ate_input_m), 'trajectory error (ATE) before'));
  if (known(errors.ate_optimized_m)) cards.push(card(metres(errors.ate_optimized_m), 'trajectory error (ATE) after'));
  const whole = (summary.stage_times_ms || {}).whole_frame;
  if (whole) cards.push(card(number(whole.mean, 0) + ' ms', 'mean time per frame'));
  cards.push(card(bytes(summary.memory.peak_bytes), 'peak memory'));
  byId('headline').append(...cards);
  byId('headline-words').append(explanation('What these numbers mean', headlineWords(errors)));
  for (const remark of run.remarks)
    byId('remarks').append(element('p', {class: 'note'}, remark));
}

// ---- Ground truth -----------------------------------------------------------------------------

/** The score of the headline, the same by other protocols, and all other numbers. */
function fillTruth() {
  if (!run.evaluation) {
    document.querySelector('nav a[href="#truth"]').remove();
    return byId('truth').remove();
  }
  const rows = run.protocols.map(({name, rule, ...score}) => [
    name, score.precision, score.recall, ...['right', 'wrong', 'doubtful', 'missed'].map(kind => number(score[kind])), rule]);
  byId('protocols').append(...tableOf(['protocol', 'precision', 'recall', 'right', 'wrong', 'doubtful', 'missed', 'what it asks'], rows));
  byId('protocols').querySelectorAll('tr > :last-child').forEach(cell => cell.className = 'text rule');
  byId('protocols').querySelector('tbody tr').classList.add('sum');
  byId('protocols-hint').textContent = run.protocols.length > 1
    ? 'One run, one score for each rule by which a loop closure is right. The first is the score of this page.' : '';
  const groups = new Map();
  for (const {group, name, value, meaning} of run.metrics) groups.set(group, [...groups.get(group) || [], [name.trim(), value, meaning]]);
  for (const [group, lines] of groups) {
    if (group) byId('all-metrics').append(element('h4', {}, group));
    const table = element('table', {class: 'metrics'}, ...tableOf(['number', 'value', 'meaning'], lines));
    table.querySelectorAll('tr > :last-child').forEach(cell => cell.className = 'text rule');
    byId('all-metrics').append(element('div', {class: 'scroll', tabindex: 0}, table));
  }
  drawPrecisionRecall();
}

function drawPrecisionRecall() {
  const curves = Object.entries(run.curves).filter(([, points]) => points.length > 1);
  if (!curves.length) return say(byId('curve-chart'), 'no loop query and no candidate: no curve');
  const {precision, recall} = run.evaluation;
  draw('curve-chart', () => ({
    grid: plotGrid, legend: {},
    tooltip: {formatter: ({seriesName, value}) => `${seriesName}: precision ${share(value[1])}, recall ${share(value[0])}`
      + (known(value[2]) ? `, from ${number(value[2], 2)} up` : '')},
    xAxis: {type: 'value', name: 'recall', nameLocation: 'middle', nameGap: 26, min: 0, max: 1},
    yAxis: {type: 'value', name: 'precision', min: 0, max: 1},
    series: [
      ...curves.map(([name, points], i) => ({name: 'by ' + name, type: 'line', symbolSize: 5, showSymbol: false, color: palette[i ? 3 : 0],
                                             lineStyle: {type: i ? 'dashed' : 'solid'}, data: points})),
      {name: 'this run', type: 'scatter', symbolSize: 12, color: colour('ink'),
       data: known(precision) && known(recall) ? [[recall, precision]] : []}],
  }));
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
  return run.shown.filter(frame => f.rejection[frame] && known(f.candidate[frame]) && pictureOf(run, frame))
    .sort((a, b) => f.support[b] - f.support[a]);
}

function fillWrongGallery() {
  const wrong = framesOfKind(run, 'wrong');
  const drawn = wrong.filter(query => pictureOf(run, query));
  if (!wrong.length) return byId('wrong-loops').remove();
  byId('wrong-title').textContent = `Wrong loop closures (${run.evaluation.wrong})`;
  byId('wrong-hint').textContent = (drawn.length < run.evaluation.wrong ? `${drawn.length} of them have a picture here. ` : '')
    + 'wrong_loops.csv, which rawlog-loop-closure --ground-truth and loop-closure-eval write, lists all.';
  fillGallery(byId('wrong-gallery'), drawn.map(query => () => figureOf(run, query)), 'none of them has a picture');
}

function fillGalleries() {
  const f = run.frames;
  const accepted = run.loops.map(loop => loop.query);
  const drawn = accepted.filter(query => pictureOf(run, query));
  const weakest = [...drawn].sort((a, b) => f.support[a] - f.support[b]).slice(0, 2);
  const figures = queries => queries.map(query => () => figureOf(run, query));
  fillWrongGallery();
  byId('support-hint').textContent = `Support: ${supportMeaning}.`;
  const noPictures = accepted.length ? 'no pictures were drawn: [render] max_match_pictures or [report] max_pictures is 0'
    : 'no loop closure was found';
  fillGallery(byId('weakest'), figures(weakest), noPictures);
  const rejected = rejectedWithPicture();
  fillGallery(byId('strongest-rejected'), figures(rejected.slice(0, 2)),
              'no picture: no rejected pair came far enough, or [report] max_rejected_pictures is 0');
  byId('gallery-hint').textContent = drawn.length < loopCountOf(run)
    ? `${drawn.length} of ${loopCountOf(run)} loop closures have a picture here; [render] max_match_pictures and `
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
    .on('click', item => {
      if (known(item.data?.query)) pin(item.data.query);
      if (known(item.data?.frame)) showFrame(item.data.frame);
    });
  fillMapScale();
}

/** What the colours of the loop closures say, where the legend does not. */
function fillMapScale() {
  if (!run.loops.length || run.truth) return;
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
  return `<div class="edge-tooltip">${image}<div>${tooltipOf(run, query)}</div></div>`;
}

function mapSeries() {
  const lines = [['truth', 'ground truth', {color: mapColours.truth, width: 6}],
                 ['input', 'before the loops', {color: mapColours.input}],
                 ['optimized', 'optimised path', {color: colour('ink')}]];
  return [
    ...lines.filter(([name]) => run.trajectories[name])
      .map(([name, title, style]) => trajectoryLine(title, run, run.trajectories[name], style)),
    ...edgeSeries(rejectedPairs, rejectedWithPicture(), () => ({color: colour('faint'), width: 2, opacity: 0.6, type: 'dotted'})),
    ...(run.truth ? judgedSeries() : loopSeries()), ...endSeries()];
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

/** Loop closures by what the truth says of them, and rings where one is missed. */
function judgedSeries() {
  const weights = new Map(run.loops.map(loop => [loop.query, loop.weight]));
  const styleOf = kind => query => ({color: kindColour(kind), width: kind === 'wrong' ? 4 : 3,
                                     opacity: weights.get(query) === 0 ? 0.5 : 0.9, type: weights.get(query) === 0 ? 'dotted' : 'solid'});
  const loops = ['right', 'doubtful', 'wrong'].flatMap(kind =>
    edgeSeries(`${kind} loop closures`, framesOfKind(run, kind), styleOf(kind)));
  const at = bestTrajectory(run);
  const missed = framesOfKind(run, 'missed').filter(frame => known(at[frame]));
  if (!missed.length) return loops;
  return [...loops, {name: 'missed loops', type: 'scatter', symbol: 'circle', symbolSize: 11, z: 4, itemStyle: markStyle('missed'),
                     tooltip: {formatter: item => loopTooltip(item.data.frame)},
                     data: missed.map(frame => ({frame, value: at[frame].slice(0, 2)}))}];
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

/** Points of a column over frames: accepted and rejected ones or, with truth, its kinds. */
function pointsOverFrames(column) {
  const all = run.shown.map(frame => ({value: [frame, run.frames[column][frame]], frame}))
    .filter(({value, frame}) => known(value[1]) && known(run.frames.candidate[frame]));
  const series = (name, itemStyle, symbol, wanted, symbolSize = 5) => ({
    name, type: 'scatter', symbol, symbolSize, itemStyle, data: all.filter(({frame}) => wanted(frame))});
  const isAccepted = frame => verdictOf(run, frame) === 'accepted';
  if (!run.truth) return [series('rejected', {color: '#e69f00'}, 'triangle', frame => !isAccepted(frame)),
                          series('accepted', {color: colour('accent')}, 'circle', isAccepted)];
  const kinds = Object.entries(truthKinds).map(([kind, {symbol}]) =>
    series(kind, markStyle(kind), symbol, frame => kindOf(run, frame) === kind, kind === 'right' ? 5 : 8));
  return [series('rightly rejected', {color: colour('off')}, 'triangle', frame => !kindOf(run, frame)), ...kinds.filter(({data}) => data.length)];
}

/** From where on similarities are whitened, which makes them smaller: when so many frames are older
 *  than the delay; null when it is off or never comes. */
function firstWhitenedFrame() {
  const least = Number(optionOf(run, 'index', 'whiten_from'));
  if (!(least > 0)) return null;
  const times = run.frames.timestamp;
  const delay = Number(optionOf(run, 'index', 'delay_seconds'));
  const enough = times[run.shown.find(frame => frame >= least - 1)];
  const first = run.shown.find(frame => enough <= times[frame] - delay);
  return first > 0 ? first : null;
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
  const whitened = column === 'similarity' ? firstWhitenedFrame() : null;
  const whitening = {silent: true, symbol: 'none', data: [{xAxis: whitened}], lineStyle: {color: colour('faint'), type: 'dotted'},
                     label: {formatter: 'whitened from here on', position: 'insideEndTop', rotate: 0, align: 'left', color: colour('faint')}};
  const room = extent => extent.max > threshold.value * 1.1 ? null : threshold.value * 1.1;
  const chart = draw(id, () => {
    const series = pointsOverFrames(column);
    if (threshold) series[0].markLine = line();
    else if (known(whitened)) series[0].markLine = whitening;
    return {
      grid: plotGrid, legend: {}, dataZoom: zoom,
      tooltip: {formatter: item => known(item.data.frame) ? tooltipOf(run, item.data.frame) : ''},
      xAxis: frameAxis(frameCount),
      yAxis: {type: 'value', name: title, axisLabel: {formatter: atMost(digits)},
              max: threshold ? threshold.most ?? room : null},
      series,
    };
  });
  chart.on('click', item => { if (known(item.data?.frame)) showFrame(item.data.frame); });
}

function drawVerdictCharts() {
  const inliers = Number(optionOf(run, 'verification', 'min_inliers'));
  // With [same_place] more inliers alone do not make a loop closure.
  const inliersName = `min_inliers = ${inliers}` + (known(minProbability) ? ', needed before support is measured' : '');
  drawOverFrames('inliers-chart', 'inliers', 'inliers', inliers > 0 && {value: inliers, name: inliersName}, 0);
  drawOverFrames('support-chart', 'support', 'support',
                 known(minProbability) ? {value: minProbability, name: `min_probability = ${minProbability}`, most: 1}
                   : {value: 1, name: 'verified from 1 up'}, 1);
  const similarity = Number(optionOf(run, 'index', 'min_similarity'));
  drawOverFrames('similarity-chart', 'similarity', 'similarity',
                 similarity > -1 && {value: similarity, name: `min_similarity = ${similarity}`}, 1);
  drawReasons();
}

function drawReasons() {
  const sorted = Object.entries(run.verdicts).sort((a, b) => a[1] - b[1]);
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
  })).on('click', item => {
    byId('filter-verdict').value = sorted[item.dataIndex][0];
    byId('filter-truth').value = byId('filter-frame').value = '';
    showPage(0);
  });
  byId('verdict-words').append(explanation('What the verdicts mean', [...sorted].reverse()
    .map(([name]) => [words(name), run.verdict_meanings[name] || 'a word of another version of mrpt-fild'])));
}

const numberOfCandidate = column => frame => known(run.frames.candidate[frame]) ? run.frames[column][frame] : null;
const ofCandidate = (column, digits) => frame => known(run.frames.candidate[frame]) ? number(run.frames[column][frame], digits) : '';
// What matters most first: on a phone the others are reached by scrolling. The last of each sorts.
const columns = [
  ['frame', frame => String(frame), '', frame => frame],
  ['time, s', frame => number(secondsOf(frame), 2)],
  ['verdict', frame => words(verdictOf(run, frame)), 'text', frame => verdictOf(run, frame)],
  ...(run.truth ? [['truth', truthCell, 'text', frame => kindOf(run, frame)]] : []),
  ['candidate', candidateCell, '', frame => run.frames.candidate[frame]],
  ['support', ofCandidate('support', 3), '', numberOfCandidate('support')],
  ['inliers', ofCandidate('inliers', 0), '', numberOfCandidate('inliers')],
  ['matches', ofCandidate('matches', 0), '', numberOfCandidate('matches')],
  ['similarity', ofCandidate('similarity', 3), '', numberOfCandidate('similarity')],
  ['keypoints', frame => number(run.frames.keypoints[frame]), '', frame => run.frames.keypoints[frame]],
  ['camera', frame => run.frames.sensors[run.frames.sensor[frame]], 'text'],
];
const columnMeanings = [
  ['verdict', 'whether the frame is a loop closure, or why it is rejected'],
  ...(run.truth ? [['truth', 'what the ground truth says of that; empty: rightly rejected']] : []),
  ['candidate', 'the earlier frame with the best evidence; a button shows the picture of the pair'],
  ['support', supportMeaning],
  ['inliers', 'matches that agree with one motion of the camera'],
  ['matches', 'keypoints of one image that were found in the other'],
  ['similarity', 'of both images as a whole: cosine of their global descriptors, -1 to 1. Once the map holds [index] '
    + 'whiten_from frames they are whitened: what all images of the map have in common is taken out, and similarities drop'],
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
    row.after(element('tr', {class: 'opened'}, element('td', {class: 'wide', colspan: columns.length}, figureOf(run, frame))));
  }}, String(candidate));
}

function truthCell(frame) {
  const kind = kindOf(run, frame);
  if (!kind) return '';
  const {place} = missedLoops(run).get(frame) || {};
  return element('span', {}, badge(kind), kind === 'missed' && known(place) ? ` at ${place}` : '');
}

/** Ranges of frames out of `120`, `100-200` or several with commas; null when it is none of these. */
function parseRanges(text) {
  if (!text) return [];
  const parts = text.split(',').map(part => part.trim().match(/^(\d+)(?:\s*-\s*(\d+))?$/));
  return parts.every(Boolean) ? parts.map(([, first, last]) => ({
    isSingle: !known(last), first: Math.min(first, last ?? first), last: Math.max(first, last ?? first)})) : null;
}

const withCandidate = run.truth ? 'with a candidate, or missed' : 'with a candidate';

/** The frames that the filter lets through, as sorted; null when the range cannot be read. */
function filteredFrames() {
  const verdict = byId('filter-verdict').value;
  const kind = byId('filter-truth').value;
  const ranges = parseRanges(byId('filter-frame').value.trim());
  if (!ranges) return null;
  const inRange = frame => !ranges.length || ranges.some(({isSingle, first, last}) =>
    (frame >= first && frame <= last) || (isSingle && run.frames.candidate[frame] === first));
  const hasVerdict = frame => !verdict || (verdict === withCandidate ? known(run.frames.candidate[frame])
    || kindOf(run, frame) === 'missed' : verdictOf(run, frame) === verdict);
  const frames = run.shown.filter(frame => hasVerdict(frame) && (!kind || kindOf(run, frame) === kind) && inRange(frame));
  return sortedFrames(frames);
}

/** Of the column that a click on its head chose; frames without a value last. */
let sorting = {column: -1, isDescending: false};

function sortedFrames(frames) {
  const [, , , key] = columns[sorting.column] || [];
  if (!key) return frames;
  const sign = sorting.isDescending ? -1 : 1;
  const compare = (a, b) => typeof a === 'string' ? a.localeCompare(b) : a - b;
  return frames.sort((a, b) => !known(key(a)) || !known(key(b)) ? Number(!known(key(a))) - Number(!known(key(b)))
    : sign * compare(key(a), key(b)));
}

function columnHead([name, , kind, key], column) {
  if (!key) return element('th', {class: kind || ''}, name);
  const isSorted = sorting.column === column;
  return element('th', {class: kind || '', 'aria-sort': !isSorted ? 'none' : sorting.isDescending ? 'descending' : 'ascending'},
    element('button', {type: 'button', class: 'sort', title: 'sort by ' + name, onclick: () => {
      sorting = {column, isDescending: isSorted && !sorting.isDescending};
      showPage(0);
    }}, name + (isSorted ? sorting.isDescending ? ' \u25bc' : ' \u25b2' : '')));
}

function showPage(wanted) {
  const frames = filteredFrames();
  if (!frames) {
    byId('filter-count').textContent = 'not a frame, a range or a list of them: 120, 100-200 or 12,14';
    return byId('frames').querySelector('tbody').replaceChildren();
  }
  const pages = Math.max(1, Math.ceil(frames.length / rowsPerPage));
  page = Math.min(Math.max(0, wanted), pages - 1);
  const head = element('tr', {}, ...columns.map(columnHead));
  const rows = frames.slice(page * rowsPerPage, (page + 1) * rowsPerPage).map(frame =>
    element('tr', {'data-frame': frame}, ...columns.map(([, value, kind]) => element('td', {class: kind || ''}, value(frame)))));
  byId('frames').replaceChildren(element('thead', {}, head), element('tbody', {}, ...rows));
  byId('filter-count').textContent = `${number(frames.length)} of ${counting(run.shown.length, 'frame')}`
    + (isWhole(run) ? '' : ` in this page; the recording has ${number(frameCount)}`);
  const turn = (name, to) => {
    const button = element('button', {type: 'button', onclick: () => showPage(to)}, name);
    button.disabled = to < 0 || to >= pages;
    return button;
  };
  byId('pager').replaceChildren(turn('previous', page - 1), element('span', {}, `page ${page + 1} of ${pages}`),
                                turn('next', page + 1));
}

function showFrame(frame) {
  byId('filter-verdict').value = byId('filter-truth').value = '';
  byId('filter-frame').value = String(frame);
  showPage(0);
  byId('frames').querySelector(`tr[data-frame="${frame}"] button`)?.click();
  byId('filter').scrollIntoView({block: 'start'});
}

function fillTable() {
  if (!isWhole(run)) byId('frames-title').textContent = 'Frames in this page';
  const verdicts = Object.keys(run.verdicts).sort();
  const option = (value, name) => element('option', {value}, name);
  byId('filter-verdict').append(option('', 'all'), ...verdicts.map(name => option(name, words(name))));
  if (run.frames.candidate.some(known)) {
    byId('filter-verdict').append(option(withCandidate, withCandidate));
    byId('filter-verdict').value = withCandidate;
  }
  const kinds = Object.keys(truthKinds).filter(kind => framesOfKind(run, kind).length);
  byId('filter-truth').append(option('', 'all'), ...kinds.map(kind => option(kind, kind)));
  if (!run.truth) byId('filter-truth').parentElement.hidden = true;
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

/** Above the diagonal, where the matrix has nothing: on it they would hide what they are to be compared
 *  with. A missed loop stands where the truth has it. */
function mirroredLoops() {
  const size = run.loops.length > 100 ? 4 : 7;
  const series = (name, itemStyle, symbol, symbolSize, pairs) => ({
    type: 'scatter', name: name + ' (mirrored)', symbol, symbolSize, z: 3, itemStyle,
    data: pairs.map(([query, place]) => ({value: [query, place], query}))});
  const pairOf = query => [query, run.frames.candidate[query]];
  if (!run.truth) return [series('accepted loop closures', {color: colour('accent')}, 'circle', size, run.loops.map(loop => pairOf(loop.query)))];
  const pairsOf = kind => framesOfKind(run, kind).map(query =>
    kind === 'missed' ? [query, missedLoops(run).get(query).place] : pairOf(query)).filter(([, place]) => known(place));
  return Object.entries(truthKinds).map(([kind, {symbol}]) =>
    series(kind, markStyle(kind), symbol, kind === 'right' ? size : size + 3, pairsOf(kind))).filter(({data}) => data.length);
}

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
    legend: {data: mirroredLoops().map(({name}) => name)},
    tooltip: {formatter: item => known(item.data.query) ? tooltipOf(run, item.data.query) : ''},
    xAxis: {...frameAxis(frameCount), name: 'earlier frame', max: frameCount},
    yAxis: {...frameAxis(frameCount), name: 'frame', nameGap: 44, max: frameCount, inverse: true},
    series: [
      {type: 'custom', name: 'similarity', silent: true, data: [0],
       renderItem: (parameters, api) => {
         const [x0, y0] = api.coord([0, 0]);
         const [x1, y1] = api.coord([covered, covered]);
         return {type: 'image', style: {image: matrix.canvas, x: x0, y: y0, width: x1 - x0, height: y1 - y0}};
       }, clip: true},
      ...mirroredLoops(),
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
    ['stage', 'calls', 'mean, ms', 'median, ms', '95th percentile, ms', 'longest, ms', 'total, s'],
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
    {name: 'memory of the map of places', data: points(costs.map_bytes, 1e-6)}]);
}

// ---- Pose graph -------------------------------------------------------------------------------

/** `{a: 3, b: 1, c: 0}` as "3 a, 1 b". */
const counted = counts => Object.entries(counts || {}).filter(([, count]) => count)
  .map(([word, count]) => `${number(count)} ${words(word)}`).join(', ') || 'none';

/** How chi\u00b2 after optimisation compares with what the claimed uncertainties predict. */
function fitFacts(map, parts) {
  const freedom = 6 * (map.odometry_edges + map.loop_edges - (map.nodes - parts));
  if (!(freedom > 0) || !known(map.chi2_after)) return [];
  const ratio = map.chi2_after / freedom;
  const verdict = ratio > 2 ? 'more: the edges contradict each other by more than their standard deviations allow'
    : ratio < 0.5 ? 'less: the edges agree better than their standard deviations claim' : 'as expected';
  return [['chi\u00b2 expected after: degrees of freedom', `${number(freedom)}; it is ${number(ratio, 2)} of that, ${verdict}`]];
}

/** What a source of motion is to the map. */
function sourceFact(source) {
  if (source.left_out) return `no part in the map: ${source.left_out}`;
  const what = source.kind === 'gps' ? 'positions' : 'motions';
  const ignored = source.without_weight ? `, ${number(source.without_weight)} of them without weight` : '';
  return `${number(source.factors)} ${what}${ignored}; standard deviations times ${number(source.noise_scale, 2)}`;
}

const scaleFact = map => known(map.loop_noise_scale)
  ? [['standard deviations of the loops, and of the motion between keyframes, multiplied by',
      `${number(map.loop_noise_scale, 2)}, and ${number(map.motion_noise_scale, 2)}: as large as the errors of this recording are`]]
  : [];

function graphFacts(map) {
  const parts = map.parts || [];
  const {none, ...sources} = map.depth_sources || {};
  return [
    ['trajectory before', map.trajectory_source ? `${map.trajectory}: ${map.trajectory_source}` : map.trajectory],
    ...(map.sources || []).map(source => [source.name, sourceFact(source)]),
    ...scaleFact(map),
    ['keyframes', number(map.nodes)],
    ['edges of the motion', number(map.odometry_edges)],
    ['loop edges', number(map.loop_edges)],
    ['loop edges with weight 0: rejected as outliers by the optimiser', counted(map.loops_without_weight)],
    ['loop closures without an edge', counted(map.loops_withheld)],
    ['chi\u00b2: sum of the squared errors of the edges, each divided by its standard deviation',
     `${large(map.chi2_before)} before, ${large(map.chi2_after)} after`],
    ...fitFacts(map, parts.length || 1),
    ['parts without an edge between them', parts.length > 1 ? `${parts.length}, of ${parts.map(p => number(p)).join(', ')} keyframes` : 'none: the graph is connected'],
    ['optimisations', number(map.optimizations)],
    ['frames without a pose', number(map.frames_without_pose)],
    ['odometry faults', counted({resets: map.resets, gaps: map.gaps, clock_jumps: map.clock_jumps,
                                        unusable_readings: map.unusable_readings})],
    ['frames by source of depth', counted({...sources, without_depth: none})],
    ['frames with unusable depth', counted(map.depth_defects)],
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

const median = sorted => sorted.length ? (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2 : null;

/** Errors of the edges against what they claim of themselves. */
function fillEdgeVerdict() {
  const loops = run.loops.filter(loop => known(loop.truth_error_m) && loop.translation_sd_m > 0 && loop.weight !== 0);
  if (!loops.length) return;
  const ascending = values => values.sort((a, b) => a - b);
  const errors = ascending(loops.map(loop => loop.truth_error_m));
  const ratios = ascending(loops.map(loop => loop.truth_error_m / loop.translation_sd_m));
  const over = sigmas => `${number(100 * ratios.filter(ratio => ratio > sigmas).length / ratios.length, 1)}\u00a0%`;
  const verdict = median(ratios) > 1.3 ? 'The edges claim to be more exact than they are.'
    : median(ratios) < 0.4 ? 'The edges are more exact than they claim.' : 'The edges are about as exact as they claim.';
  byId('edge-verdict').textContent = `${counting(loops.length, 'loop edge')} with a weight${isWhole(run) ? '' : ' in this page'}, against the ground truth: the position is off by ${
    length(median(errors))} in the median, which is ${number(median(ratios), 2)} of the standard deviation that the edge claims; ${
    over(2)} are off by more than 2 of them, ${over(3)} by more than 3 (right claims: median 0.7 to 0.9, at most about 5\u00a0% and 0.3\u00a0%). ${verdict}`;
}

function drawEdges() {
  fillEdgeVerdict();
  const nothing = run.loops.length ? 'no loop closure became an edge of the graph' : 'no loop closure was found';
  drawEdgeNumbers('edges-chart', [
    ['before optimisation', '#d55e00', 'triangle', 'residual_before_m'],
    ['after optimisation', 'accent', 'circle', 'residual_after_m']], nothing);
  drawEdgeNumbers('deviations-chart', [
    ['claimed standard deviation', '#009e73', 'rect', 'translation_sd_m'],
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
    ['duration of the run', known(summary.wall_seconds) ? clock(summary.wall_seconds) : '-'],
    ...(summary.finished ? [['finished', summary.finished]] : [])]));
  if ((run.files || []).length)
    panel.append(element('h3', {}, 'Files beside this page'), element('p', {class: 'files'}, ...run.files.flatMap((name, i) =>
      [i ? ', ' : '', element('a', {href: name}, name)])));
  panel.append(element('h3', {}, 'Options in force'));
  for (const [section, options] of Object.entries(summary.options))
    panel.append(element('details', {}, element('summary', {}, '[' + section + ']'), factsTable(Object.entries(options))));
  byId('footer').textContent = `mrpt-fild ${summary.versions['mrpt-fild'] || ''}. Charts: Apache ECharts (Apache-2.0), `
    + 'in this file.';
}

fillHeadline();
fillTruth();
fillMap();
fillGalleries();
drawVerdictCharts();
fillTable();
drawMatrix();
fillTime();
fillGraph();
fillRun();
