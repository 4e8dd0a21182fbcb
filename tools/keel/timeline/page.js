// SPDX-License-Identifier: Apache-2.0
// The timeline of a page that tools/keel/timeline/page.py makes; DATA is what it found in a log.
"use strict";

const KINDS = { task: Uint16Array, start: Float64Array, length: Uint32Array, late: Float64Array,
                deadline: Float64Array, skipped: Uint16Array, promoted: Uint8Array,
                slack: Int32Array, slack_after: Int32Array };
const LABELS = 260, AXIS = 24, SLACK = 90, LEAST_US = 50;

const element = id => document.getElementById(id);
const canvas = element("canvas"), pen = canvas.getContext("2d");
const tasks = DATA.tasks, runs = unpacked(), count = runs.start.length;
const first = runs.start[0], last = runs.start[count - 1] + runs.length[count - 1];
const longest = runs.length.reduce((most, one) => Math.max(most, one), 0);
const latest = runs.late.reduce((most, one) => Math.max(most, one), 0);
const furthest = Math.max(longest + latest, ...tasks.map(task => task.period));
let from = first, to = Math.min(last, first + 20000); // What is in sight.
let chosen = -1, hits = [], found = new Set(); // Runs.

function unpacked() {
  const columns = {};
  for (const [name, kind] of Object.entries(KINDS)) {
    const bytes = Uint8Array.from(atob(DATA.runs[name]), one => one.charCodeAt(0));
    columns[name] = new kind(bytes.buffer);
  }
  return columns;
}

const end = run => runs.start[run] + runs.length[run];
const missed = run => end(run) > runs.deadline[run];
const over = run => runs.length[run] > tasks[runs.task[run]].budget;
const seconds = us => (us / 1e6).toFixed(6) + " s";

// --- Search ---------------------------------------------------------------------------------------

function condition(word) {
  const limit = /^(late|longer)>(\d+)$/.exec(word);
  if (limit) {
    const column = limit[1] === "late" ? runs.late : runs.length;
    return run => column[run] > Number(limit[2]);
  }
  const named = { promoted: run => runs.promoted[run], skipped: run => runs.skipped[run] > 0,
                  missed, over };
  const names = tasks.map(task => (task.name + " " + task.sort).toLowerCase());
  return named[word] || (run => names[runs.task[run]].includes(word));
}

function search(text) {
  const wanted = text.toLowerCase().split(/\s+/).filter(word => word).map(condition);
  hits = [];
  for (let run = 0; wanted.length && run < count; run++) {
    if (wanted.every(one => one(run))) { hits.push(run); }
  }
  found = new Set(hits);
  tell();
  draw();
}

function tell() {
  const at = hits.indexOf(chosen);
  element("found").textContent = !element("search").value.trim() ? "" : !hits.length ? "no run" :
    (at >= 0 ? `${at + 1} of ` : "") + `${hits.length} ${hits.length === 1 ? "run" : "runs"}`;
}

// The next hit behind the chosen run, or behind the left edge; backwards the one before.
function go(step) {
  const here = chosen >= 0 ? chosen : firstFrom(from) - (step > 0 ? 1 : 0);
  const ahead = step > 0 ? hits.find(run => run > here) : hits.findLast(run => run < here);
  const next = ahead ?? hits[step > 0 ? 0 : hits.length - 1];
  if (next !== undefined) {
    choose(next);
    const middle = runs.start[next] + runs.length[next] / 2, width = to - from;
    show(middle - width / 2, middle + width / 2);
  }
}

function choose(run) {
  chosen = run;
  const task = run >= 0 ? tasks[runs.task[run]] : null;
  element("run").textContent = !task ? "Click a run to see its times." :
    `${task.name} (${task.sort}, every ${task.period / 1000} ms): from ${seconds(runs.start[run])}` +
    ` for ${runs.length[run]} us of ${task.budget} us, ${runs.late[run]} us behind its release` +
    (runs.slack[run] < 0 ? "" : `, slack ${runs.slack[run]} us, guard ${DATA.guard} us`) +
    (runs.promoted[run] ? ", promoted" : "") +
    (runs.skipped[run] ? `, ${runs.skipped[run]} periods skipped` : "") +
    (missed(run) ? ", deadline missed" : "");
  tell();
  draw();
}

// --- What is shown --------------------------------------------------------------------------------

function show(left, right) {
  const width = Math.min(Math.max(right - left, LEAST_US), last - first);
  from = Math.min(Math.max((left + right - width) / 2, first), last - width);
  to = from + width;
  draw();
}

