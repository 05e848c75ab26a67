// Beyond the linear verdict: what is shown of a car's turns up to the limit, and of limit cycles.
import { axisLabel } from "./draw.js";
import { quantity, raised, read, shownUnit } from "./units.js";

const GRAVITY = 9.80665;
const DEGREES = 180 / Math.PI;
const FRONT = "b0 d0", REAR = "b1 d1", STABLE = "b2 d0", UNSTABLE = "b1 d2";

const degrees = values => values.map(v => v * DEGREES);
const room = (low, high) => [low - 0.06 * (high - low || 1), high + 0.12 * (high - low || 1)];

// A curve as two lines, stable and unstable pieces, joined where they meet.
function byStability(x, y, stable, tip) {
  const part = flag => y.map((v, i) => stable[i] === flag || (!flag && stable[i + 1] === false) ? v : null);
  return [true, false].map(flag => ({ x, y: part(flag), name: flag ? STABLE : UNSTABLE, tip: i => `${flag ? "stable" : "unstable"}: ${tip(i)}` }))
    .filter(line => line.y.some(v => v !== null));
}

// Three plots: what the axles give, the handling curve, and the steer angle against the curvature of the path.
export function handlingPlots(found) {
  const g = found.a_y.map(v => v / GRAVITY), top = { range: [0, 1.06 * found.largest / GRAVITY], label: "lateral acceleration [g]" };
  const [front, rear, difference, delta] = [found.front, found.rear, found.difference, found.delta].map(degrees);
  const usual = values => values.filter((_, i) => found.a_y[i] <= 0.995 * found.largest);
  const at = i => `lateral acceleration ${read(g[i], 3)} g`;
  const reach = Math.max(0.5, ...usual(difference).map(Math.abs)) * 1.25;
  const told = `${found.told.join("; ")}.`;
  const tip = (words, values) => i => `${words} ${read(values[i], 3)} deg at ${at(i)}`;
  return {
    axles: { x: { range: [0, 1.04 * Math.max(...front, ...rear)], label: "slip angle [deg]" }, y: top, told,
      lines: [{ x: front, y: g, name: FRONT, tip: tip("front axle: slip angle", front) }, { x: rear, y: g, name: REAR, tip: tip("rear axle: slip angle", rear) }] },
    curve: { x: { range: [-reach, reach], label: "front less rear slip angle [deg]" }, y: top, cross: true, told: "To the right of zero the car understeers at small slip angles, leaning to the left it oversteers.",
      lines: byStability(difference, g, found.stable, tip("front less rear", difference)) },
    steer: { x: { range: [0, 1.06 * Math.max(...found.curvature)], label: "curvature of the path [1/m]" }, y: { range: room(Math.min(0, ...usual(delta)), Math.max(...usual(delta))), label: "steer angle [deg]" },
      bands: found.ranges.filter(r => r.kind === "unstable").map(r => ({ x: r.curvature, name: "unstable" })), told: "Tinted where a turn with the steering held is unstable.",
      lines: byStability(found.curvature, delta, found.stable, i => `steer angle ${read(delta[i], 3)} deg on a radius of ${read(1 / found.curvature[i], 3)} m, ${at(i)}`) },
  };
}

export function cyclesPlot(found, about, values, system) {
  const { factor } = shownUnit(about.unit, system), scale = list => list.map(v => v * factor);
  const line = (x, y, stable, name) => ({ x: scale(x), y, name: `${name} ${stable ? "d0" : "d2"}`,
    tip: i => `${stable ? "stable" : "unstable"} ${name === "rest" ? "straight running" : `limit cycle: ${read(y[i], 3)} ${found.unit}`} at ${found.parameter} = ${quantity(x[i], about.unit, system)}` });
  const now = values[found.parameter], [low, high] = found.range;
  return {
    x: { range: scale(found.range), label: axisLabel(about, found.parameter, system) },
    y: { range: [-0.04 * found.top, 1.12 * found.top], label: `amplitude of ${found.state} [${found.unit}]` },
    lines: [...found.straight.map(p => line(p.x, [0, 0], p.stable, "rest")), ...found.branches.flatMap((b, k) => b.pieces.map(p => line(p.x, p.y, p.stable, `b${k % 8}`)))],
    rules: now >= low && now <= high ? [{ x: now * factor, name: "now" }] : [],
    marks: found.branches.flatMap(b => [{ x: b.critical * factor, y: 0, name: "ring", text: quantity(b.critical, about.unit, system) },
      ...b.folds.map(([x, y]) => ({ x: x * factor, y, name: "design", text: quantity(x, about.unit, system) }))]),
    told: found.told.join(" "),
  };
}

const SAMPLES = {
  line: name => `<path class="line ${name}" d="M0 5H30"/>`, ring: () => '<circle class="ring" cx="15" cy="5" r="4"/>',
  diamond: () => '<path class="design" d="M15 0l5 5l-5 5l-5 -5z"/>', rule: () => '<path class="rule now" d="M15 0V10"/>',
};

// A legend of [sample, class, words].
export function key(host, entries) {
  host.replaceChildren(...entries.map(([kind, name, words]) => {
    const item = document.createElement("li");
    item.innerHTML = `<svg viewBox="0 0 30 10" aria-hidden="true">${SAMPLES[kind](name)}</svg> `;
    item.append(words);
    return item;
  }));
}

export const HANDLING_KEY = [["line", FRONT, "front axle"], ["line", REAR, "rear axle"], ["line", STABLE, "stable turns"], ["line", UNSTABLE, "unstable turns"]];
export const CYCLES_KEY = [["line", "b0 d0", "stable limit cycle"], ["line", "b0 d2", "unstable one"], ["line", "rest d0", "straight running"],
  ["ring", "", "critical value"], ["diamond", "", "where cycles meet and vanish"], ["rule", "", "the vehicle"]];

export function list(host, lines) {
  host.replaceChildren(...lines.map(text => Object.assign(document.createElement("li"), { textContent: raised(text) })));
}
