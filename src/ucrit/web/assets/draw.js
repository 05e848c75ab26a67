// What the plots show of an answer. Values come in SI and are converted to the units of the page here.
import { quantity, read, roundStep, shownUnit } from "./units.js";

const NONE = { parameter: "", branches: [] };
const HERTZ = 1 / (2 * Math.PI);

export const branchClass = index => `b${index % 8} d${(Math.floor(index / 8) + index) % 4}`;

// Union of two boxes, so that the axes stand still while a slider moves.
export function steady(box, before) {
  return before ? [Math.min(box[0], before[0]), Math.max(box[1], before[1]), Math.max(box[2], before[2])] : box;
}

export function axisLabel(about, name, system) {
  const { text } = shownUnit(about.unit, system);
  return `${about.meaning.length < 36 ? about.meaning + " " : ""}${name}${text ? ` [${text}]` : ""}`;
}

export function locusPlot(answer, about, system, box, pinned) {
  const path = answer.locus, [left, right, top] = box;
  const show = v => quantity(v, about.unit, system);
  const lines = path.branches.map(b => ({
    x: b.re, y: b.im, name: branchClass(b.index),
    tip: i => `${b.name}: ${read(b.re[i])} ${b.im[i] ? `± ${read(b.im[i])} i ` : ""}1/s at ${path.parameter} = ${show(path.values[i])}`,
  }));
  const old = (pinned?.locus || NONE).branches.map(b => ({ x: b.re, y: b.im, name: "pinned" }));
  const dots = path.branches.flatMap(b => roundPlaces(path, b, shownUnit(about.unit, system).factor));
  return {
    x: { range: [left, right], label: "real part [1/s]" }, y: { range: [-0.04 * top, top], label: "imaginary part [rad/s]" }, cross: true,
    flat: !path.branches.some(b => b.im.some(im => im > 0)),
    bands: [{ x: [0, Infinity], name: "unstable" }],
    lines: [...old, ...lines],
    marks: [...crossings(answer, show), ...diamonds(answer.analysis.modes, "design"), ...diamonds(pinned?.analysis.modes || [], "design old"), ...dots],
    told: answer.analysis.modes.map(m => `${m.name} at ${read(m.re)}${m.im ? ` plus or minus ${read(m.im)} i` : ""}`).join("; ") + ".",
  };
}

// Where round values of the parameter, as it is shown, lie on a branch.
function roundPlaces(path, branch, factor) {
  const shown = path.values.map(v => v * factor), step = roundStep((shown.at(-1) - shown[0]) / 5), found = [];
  let k = Math.ceil(shown[0] / step);
  for (let i = 1; i < shown.length; i++) for (; k * step <= shown[i]; k++) {
    if (k === 0 || branch.re[i - 1] === null || branch.re[i] === null) continue;
    const part = (k * step - shown[i - 1]) / (shown[i] - shown[i - 1] || 1), between = list => list[i - 1] + part * (list[i] - list[i - 1]);
    found.push({ x: between(branch.re), y: between(branch.im), name: `dot b${branch.index % 8}`, text: read(k * step, 3), small: true });
  }
  return found;
}

const diamonds = (modes, name) => modes.map(m => ({ x: m.re, y: m.im, name }));

const crossings = (answer, show) => answer.critical.filter(c => c.kind !== "order")
  .map(c => ({ x: 0, y: c.hertz / HERTZ, name: "ring", text: show(c.value) }));

// The damping ratio tells how stable a motion is only where it oscillates when it is unstable.
function toldByRatio(path) {
  const size = Math.max(...path.branches.flatMap(b => b.re.map((re, i) => re === null ? 0 : Math.hypot(re, b.im[i]))));
  return path.branches.some(b => b.im.some(im => im > 0)) &&
    path.branches.every(b => b.re.every((re, i) => re === null || re <= 1e-9 * size || b.im[i] > 0));
}

