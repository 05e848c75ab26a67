// The page: what is chosen, what is asked, what is drawn. All state is here and in the link; the server keeps none.
import { Newest, Problem, ask, request, save } from "./ask.js";
import { CYCLES_KEY, HANDLING_KEY, cyclesPlot, handlingPlots, key, list } from "./beyond.js";
import { fileDialog } from "./dialog.js";
import { dampingPlot, frequencyPlot, locusPlot, mapPlot, steady } from "./draw.js";
import { Film } from "./film.js";
import { readLink, write } from "./link.js";
import { $, problem, status, wait } from "./messages.js";
import { Panel } from "./panel.js";
import { Plot } from "./plot.js";
import { comparison, criticalWords, legend, modeRows, remedyList } from "./tables.js";
import { SYSTEMS, plain, shownUnit } from "./units.js";

const IDLE = 120; // ms after the last change before what is slow is asked

// values: as the server confirmed them; asked: with changes that are still under way
const s = { subject: null, about: null, parameters: {}, values: null, asked: null, ranges: {}, along: null, map: [null, null],
  shown: "mode", mode: 0, disturb: null, units: "si", pin: null, answer: null, box: null, moving: null };
const plots = {
  locus: new Plot($("locus"), { label: "Root locus", ratio: 0.72 }),
  damping: new Plot($("damping"), { label: "Damping", ratio: 0.42 }),
  frequency: new Plot($("frequency"), { label: "Frequency", ratio: 0.34 }),
  map: new Plot($("map"), { label: "Stability map", ratio: 0.68, pick: pickOnMap }),
  axles: new Plot($("axles"), { label: "What the axles give", ratio: 0.68 }),
  curve: new Plot($("curve"), { label: "Handling curve", ratio: 0.68 }),
  steer: new Plot($("steer"), { label: "Steer angle", ratio: 0.68 }),
  amplitude: new Plot($("amplitude"), { label: "Limit cycles", ratio: 0.5 }),
};
const panel = new Panel($("rows"), change);
const film = new Film($("film"));
let idle = null, map = null;

const follow = new Newest("api/state", answered, refused);
const asides = {
  map: new Newest("api/map", found => { map = found; drawMap(); }, sentence => { map = null; plots.map.empty(sentence); }),
  remedies: new Newest("api/remedies", found => remedyList($("remedies"), found, s.units, apply), sentence => { $("remedies").textContent = sentence; }),
  sure: new Newest("api/sure", found => { $("sure").textContent = found.sentence; }, sentence => { $("sure").textContent = sentence; }),
  motion: new Newest("api/motion", found => film.set(found), sentence => film.refuse(sentence)),
  handling: new Newest("api/handling", showHandling, sentence => emptied("handling", sentence)),
  cycles: new Newest("api/cycles", showCycles, sentence => emptied("cycles", sentence)),
  pin: new Newest("api/state", found => { s.pin.answer = found; draw(); }, sentence => { s.pin = null; problem(`The pinned design cannot be shown: ${sentence}`); draw(); }),
};

const body = (values = s.asked || s.values) => ({ ...s.subject, values, along: s.along, range: s.ranges[s.along], units: s.units });

// --- changes

function change(name, value) {
  s.asked = { ...(s.asked || s.values), [name]: value };
  s.moving = name;
  follow.push(body());
}

const apply = (name, value) => { change(name, value); status(`${name} is changed.`); };

function pickOnMap(x, y) {
  if (!map) return;
  const [a, b] = [map.x, map.y].map(axis => shownUnit(s.parameters[axis.name].unit, s.units).factor);
  s.asked = { ...(s.asked || s.values), [map.x.name]: x / a };
  change(map.y.name, y / b);
}

function answered(answer) {
  s.answer = answer;
  s.values = answer.values;
  if (!follow.next) s.asked = null;
  problem("");
  const stretched = panel.show(s.asked ? { ...s.values, ...numbers(s.asked) } : s.values, s.moving);
  for (const name of stretched) s.ranges[name] = [...panel.rows[name].range];
  if (stretched.includes(s.along)) follow.push(body());
  draw();
  clearTimeout(idle);
  idle = setTimeout(settled, IDLE);
}

const numbers = values => Object.fromEntries(Object.entries(values).filter(([, v]) => typeof v === "number"));

function refused(sentence) {
  s.asked = null;
  if (!s.moving || !panel.refuse(s.moving, sentence)) problem(sentence);
  if (!s.answer) $("main").hidden = true;
}

