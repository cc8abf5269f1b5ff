// SPDX-License-Identifier: BSD-3-Clause
// Fills comparison.html from the JSON that fild::write_html_comparison() puts into it.
const runs = data.runs;
const names = runs.map(run => baseName(run.folder));
if (names[0] === names[1]) runs.forEach((run, i) => names[i] = run.folder);
const sideColour = side => side ? colour('accent') : '#d55e00';
const frameCount = Math.max(...runs.map(frameCountOf));

function fillHead() {
  document.title = `${names[0]} and ${names[1]} - mrpt-fild`;
  byId('title').textContent = `${names[0]} and ${names[1]}`;
  byId('subtitle').textContent = `Two runs over ${[...new Set(runs.map(run => run.summary.rawlog))].join(' and ')}`;
  const counts = runs.map(frameCountOf);
  const ofBoth = runs[0].remarks.filter(remark => runs[1].remarks.includes(remark));
  const remarks = ofBoth.concat(runs.flatMap((run, i) =>
    run.remarks.filter(remark => !ofBoth.includes(remark)).map(remark => `${names[i]}: ${remark}`)));
  if (counts[0] !== counts[1])
    remarks.push(`${names[0]} has ${number(counts[0])} frames, ${names[1]} ${number(counts[1])}.`);
  for (const remark of remarks) byId('remarks').append(element('p', {class: 'note'}, remark));
  byId('footer').textContent = `mrpt-fild ${runs[1].summary.versions['mrpt-fild'] || ''}. Charts: Apache ECharts `
    + '(Apache-2.0), in this file.';
}

// ---- Numbers and options ----------------------------------------------------------------------

/** Numbers of the pose graph; none when there is no graph. */
const graphOf = run => (run.summary.map || {}).nodes ? run.summary.map : {};

const milliseconds = value => number(value, 1) + '\u00a0ms';

/** Name, the number of a run (undefined: it has none), and how it is written. */
const metrics = [
  ['camera frames', run => frameCountOf(run), number],
  ['loop closures', loopCountOf, number],
  ['precision', run => (run.evaluation || {}).precision, share],
  ['recall', run => (run.evaluation || {}).recall, share],
  ['wrong loop closures', run => (run.evaluation || {}).wrong, number],
  ['missed loops', run => (run.evaluation || {}).missed, number],
  ['absolute trajectory error (ATE) before', run => (run.evaluation || {}).ate_input_m, metres],
  ['absolute trajectory error (ATE) after', run => (run.evaluation || {}).ate_optimized_m, metres],
  ['keyframes', run => graphOf(run).nodes, number],
  ['loop edges', run => graphOf(run).loop_edges, number],
  ['chi\u00b2 after optimisation: disagreement of the edges', run => graphOf(run).chi2_after, large],
  ['mean time per frame', run => ((run.summary.stage_times_ms || {}).whole_frame || {}).mean, milliseconds],
  ['time per frame, 95th percentile', run => ((run.summary.stage_times_ms || {}).whole_frame || {}).p95, milliseconds],
  ['duration of the run', run => run.summary.wall_seconds, clock],
  ['peak memory', run => run.summary.memory.peak_bytes, bytes],
  ['memory of the map of places', run => run.summary.memory.map_bytes, bytes],
];

function difference([first, second], write) {
  if (!known(first) || !known(second)) return '';
  if (write(first) === write(second)) return 'same';
  const percent = first ? ` (${second > first ? '+' : '\u2212'}${number(100 * Math.abs(second / first - 1), 1)}\u00a0%)` : '';
  return `${second > first ? '+' : '\u2212'}${write(Math.abs(second - first))}${percent}`;
}

function fillNumbers() {
  const rows = metrics.map(([name, get, write]) => [name, runs.map(get), write])
    .filter(([, values]) => values.some(known))
    .map(([name, values, write]) => [name, ...values.map(value => known(value) ? write(value) : '-'), difference(values, write)]);
  byId('metrics').append(...tableOf(['number', ...names.map(breakable), 'difference'], rows));
}

function fillOptions() {
  const all = runs.map(run => new Map(Object.entries(run.summary.options).flatMap(([section, options]) =>
    Object.entries(options).map(([key, value]) => [`[${section}] ${key}`, value]))));
  for (const [i, run] of runs.entries()) {
    for (const [name, version] of Object.entries(run.summary.versions)) all[i].set('version of ' + name, version);
    all[i].set('SHA-256 of the model', run.summary.model.sha256);
    all[i].set('rawlog', run.summary.rawlog);
  }
  const keys = [...new Set(all.flatMap(options => [...options.keys()]))];
  const rows = keys.filter(key => all[0].get(key) !== all[1].get(key))
    .map(key => [key, ...all.map(options => options.has(key) ? options.get(key) || '(empty)' : '(not there)')]);
  const panel = byId('differing-options');
  if (!rows.length) return say(panel, 'none: both runs had the same options, versions and model');
  panel.append(element('div', {class: 'scroll', tabindex: 0}, element('table', {class: 'differences'}, ...tableOf(['option', ...names.map(breakable)], rows))));
}