export function dampingPlot(answer, about, system, pinned) {
  const path = answer.locus, ratio = toldByRatio(path);
  const value = b => b.re.map((re, i) => re === null ? null : ratio ? (re || b.im[i] ? -re / Math.hypot(re, b.im[i]) : null) : re);
  const name = ratio ? "damping ratio" : "growth rate";
  const frame = against(answer, about, system, pinned, value, (y, b) => `${b.name}: ${name} ${read(y)}`);
  const late = frame.lines.filter(l => l.tip).flatMap(l => l.y.filter((y, i) => y !== null && i > 0.3 * l.y.length));
  let low = Math.min(0, ...late), high = Math.max(0, ...late);
  if (ratio) [low, high] = [Math.max(-1.08, low - 0.12), high > 0.6 ? 1.08 : high + 0.12];
  else {
    const lowest = frame.lines.filter(l => l.tip).map(l => Math.min(...l.y.filter((y, i) => y !== null && i > 0.3 * l.y.length)));
    const near = lowest.filter(b => b > low / 8);
    if (near.length && high > 0) low = Math.min(0, ...near);
    const margin = 0.1 * (high - low) || 1;
    [low, high] = [low - margin, high + margin];
  }
  frame.y = { range: [low, high], label: ratio ? "damping ratio" : "growth rate [1/s]" };
  return frame;
}

export function frequencyPlot(answer, about, system, pinned) {
  const path = answer.locus;
  if (!path.branches.some(b => b.im.some(im => im > 0))) return null;
  const value = b => b.im.map((im, i) => im > 0 || b.im[i - 1] > 0 || b.im[i + 1] > 0 ? im * HERTZ : null);
  const frame = against(answer, about, system, pinned, value, (y, b) => `${b.name}: ${read(y)} Hz`);
  const late = frame.lines.filter(l => l.tip).flatMap(l => l.y.filter((y, i) => y !== null && i > 0.1 * l.y.length));
  frame.rules.forEach(rule => { delete rule.text; });
  frame.y = { range: [0, 1.12 * Math.max(...late, 1e-6)], label: "frequency [Hz]" };
  return frame;
}

function against(answer, about, system, pinned, value, words) {
  const path = answer.locus, { factor } = shownUnit(about.unit, system);
  const scaled = values => values.map(v => v * factor);
  const x = scaled(path.values), show = v => quantity(v, about.unit, system);
  const lines = path.branches.map(b => {
    const y = value(b);
    return { x, y, name: branchClass(b.index), tip: i => `${words(y[i], b)} at ${path.parameter} = ${show(path.values[i])}` };
  });
  const same = pinned?.locus?.parameter === path.parameter;
  const old = same ? pinned.locus.branches.map(b => ({ x: scaled(pinned.locus.values), y: value(b), name: "pinned" })) : [];
  const rules = answer.critical.map((c, i) => ({ x: c.value * factor, name: "critical", text: `${show(c.value)}, ${c.kind}`, row: i % 3 }));
  const now = answer.values[path.parameter];
  if (now >= path.values[0] && now <= path.values.at(-1)) rules.push({ x: now * factor, name: "now" });
  return {
    x: { range: [x[0], x.at(-1)], label: axisLabel(about, path.parameter, system) },
    bands: answer.stable.map(([a, b]) => ({ x: [a * factor, b * factor], name: "stable" })),
    lines: [...old, ...lines], rules,
    told: answer.critical.map(c => `${c.kind} of the ${c.mode} at ${show(c.value)}, stable ${c.stable} it`).join("; ") || "No change of stability in this range.",
  };
}

export function mapPlot(answer, values, parameters, system, pinned) {
  const side = axis => {
    const about = parameters[axis.name], { factor } = shownUnit(about.unit, system);
    return { ...axis, low: axis.low * factor, high: axis.high * factor, factor, label: axisLabel(about, axis.name, system) };
  };
  const x = side(answer.x), y = side(answer.y);
  const at = (v, name) => ({ x: v[x.name] * x.factor, y: v[y.name] * y.factor, name });
  return {
    x: { range: [x.low, x.high], label: x.label }, y: { range: [y.low, y.high], label: y.label },
    bands: [{ name: "unstable" }, { name: "stable", runs: { rows: answer.runs, x, y } }],
    marks: [at(values, "design"), ...(pinned ? [at(pinned, "design old")] : [])],
    told: `Stable on ${read(100 * answer.share, 3)} percent of it.`,
  };
}