// Nothing moved for a while: ask for what is slower than a picture, let the axes shrink again, update the link.
function settled() {
  if (follow.busy) return;
  s.box = null;
  draw();
  const base = body(s.values);
  const [x, y] = s.map;
  if (x && y) asides.map.push({ ...base, x, y, x_range: s.ranges[x], y_range: s.ranges[y] });
  else plots.map.empty("A map needs two parameters.");
  asides.remedies.push(base);
  if (s.about.parameters.some(p => p.known)) asides.sure.push(base);
  askMotion();
  if ($("equations").open) loadEquations();
  for (const name of Object.keys(BEYOND)) askBeyond(name);
  history.replaceState(null, "", link());
  document.documentElement.dataset.settled = String(Number(document.documentElement.dataset.settled || 0) + 1);
}

// --- beyond the linear verdict: asked only where it is looked at, since it takes seconds

const BEYOND = { handling: ["axles", "curve", "steer"], cycles: ["amplitude"] };

function askBeyond(name) {
  if (!$(name).open || $(`${name}-card`).hidden) return;
  const wanted = JSON.stringify([s.subject, s.values, s.units]);
  if ($(name).dataset.key === wanted) return;
  $(name).dataset.key = wanted;
  $(name).setAttribute("aria-busy", "true");
  $(`${name}-said`).textContent = name === "handling" ? "Following the turns …" : "Following the limit cycles …";
  asides[name].push(body(s.values));
}

function emptied(name, sentence) {
  $(name).removeAttribute("aria-busy");
  $(`${name}-said`).textContent = sentence;
  list($(`${name}-facts`), []);
  list($(`${name}-key`), []);
  for (const plot of BEYOND[name]) plots[plot].empty("");
}

function showHandling(found) {
  emptied("handling", `${found.told[0]}.`);
  list($("handling-facts"), found.told.slice(1));
  for (const [name, content] of Object.entries(handlingPlots(found))) plots[name].set(content);
  key($("handling-key"), HANDLING_KEY);
}

function showCycles(found) {
  emptied("cycles", found.told[0]);
  list($("cycles-facts"), found.told.slice(1));
  if (!found.branches.length) return;
  plots.amplitude.set(cyclesPlot(found, s.parameters[found.parameter], s.values, s.units));
  key($("cycles-key"), CYCLES_KEY);
}

function askMotion() {
  if (!s.about.moves) return film.refuse("There is no drawing of this vehicle.");
  asides.motion.push({ ...body(s.values), ...(s.shown === "mode" ? { mode: s.mode } : { disturb: s.disturb }) });
}

// --- drawing

function draw() {
  if (s.answer.analysis.critical?.some(c => c.kind === "flutter")) $("cycles-card").hidden = false;
  const answer = s.answer, about = s.parameters[s.along], pinned = s.pin?.answer;
  $("verdict").className = `verdict ${answer.style}`;
  $("sign").textContent = answer.sign;
  $("word").textContent = answer.word;
  if ($("sentence").textContent !== answer.sentence) $("sentence").textContent = answer.sentence;
  criticalWords($("critical"), answer, s.units);
  if (answer.locus) {
    s.box = steady(answer.locus.box, s.box);
    plots.locus.set(locusPlot(answer, about, s.units, s.box, pinned));
    plots.damping.set(dampingPlot(answer, about, s.units, pinned));
    const frequency = frequencyPlot(answer, about, s.units, pinned);
    if (frequency) plots.frequency.set(frequency);
    else plots.frequency.empty("Nothing oscillates in this range.");
  } else for (const name of ["locus", "damping", "frequency"]) plots[name].empty(name === "locus" ? answer.why[0].toUpperCase() + answer.why.slice(1) + "." : "");
  legend($("legend"), answer, pinned);
  drawMap();
  modeRows($("modes"), answer.analysis.modes);
  $("compare-card").hidden = !pinned;
  if (pinned) comparison($("compare"), pinned, answer, s.parameters, s.units);
  motionChoices(answer.analysis.modes);
  document.documentElement.dataset.drawn = String(Number(document.documentElement.dataset.drawn || 0) + 1);
}

function drawMap() {
  const [x, y] = [map?.x.name, map?.y.name], key = map && JSON.stringify([s.values[x], s.values[y], s.pin?.values[x], s.pin?.values[y], s.units]);
  if (!map || (plots.map.content && map.drawn === key)) return;
  map.drawn = key;
  plots.map.set(mapPlot(map, s.values, s.parameters, s.units, s.pin?.values));
}

function motionChoices(modes) {
  const chosen = s.shown === "mode" ? `mode ${s.mode}` : `disturb ${s.disturb}`;
  const texts = [...modes.map((m, i) => [`mode ${i}`, m.name]), ...s.about.states.map(x => [`disturb ${x.name}`, `after a disturbance of ${x.meaning}`])];
  const key = JSON.stringify(texts);
  if ($("motion").dataset.key !== key) {
    $("motion").replaceChildren(...texts.map(([value, text]) => new Option(text, value)));
    $("motion").dataset.key = key;
  }
  $("motion").value = chosen;
  if ($("motion").selectedIndex < 0) { // fewer modes than before
    $("motion").selectedIndex = 0;
    [s.shown, s.mode] = ["mode", 0];
  }
}