function zoom(factor, at = (from + to) / 2) {
  show(at - (at - from) * factor, at + (to - at) * factor);
}

let wide = 1, high = 1; // Of the timeline, and the canvas: asking for them at each run takes long.
const x = us => LABELS + (us - from) / (to - from) * wide;
const time = pixel => from + (pixel - LABELS) / wide * (to - from);
const rowHeight = () => Math.max((high - AXIS - SLACK) / tasks.length, 8);
const rowTop = task => AXIS + task * rowHeight();

// The first run that starts at a time or later.
function firstFrom(us) {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (runs.start[middle] < us) { low = middle + 1; } else { high = middle; }
  }
  return low;
}

function runAt(px, py) {
  const task = Math.floor((py - AXIS) / rowHeight()), at = time(px), near = time(px + 3) - at;
  let best = -1, least = near;
  for (let run = firstFrom(at - longest - near); run < count && runs.start[run] <= at + near; run++) {
    const far = Math.max(runs.start[run] - at, at - end(run), 0);
    if (runs.task[run] === task && far <= least) { best = run; least = far; }
  }
  return best;
}

// --- Drawing --------------------------------------------------------------------------------------

const colour = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name);

function colours() {
  return Object.fromEntries(["text", "faint", "line", "realtime", "other", "promoted", "bad", "wait",
                             "back"].map(name => [name, colour(name)]));
}

function drawRows(shade) {
  for (const [number, task] of tasks.entries()) {
    const middle = rowTop(number) + rowHeight() / 2;
    pen.fillStyle = shade.line;
    pen.fillRect(LABELS, rowTop(number + 1) - 1, wide, 1);
    pen.fillStyle = shade.text;
    pen.fillText(task.name, 8, middle, LABELS - 80);
    pen.fillStyle = shade.faint;
    pen.fillText(`${task.period / 1000} ms`, LABELS - 60, middle, 54);
  }
}

function drawAxis(shade) {
  const rough = (to - from) / (wide / 110), power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(one => one * power).find(one => one >= rough);
  for (let at = Math.ceil(from / step) * step; at <= to; at += step) {
    pen.fillStyle = shade.line;
    pen.fillRect(x(at), AXIS, 1, high - AXIS);
    pen.fillStyle = shade.faint;
    pen.fillText((at / 1000).toFixed(step < 1000 ? 3 : 0) + " ms", x(at) + 3, AXIS / 2);
  }
}

// How much it matters that a run is seen.
function weight(run) {
  return run === chosen ? 4 : missed(run) ? 3 : runs.promoted[run] ? 2 : found.has(run) ? 1 : 0;
}

function shadeOf(run, shade) {
  if (missed(run)) { return shade.bad; }
  if (runs.promoted[run]) { return shade.promoted; }
  if (found.size && !found.has(run)) { return shade.faint; }
  return tasks[runs.task[run]].sort === "realtime" ? shade.realtime : shade.other;
}

// Where many runs share a pixel of a row, the first stands for all, unless a later one matters more.
function drawRuns(shade) {
  const drawn = tasks.map(() => ({ until: -1, weight: 0 }));
  for (let run = firstFrom(from - furthest); run < count && runs.start[run] - runs.late[run] <= to;
       run++) {
    const until = Math.floor(Math.max(x(end(run)), x(runs.start[run]) + 1));
    const row = drawn[runs.task[run]], matters = weight(run);
    if (until >= LABELS && (until > row.until || matters > row.weight)) {
      row.until = until;
      row.weight = matters;
      drawRun(run, shade);
    }
  }
}

function drawRun(run, shade) {
  const y = rowTop(runs.task[run]), row = rowHeight();
  const left = x(runs.start[run]), right = Math.max(x(end(run)), left + 1);
  const release = x(runs.start[run] - runs.late[run]), due = x(runs.deadline[run]);
  pen.fillStyle = shade.wait;
  pen.fillRect(release, y + row * 0.45, left - release, Math.max(row * 0.1, 1));
  pen.fillStyle = shadeOf(run, shade);
  pen.fillRect(left, y + row * 0.15, right - left, row * 0.7);
  pen.fillStyle = missed(run) ? shade.bad : shade.faint;
  pen.fillRect(due, y + row * 0.6, 1, row * 0.4);
  if (run === chosen) {
    pen.strokeStyle = shade.text;
    pen.lineWidth = 2;
    pen.strokeRect(left - 2, y + 2, right - left + 4, row - 4);
  }
}

