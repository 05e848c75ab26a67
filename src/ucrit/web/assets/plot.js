// Plots as SVG: lines, bands, marks; the point nearest to the pointer or the keyboard's cursor is read out; zoom.
import { read, roundStep } from "./units.js";

const MARGIN = { left: 62, right: 12, top: 10, bottom: 40 };
const NEAR = 40; // pixels from the pointer within which a point is read out
const narrow = matchMedia("(max-width: 60rem)");
let count = 0;

export const escape = text => String(text).replace(/[&<>"]/g, c => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c]));

export class Plot {
  // ratio: height per width; pick(x, y): called with the place of a click in data coordinates
  constructor(host, { label, ratio, pick = null }) {
    Object.assign(this, { host, ratio, pick, zoom: null, content: null, cursor: null, clip: `clip-${count++}` });
    host.innerHTML = `<div class="tools"><button type="button" aria-label="Zoom in, ${label}">+</button><button type="button"
      aria-label="Zoom out, ${label}">−</button><button type="button" aria-label="Show all, ${label}">⤢</button></div>
      <svg role="group" tabindex="0" aria-roledescription="plot"></svg><p class="readout" aria-live="polite"></p>`;
    this.label = label;
    this.svg = host.querySelector("svg");
    this.readout = host.querySelector(".readout");
    const [closer, farther, all] = host.querySelectorAll("button");
    closer.addEventListener("click", () => this.scale(1 / 1.5));
    farther.addEventListener("click", () => this.scale(1.5));
    all.addEventListener("click", () => this.all());
    this.width = host.clientWidth;
    new ResizeObserver(entries => { // reading the width at each drawing would make the browser lay out the page each time
      const width = Math.round(entries.at(-1).contentRect.width);
      if (width !== this.width) { this.width = width; this.draw(); }
    }).observe(host);
    this.listen();
  }

  set(content) {
    if (!this.content) this.readout.textContent = "";
    this.content = content;
    this.draw();
  }

  empty(sentence) {
    this.content = null;
    this.svg.innerHTML = "";
    this.svg.setAttribute("aria-label", `${this.label}: ${sentence}`);
    this.svg.setAttribute("height", 0);
    this.readout.textContent = sentence;
  }

  draw() {
    if (!this.content || !this.width) return;
    const compact = narrow.matches ? Math.min(this.ratio, 0.62) : this.ratio;
    this.height = Math.round(Math.max(170, Math.min(this.width * compact, 460)));
    const c = this.content;
    if (c.flat) this.height = Math.round(Math.max(150, this.height * 0.6));
    this.x = this.zoom?.x || c.x.range;
    this.y = this.zoom?.y || c.y.range;
    const right = this.width - MARGIN.right, bottom = this.height - MARGIN.bottom;
    const kx = (right - MARGIN.left) / (this.x[1] - this.x[0]), ky = (bottom - MARGIN.top) / (this.y[1] - this.y[0]);
    this.px = v => MARGIN.left + (v - this.x[0]) * kx;
    this.py = v => bottom - (v - this.y[0]) * ky;
    this.qx = p => this.x[0] + (p - MARGIN.left) / kx;
    this.qy = p => this.y[0] + (bottom - p) / ky;
    const box = `x="${MARGIN.left}" y="${MARGIN.top}" width="${right - MARGIN.left}" height="${bottom - MARGIN.top}"`;
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.setAttribute("height", this.height);
    this.svg.setAttribute("aria-label", `${this.label}. ${c.told || ""} Arrow keys read points, plus and minus zoom, Shift with arrows moves the view.`);
    this.svg.innerHTML = `<defs><clipPath id="${this.clip}"><rect ${box}/></clipPath></defs>` +
      `<g clip-path="url(#${this.clip})">${(c.bands || []).map(b => this.band(b, bottom)).join("")}</g>` +
      this.axes(c, right, bottom) +
      `<g clip-path="url(#${this.clip})">${(c.lines || []).map(l => this.line(l)).join("")}${(c.rules || []).map(r => this.rule(r, bottom)).join("")}</g>` +
      (c.rules || []).map(r => this.ruleText(r)).join("") + this.marks(c.marks || []) + `<g class="cursor"></g><rect class="zoomed" hidden="" />`;
    if (this.cursor) this.point(this.cursor.line, this.cursor.index);
  }

  band({ x = this.x, y = this.y, name, runs }, bottom) {
    if (runs) return `<path class="${name}" d="${this.cells(runs)}"/>`;
    const left = this.px(Math.max(x[0], this.x[0])), top = this.py(Math.min(y[1], this.y[1]));
    const right = this.px(Math.min(x[1], this.x[1])), low = Math.min(this.py(Math.max(y[0], this.y[0])), bottom);
    return right > left && low > top ? `<rect class="${name}" x="${left}" y="${top}" width="${right - left}" height="${low - top}"/>` : "";
  }

  // Rows of a map, each with the ends of its runs of stable cells; neighbours overlap a little to hide seams.
  cells({ rows, x, y }) {
    const dx = (x.high - x.low) / (x.count - 1), dy = (y.high - y.low) / (y.count - 1);
    const height = this.py(y.low) - this.py(y.low + dy) + 0.6;
    let d = "";
    rows.forEach((ends, j) => {
      const top = (this.py(y.low + (j + 0.5) * dy) - 0.3).toFixed(1);
      for (let i = 0; i < ends.length; i += 2) {
        const left = this.px(x.low + (ends[i] - 0.5) * dx), right = this.px(x.low + (ends[i + 1] - 0.5) * dx);
        d += `M${left.toFixed(1)} ${top}H${right.toFixed(1)}v${height.toFixed(1)}H${left.toFixed(1)}z`;
      }
    });
    return d;
  }

  axes(c, right, bottom) {
    const along = ticks(this.x, (right - MARGIN.left) / 70), up = ticks(this.y, (bottom - MARGIN.top) / 36);
    const lines = along.at.map(v => `M${this.px(v)} ${MARGIN.top}V${bottom}`).join("") + up.at.map(v => `M${MARGIN.left} ${this.py(v)}H${right}`).join("");
    const zero = this.y[0] < 0 && this.y[1] > 0 ? `<path class="axis" d="M${MARGIN.left} ${this.py(0)}H${right}"/>` : "";
    const upright = c.cross && this.x[0] < 0 && this.x[1] > 0 ? `<path class="axis" d="M${this.px(0)} ${MARGIN.top}V${bottom}"/>` : "";
    return `<path class="grid" d="${lines}"/>${zero}${upright}<path class="axis" d="M${MARGIN.left} ${MARGIN.top}V${bottom}H${right}"/>` +
      along.at.map(v => `<text class="tick" x="${this.px(v)}" y="${bottom + 16}" text-anchor="middle">${along.text(v)}</text>`).join("") +
      up.at.map(v => `<text class="tick" x="${MARGIN.left - 7}" y="${this.py(v) + 4}" text-anchor="end">${up.text(v)}</text>`).join("") +
      `<text class="label" x="${(MARGIN.left + right) / 2}" y="${this.height - 6}" text-anchor="middle">${escape(c.x.label)}</text>` +
      `<text class="label" transform="translate(13 ${(MARGIN.top + bottom) / 2}) rotate(-90)" text-anchor="middle">${escape(c.y.label)}</text>`;
  }

  line({ x, y, name }) {
    let d = "", pen = "M";
    for (let i = 0; i < x.length; i++) {
      if (x[i] === null || y[i] === null) { pen = "M"; continue; }
      d += `${pen}${clamp(this.px(x[i]))} ${clamp(this.py(y[i]))}`;
      pen = "L";
    }
    return `<path class="line ${name}" d="${d}"/>`;
  }

  rule({ x, name }, bottom) {
    return x < this.x[0] || x > this.x[1] ? "" : `<path class="rule ${name}" d="M${this.px(x)} ${MARGIN.top}V${bottom}"/>`;
  }

  ruleText({ x, text, row = 0 }) {
    if (!text || x < this.x[0] || x > this.x[1]) return "";
    const p = this.px(x), late = p > 0.7 * this.width;
    return `<text class="note" x="${p + (late ? -5 : 5)}" y="${MARGIN.top + 14 + 16 * row}" text-anchor="${late ? "end" : "start"}">${escape(text)}</text>`;
  }

  // Marks, and the words of those that find room; the first in the list choose first.
  marks(list) {
    const taken = [], shapes = [], words = [];
    for (const { x, y, name, text, small } of list) {
      if (x < this.x[0] || x > this.x[1] || y < this.y[0] || y > this.y[1]) continue;
      const p = this.px(x), q = this.py(y), r = name.startsWith("dot") ? 2.8 : 6;
      shapes.push(name.startsWith("design") ? `<path class="${name}" d="M${p} ${q - r}l6 6l-6 6l-6 -6z"/>` : `<circle class="${name}" cx="${p}" cy="${q}" r="${r}"/>`);
      taken.push([p - r, q - r, p + r, q + r]);
      if (text) words.push({ p, q, r, text, small });
    }
    const labels = words.map(w => this.words(w, taken));
    return shapes.reverse().join("") + labels.join("");
  }

  words({ p, q, r, text, small }, taken) {
    const size = small ? 10.5 : 12, wide = 0.62 * size * text.length;
    for (const [dx, dy] of [[r + 3, -r - 1], [r + 3, r + 8], [-r - 3 - wide, -r - 1], [-r - 3 - wide, r + 8], [-wide / 2, -r - 4], [-wide / 2, r + size]]) {
      const box = [p + dx, q + dy - size, p + dx + wide, q + dy];
      const free = box[0] > MARGIN.left && box[2] < this.width && box[1] > 0 && box[3] < this.height - MARGIN.bottom
        && taken.every(t => box[2] < t[0] || box[0] > t[2] || box[3] < t[1] || box[1] > t[3]);
      if (!free) continue;
      taken.push(box);
      return `<text class="note${small ? " small" : ""}" x="${box[0]}" y="${box[3]}">${escape(text)}</text>`;
    }
    return "";
  }

  listen() {
    const svg = this.svg;
    let start = null;
    const place = event => { const box = svg.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    svg.addEventListener("pointerdown", event => { if (event.button === 0) start = place(event); });
    svg.addEventListener("pointermove", event => {
      if (!this.content) return;
      const at = place(event);
      if (start && event.pointerType === "mouse" && event.buttons) this.rubber(start, at);
      else this.nearest(at);
    });
    svg.addEventListener("pointerup", event => {
      if (!start || !this.content) return;
      const at = place(event), from = start;
      start = null;
      if (event.pointerType === "mouse" && Math.abs(at[0] - from[0]) > 8 && Math.abs(at[1] - from[1]) > 8) {
        const order = (a, b) => a < b ? [a, b] : [b, a];
        this.zoom = { x: order(this.qx(from[0]), this.qx(at[0])), y: order(this.qy(from[1]), this.qy(at[1])) };
        this.draw();
      } else if (this.pick && this.inside(at)) this.pick(this.qx(at[0]), this.qy(at[1]));
      else this.nearest(at);
      this.svg.querySelector(".zoomed")?.toggleAttribute("hidden", true);
    });
    svg.addEventListener("pointerleave", event => { if (event.pointerType === "mouse") { start = null; this.quiet(); } });
    svg.addEventListener("dblclick", () => this.all());
    svg.addEventListener("wheel", event => { // with Ctrl, which is also what a pinch on a touchpad sends: the page scrolls without
      if (!event.ctrlKey || !this.content) return;
      event.preventDefault();
      const [p, q] = place(event);
      this.scale(1.002 ** event.deltaY, [this.qx(p), this.qy(q)]);
    }, { passive: false });
    svg.addEventListener("keydown", event => this.key(event));
    svg.addEventListener("blur", () => this.quiet());
  }

  inside([p, q]) {
    return p >= MARGIN.left && p <= this.width - MARGIN.right && q >= MARGIN.top && q <= this.height - MARGIN.bottom;
  }

  rubber(from, to) {
    const frame = this.svg.querySelector(".zoomed");
    frame.toggleAttribute("hidden", false);
    const box = { x: Math.min(from[0], to[0]), y: Math.min(from[1], to[1]), width: Math.abs(from[0] - to[0]), height: Math.abs(from[1] - to[1]) };
    for (const [key, value] of Object.entries(box)) frame.setAttribute(key, value);
  }

  key(event) {
    const lines = (this.content?.lines || []).filter(l => l.tip);
    const [side, rise] = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] || [];
    const act = event.shiftKey && side !== undefined ? () => this.pan(side, rise) : {
      "+": () => this.scale(1 / 1.5), "=": () => this.scale(1 / 1.5), "-": () => this.scale(1.5), 0: () => this.all(), Escape: () => this.all(),
      ArrowRight: () => this.step(lines, 0, 1), ArrowLeft: () => this.step(lines, 0, -1),
      ArrowUp: () => this.step(lines, 1, 0), ArrowDown: () => this.step(lines, -1, 0),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }

  step(lines, other, along) {
    if (!lines.length) return;
    const k = this.cursor ? Math.max(lines.indexOf(this.content.lines[this.cursor.line]), 0) : 0;
    const line = lines[(k + other + lines.length) % lines.length];
    const stride = along * Math.max(1, Math.round(line.x.length / 60));
    let i = this.cursor ? this.cursor.index : Math.round(line.x.length / 2);
    do i += stride || 1; while (line.y[i] === null);
    i = Math.min(Math.max(i, 0), line.x.length - 1);
    if (line.y[i] !== null && line.y[i] !== undefined) this.point(this.content.lines.indexOf(line), i);
  }

  nearest([p, q]) {
    let best = NEAR ** 2, found = null;
    (this.content.lines || []).forEach((line, k) => {
      if (!line.tip) return;
      for (let i = 0; i < line.x.length; i++) {
        if (line.x[i] === null || line.y[i] === null) continue;
        const far = (this.px(line.x[i]) - p) ** 2 + (this.py(line.y[i]) - q) ** 2;
        if (far < best) { best = far; found = [k, i]; }
      }
    });
    if (found) this.point(...found); else this.quiet();
  }

  point(line, index) {
    const drawn = this.content.lines[line];
    if (!drawn?.tip || drawn.x[index] === undefined || drawn.y[index] === null) return this.quiet();
    this.cursor = { line, index };
    this.svg.querySelector(".cursor").innerHTML = `<circle r="5" cx="${this.px(drawn.x[index])}" cy="${this.py(drawn.y[index])}"/>`;
    this.readout.textContent = drawn.tip(index);
  }

  quiet() {
    this.cursor = null;
    const mark = this.svg.querySelector(".cursor");
    if (mark) mark.innerHTML = "";
    this.readout.textContent = "";
  }

  // Zoom about a place: by default the point that is read, or else the middle.
  scale(factor, place = this.read() || [(this.x[0] + this.x[1]) / 2, (this.y[0] + this.y[1]) / 2]) {
    if (!this.content) return;
    const [x, y] = [this.x, this.y].map((range, i) => range.map(end => place[i] + (end - place[i]) * factor));
    this.zoom = { x, y };
    this.draw();
  }

  read() {
    const line = this.cursor && this.content?.lines[this.cursor.line];
    return line && [line.x[this.cursor.index], line.y[this.cursor.index]];
  }

  pan(side, rise) {
    if (!this.content) return;
    const moved = ([a, b], part) => [a, b].map(end => end + part * 0.2 * (b - a));
    this.zoom = { x: moved(this.x, side), y: moved(this.y, rise) };
    this.draw();
  }

  all() {
    this.zoom = null;
    this.draw();
  }
}

const clamp = v => Math.round(Math.min(Math.max(v, -5000), 5000) * 10) / 10;

function ticks([low, high], most) {
  const span = high - low;
  let step = roundStep(span / Math.max(most, 2));
  if (span / step > most + 1) step = roundStep(step * 2.5);
  const at = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; k++) at.push(k * step);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const size = Math.max(Math.abs(low), Math.abs(high));
  const text = v => size >= 1e5 || size < 1e-3 ? read(Math.abs(v) < step / 2 ? 0 : v, 3) : v.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "−");
  return { at, text };
}