async function loadEquations() {
  const key = JSON.stringify([s.subject, s.values, s.units]);
  if ($("derivation").dataset.key === key) return;
  $("derivation").dataset.key = key;
  if (!$("derivation").innerHTML) $("derivation").textContent = "Deriving …";
  const waiting = wait("Deriving the formulas …");
  try {
    $("derivation").innerHTML = (await ask("api/equations", body(s.values))).html; // made by the server's own template
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    $("derivation").textContent = error.message;
    delete $("derivation").dataset.key; // opened again, it is asked again
  } finally {
    clearInterval(waiting);
    status("");
  }
}

// --- choosing a vehicle, the link

const CARDS = [...Object.keys(BEYOND), "equations"];
const link = () => write({ v: s.subject.vehicle, toml: s.subject.toml, values: s.values, pin: s.pin?.values,
  along: s.along, from: s.ranges[s.along][0], to: s.ranges[s.along][1], x: s.map[0], y: s.map[1],
  mode: s.shown === "mode" ? s.mode : null, disturb: s.shown === "mode" ? null : s.disturb, units: s.units,
  open: CARDS.filter(name => $(name).open).join(",") || null });

// Show a vehicle; wanted holds what a link asks for. Throws Problem, with the page as it was.
async function open(subject, wanted = { values: {}, pin: null }) {
  document.documentElement.setAttribute("aria-busy", "true");
  const waiting = wait(`Deriving the equations of ${subject.vehicle || "the vehicle file"}; they are kept for the next time …`);
  try {
    const about = await ask("api/open", subject);
    const names = about.parameters.map(p => p.name);
    for (const name of [wanted.along, wanted.x, wanted.y, ...Object.keys(wanted.values), ...Object.keys(wanted.pin || {})])
      if (name !== undefined && !names.includes(name)) throw new Problem(`The link cannot be read: this vehicle has no parameter '${name.slice(0, 40)}'.`);
    const initial = Object.fromEntries(about.parameters.map(p => [p.name, p.value]));
    const along = wanted.along ?? about.along;
    const ranges = Object.fromEntries(about.parameters.map(p => [p.name, p.range]));
    if (wanted.from < wanted.to) ranges[along] = [wanted.from, wanted.to];
    const units = wanted.units || s.units, request = { ...subject, along, range: ranges[along], units };
    const answer = await ask("api/state", { ...request, values: { ...initial, ...wanted.values } });
    const pin = wanted.pin && { values: { ...initial, ...wanted.pin } };
    if (pin) pin.answer = await ask("api/state", { ...request, values: pin.values });
    for (const queue of [follow, ...Object.values(asides)]) queue.forget();
    Object.assign(s, { subject, about, ranges, along, pin, asked: null, moving: null, box: null, units,
      parameters: Object.fromEntries(about.parameters.map(p => [p.name, p])),
      map: [wanted.x ?? about.map?.[0], wanted.y ?? about.map?.[1]],
      shown: wanted.disturb === undefined ? "mode" : "disturb", disturb: wanted.disturb ?? about.states[0]?.name,
      mode: Number(wanted.mode ?? Math.max(0, answer.analysis.modes.findIndex(m => m.re || m.im))) });
    map = null;
    for (const plot of Object.values(plots)) plot.zoom = null;
    $("main").hidden = false;
    build();
    if (wanted.open) for (const name of CARDS) $(name).open = wanted.open.includes(name);
    answered(answer);
  } finally {
    clearInterval(waiting);
    status("");
    document.documentElement.removeAttribute("aria-busy");
  }
}

function build() {
  const { about } = s;
  $("name").textContent = about.name;
  document.title = `${about.name} – ucrit explorer`;
  $("vehicle").value = s.subject.vehicle || "";
  $("units").value = s.units;
  $("about").textContent = [about.title, about.made && about.made[0].toUpperCase() + about.made.slice(1), about.source && `Numbers: ${about.source}`, about.note].filter(Boolean).map(t => t.replace(/\.?\s*$/, ".")).join(" ");
  $("derivation").innerHTML = "";
  delete $("derivation").dataset.key;
  $("sure").textContent = "";
  $("remedies").textContent = "Computing …";
  $("handling-card").hidden = !about.turns;
  $("cycles-card").hidden = true; // until an oscillation is seen to begin at some speed
  for (const name of Object.keys(BEYOND)) delete $(name).dataset.key;
  plots.map.empty("Computing …");
  film.refuse("Computing …");
  $("pin").setAttribute("aria-pressed", String(Boolean(s.pin)));
  const options = () => about.parameters.map(p => new Option(`${p.name}, ${p.meaning}`, p.name));
  for (const [id, value] of [["along", s.along], ["map-x", s.map[0]], ["map-y", s.map[1]]]) {
    $(id).replaceChildren(...options());
    $(id).value = value;
  }
  panel.build(about.parameters, s.ranges, s.units);
  showRange();
}