// Slack falls with time from each choice and each end on; what is not known is left out.
function drawSlack(shade) {
  const base = high - 6, tall = SLACK - 24, most = mostSlack();
  const y = value => base - Math.min(value / most, 1) * tall;
  pen.strokeStyle = shade.realtime;
  pen.lineWidth = 1;
  pen.beginPath();
  let drawn = -Infinity; // A line for each pixel.
  for (let run = Math.max(firstFrom(from) - 1, 0); run < count && runs.start[run] <= to; run++) {
    for (const [at, value] of [[runs.start[run], runs.slack[run]], [end(run), runs.slack_after[run]]]) {
      if (value >= 0 && x(at) >= drawn + 1) {
        pen.moveTo(x(at), y(value));
        pen.lineTo(x(at + value), y(0));
        drawn = x(at);
      }
    }
  }
  pen.stroke();
  pen.fillStyle = shade.bad;
  pen.fillRect(LABELS, y(DATA.guard), wide, 1);
}

// The most of it that is in sight.
function mostSlack() {
  let most = Math.max(DATA.guard * 2, 1);
  for (let run = Math.max(firstFrom(from) - 1, 0); run < count && runs.start[run] <= to; run++) {
    most = Math.max(most, runs.slack[run], runs.slack_after[run]);
  }
  return most;
}

function nameSlack(shade) {
  const middle = high - SLACK / 2;
  pen.fillStyle = shade.text;
  pen.fillText(`slack, up to ${mostSlack()} us`, 8, middle - 8, LABELS - 16);
  pen.fillStyle = shade.bad;
  pen.fillText(`guard ${DATA.guard} us`, 8, middle + 10, LABELS - 16);
}

function drawLost(shade) {
  pen.fillStyle = shade.bad;
  for (const [after, ms] of DATA.dropouts) {
    pen.fillRect(x(after), AXIS - 4, Math.max(x(after + ms * 1000) - x(after), 2), 4);
  }
}

function draw() {
  const ratio = window.devicePixelRatio || 1, shade = colours();
  wide = canvas.clientWidth - LABELS;
  high = canvas.clientHeight;
  canvas.width = (LABELS + wide) * ratio;
  canvas.height = high * ratio;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.font = "12px 'DejaVu Sans', system-ui, sans-serif";
  pen.textBaseline = "middle";
  pen.save();
  pen.beginPath();
  pen.rect(LABELS, 0, wide, high);
  pen.clip();
  drawAxis(shade);
  drawSlack(shade);
  drawRuns(shade);
  drawLost(shade);
  pen.restore();
  drawRows(shade);
  nameSlack(shade);
  element("view").textContent = `${seconds(from)} to ${seconds(to)}`;
}

// --- Input ----------------------------------------------------------------------------------------

let held = null;
canvas.addEventListener("pointerdown", event => {
  held = { x: event.offsetX, from, to, moved: false };
  canvas.setPointerCapture(event.pointerId);
});
canvas.addEventListener("pointermove", event => {
  if (held) {
    const by = (held.x - event.offsetX) / wide * (held.to - held.from);
    held.moved = held.moved || Math.abs(event.offsetX - held.x) > 3;
    if (held.moved) { show(held.from + by, held.to + by); }
  }
});
canvas.addEventListener("pointerup", event => {
  if (held && !held.moved) { choose(runAt(event.offsetX, event.offsetY)); }
  held = null;
});
canvas.addEventListener("wheel", event => {
  event.preventDefault();
  if (event.shiftKey || event.deltaX) {
    const by = (event.deltaX || event.deltaY) / wide * (to - from);
    show(from + by, to + by);
  } else {
    zoom(event.deltaY > 0 ? 1.25 : 0.8, time(event.offsetX));
  }
}, { passive: false });
canvas.addEventListener("keydown", event => {
  const by = (to - from) / 5;
  const act = { "+": () => zoom(0.8), "-": () => zoom(1.25), ArrowLeft: () => show(from - by, to - by),
                ArrowRight: () => show(from + by, to + by) }[event.key];
  if (act) { event.preventDefault(); act(); }
});
element("search").addEventListener("input", event => search(event.target.value));
element("search").addEventListener("keydown", event => {
  if (event.key === "Enter") { go(event.shiftKey ? -1 : 1); }
});
element("next").addEventListener("click", () => go(1));
element("previous").addEventListener("click", () => go(-1));
element("in").addEventListener("click", () => zoom(0.5));
element("out").addEventListener("click", () => zoom(2));
element("all").addEventListener("click", () => show(first, last));
window.addEventListener("resize", draw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
draw();