// ---- Loop closures ----------------------------------------------------------------------------

const isLoop = (run, frame) => frame < frameCountOf(run) && run.frames.rejection[frame] === '';
const onlyIn = side => runs[side].loops.filter(loop => !isLoop(runs[1 - side], loop.query));

/** Loops of the ground truth that no run found; `run` is the one that has that truth. */
function missedByBoth() {
  const side = runs.findIndex(one => one.truth);
  const run = runs[side];
  return (run ? framesOfKind(run, 'missed') : []).filter(query => !runs.some(one => isLoop(one, query)))
    .map(query => ({query, side, candidate: missedLoops(run).get(query).place})).filter(({candidate}) => known(candidate));
}

function missedSeries(missed) {
  return {name: `missed by both (${missed.length})`, type: 'scatter', symbol: 'circle', symbolSize: 8, itemStyle: markStyle('missed'),
          data: missed.map(({query, side, candidate}) => ({value: [candidate, query], side, query}))};
}

function drawLoops() {
  const common = runs[0].loops.filter(loop => isLoop(runs[1], loop.query));
  const missed = missedByBoth();
  if (!missed.length && !runs.some(run => run.loops.length)) return say(byId('loops-chart'), 'neither run found a loop closure');
  // Not the run itself: ECharts copies what is in a point.
  const series = (name, symbol, fill, loops, side) => ({
    name: `${name} (${loops.length})`, type: 'scatter', symbol, symbolSize: 7, itemStyle: {color: fill},
    data: loops.map(loop => ({value: [loop.candidate, loop.query], side, query: loop.query}))});
  draw('loops-chart', () => ({
    grid: matrixGrid,
    legend: {}, tooltip: {formatter: item => tooltipOf(runs[item.data.side], item.data.query)},
    xAxis: {...frameAxis(frameCount), name: 'earlier frame'},
    yAxis: {...frameAxis(frameCount), name: 'frame', nameGap: 44, inverse: true},
    series: [series('both', 'circle', '#7f7f7f', common, 1),
             series(`only ${names[0]}`, 'triangle', sideColour(0), onlyIn(0), 0),
             series(`only ${names[1]}`, 'diamond', sideColour(1), onlyIn(1), 1),
             ...(missed.length ? [missedSeries(missed)] : [])],
  }));
}

/** What the run that has no loop closure there says of the frame. */
function otherSide(run, name, query) {
  if (query >= frameCountOf(run)) return element('figure', {}, element('figcaption', {}, `${name} ended before frame ${query}`));
  if (!known(run.frames.candidate[query]))
    return element('figure', {}, element('figcaption', {}, `${name}: ${words(verdictOf(run, query))}, no candidate`));
  const figure = figureOf(run, query);
  figure.querySelector('figcaption').prepend(name + ': ');
  return figure;
}

function fillDifferences(id, side) {
  const loops = onlyIn(side);
  byId(id + '-title').textContent = `Only in ${names[side]}: ${number(data.only[side])}`;
  const shown = loops.filter(loop => pictureOf(runs[side], loop.query));
  const pair = query => () => element('div', {class: 'pair'}, otherSide(runs[side], names[side], query),
                                      otherSide(runs[1 - side], names[1 - side], query));
  if (shown.length < data.only[side])
    byId(id).before(element('p', {class: 'hint'}, `${shown.length} of them have a picture here; [render] max_match_pictures of `
      + 'the run and --max-pictures say how many.'));
  fillGallery(byId(id), shown.map(loop => pair(loop.query)), loops.length ? 'none of them has a picture' : 'none');
}

// ---- Map and time -----------------------------------------------------------------------------

function drawMap() {
  const lines = () => runs.map((run, i) => [names[i], run, bestTrajectory(run), {color: sideColour(i), type: i ? 'solid' : 'dashed'}])
    .filter(([, , positions]) => positions.some(known));
  const reasons = new Set(runs.filter(run => !bestTrajectory(run).some(known)).map(run => run.no_map_reason));
  if (!lines().length) return say(byId('map-chart'), [...reasons].join('; '));
  const truth = runs[0].trajectories.truth || runs[1].trajectories.truth;
  const all = [...lines().map(([, , positions]) => positions), truth || []].flat().filter(known);
  drawMapOf(all, () => [
    ...(truth ? [trajectoryLine('ground truth', runs[runs[0].trajectories.truth ? 0 : 1], truth, {color: colour('faint'), type: 'dotted'})] : []),
    ...lines().map(line => trajectoryLine(...line))]);
}

fillHead();
fillNumbers();
fillOptions();
drawLoops();
fillDifferences('only-first', 0);
fillDifferences('only-second', 1);
drawMap();
drawStages('stages-chart', runs.map((run, i) => [names[i], run.summary]));