function showRange() {
  const { factor, text } = shownUnit(s.parameters[s.along].unit, s.units);
  for (const [i, id] of ["from", "to"].entries()) $(id).dataset.shown = $(id).value = plain(s.ranges[s.along][i] * factor, 4);
  $("along-unit").textContent = text;
}

async function attempt(action) {
  try {
    problem("");
    await action();
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    problem(error.message);
  }
}

const restore = () => attempt(async () => {
  const wanted = readLink(location.hash);
  if (wanted.toml !== undefined) await open({ toml: wanted.toml }, wanted);
  else await open({ vehicle: wanted.v ?? "caravan" }, wanted);
});

// --- controls

$("vehicle").addEventListener("change", () => $("vehicle").value && attempt(() => open({ vehicle: $("vehicle").value.trim() })));
$("vehicle").addEventListener("focus", () => $("vehicle").select());
$("units").replaceChildren(...Object.entries(SYSTEMS).map(([key, text]) => new Option(text, key)));
$("units").addEventListener("change", () => { s.units = $("units").value; build(); plots.map.zoom = null; redo(); });
$("reset").addEventListener("click", () => { s.asked = Object.fromEntries(s.about.parameters.map(p => [p.name, p.value])); s.moving = null; follow.push(body()); });
$("pin").addEventListener("click", () => {
  s.pin = s.pin ? null : { values: { ...s.values }, answer: s.answer };
  $("pin").setAttribute("aria-pressed", String(Boolean(s.pin)));
  draw();
  settled();
});
$("copy").addEventListener("click", async () => {
  history.replaceState(null, "", link());
  try { await navigator.clipboard.writeText(location.href); status("The link is copied."); }
  catch { status("The link is in the address bar."); }
});
for (const button of $("downloads").querySelectorAll("button"))
  button.addEventListener("click", () => attempt(async () => { $("downloads").open = false; status(`${await save({ ...body(s.values), kind: button.dataset.kind })} is saved.`); }));
function redo() {
  s.box = null;
  for (const name of ["locus", "damping", "frequency"]) plots[name].zoom = null;
  showRange();
  follow.push(body());
  if (s.pin) asides.pin.push(body(s.pin.values));
}
$("along").addEventListener("change", () => { s.along = $("along").value; redo(); });
for (const id of ["from", "to"]) $(id).addEventListener("change", () => {
  const { factor } = shownUnit(s.parameters[s.along].unit, s.units), now = s.ranges[s.along];
  const ends = ["from", "to"].map((k, i) => $(k).value === $(k).dataset.shown ? now[i] : Number($(k).value.replace("−", "-")) / factor);
  if (!(ends[0] < ends[1])) { problem("The range needs two rising numbers."); return showRange(); }
  s.ranges[s.along] = ends;
  redo();
});
for (const [i, id] of ["map-x", "map-y"].entries()) $(id).addEventListener("change", () => {
  if (s.map[1 - i] === $(id).value) { s.map[1 - i] = s.map[i]; $(i ? "map-x" : "map-y").value = s.map[i]; }
  s.map[i] = $(id).value;
  plots.map.zoom = null;
  settled();
});
$("motion").addEventListener("change", () => {
  const [kind, ...rest] = $("motion").value.split(" ");
  if (kind === "mode") [s.shown, s.mode] = ["mode", Number(rest[0])];
  else [s.shown, s.disturb] = ["disturb", rest.join(" ")];
  settled();
});
for (const name of CARDS) $(name).addEventListener("toggle", () => {
  if (name !== "equations") askBeyond(name);
  else if ($(name).open) loadEquations();
  history.replaceState(null, "", link());
});
fileDialog(async () => s.subject ? (await request("api/download", { ...body(s.values), kind: "toml" })).text() : "",
  text => open({ toml: text }));
$("downloads").addEventListener("keydown", event => {
  if (event.key !== "Escape") return;
  $("downloads").open = false;
  $("downloads").querySelector("summary").focus();
});
document.addEventListener("click", event => { if (!$("downloads").contains(event.target)) $("downloads").open = false; });
addEventListener("hashchange", () => { if (!s.subject || location.hash !== link()) restore(); });

ask("api/vehicles").then(({ vehicles }) => $("vehicles").replaceChildren(...vehicles.map(v => new Option(`${v.title} (${v.model})`, v.name))),
  error => problem(error.message));
restore();
