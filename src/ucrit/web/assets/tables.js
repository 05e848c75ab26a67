// Words and tables of the page.
import { branchClass } from "./draw.js";
import { quantity, read } from "./units.js";

function cell(row, text, name = "") {
  const made = row.insertCell();
  made.textContent = text;
  made.className = name;
  return made;
}

export function criticalWords(list, answer, system) {
  const lines = answer.critical.map(c => {
    const at = c.hertz ? ` at ${read(c.hertz, 3)} Hz` : "", kind = c.kind === "order" ? "a root passes through infinity" : c.kind;
    return `${answer.locus?.parameter} = ${quantity(c.value, c.unit, system, 6)}: ${kind} of the ${c.mode.replace(/ divergence$/, " motion")}${at}, stable ${c.stable}`;
  });
  list.replaceChildren(...lines.map(text => Object.assign(document.createElement("li"), { textContent: text })));
}

export function modeRows(body, modes) {
  body.replaceChildren();
  for (const mode of modes) {
    const row = body.insertRow(), head = document.createElement("th");
    head.scope = "row";
    head.textContent = mode.name;
    row.append(head);
    cell(row, `${read(mode.re)}${mode.im ? ` ±\u00a0${read(mode.im)}\u00a0i` : ""}`, "n").dataset.value = `${mode.re} ${mode.im}`;
    cell(row, mode.im ? read(mode.frequency_hz) : "–", "n");
    cell(row, mode.im ? read(mode.damping_ratio, 3) : "–", "n");
    cell(row, mode.time_to_double !== null ? `doubles in ${read(mode.time_to_double, 3)}\u00a0s`
      : mode.time_to_half !== null ? `halves in ${read(mode.time_to_half, 3)}\u00a0s` : "stays", mode.re > 0 ? "grows" : "");
  }
}

export function remedyList(host, found, system, apply) {
  const held = host.contains(document.activeElement); // a click on a remedy replaces it; the keyboard stays here
  host.replaceChildren();
  if (held) host.focus();
  const say = text => host.append(Object.assign(document.createElement("p"), { textContent: text }));
  if (found.stable) return say("Nothing needs changing for this speed.");
  if (!found.remedies.length) return say("No change of one parameter alone makes it stable.");
  say("Each is enough by itself, the smallest change first; a click makes it.");
  const list = host.appendChild(document.createElement("ul"));
  list.className = "remedies";
  for (const r of found.remedies) {
    const button = document.createElement("button"), item = list.appendChild(document.createElement("li"));
    button.type = "button";
    button.dataset.parameter = r.parameter;
    button.innerHTML = `${r.symbol} <span></span>`; // the server's own symbol
    button.querySelector("span").textContent =
      `${r.meaning}: ${r.word} ${quantity(r.value, r.unit, system, 5)} instead of ${quantity(r.present, r.unit, system)} (${r.change})`;
    button.addEventListener("click", () => apply(r.parameter, r.value));
    item.append(button);
  }
}

export function comparison(host, pinned, answer, parameters, system) {
  const table = document.createElement("table");
  table.innerHTML = '<thead><tr><th scope="col">what</th><th scope="col">pinned</th><th scope="col">now</th></tr></thead><tbody></tbody>';
  const add = (title, before, after) => {
    const row = table.tBodies[0].insertRow(), head = document.createElement("th");
    head.scope = "row";
    head.textContent = title;
    row.append(head);
    cell(row, before);
    cell(row, after);
  };
  add("verdict", pinned.word, answer.word);
  for (const [name, about] of Object.entries(parameters))
    if (pinned.values[name] !== answer.values[name])
      add(`${name}, ${about.meaning}`, quantity(pinned.values[name], about.unit, system, 6), quantity(answer.values[name], about.unit, system, 6));
  const list = a => a.critical.map(c => `${quantity(c.value, c.unit, system, 5)} (${c.kind})`).join(", ") || "none";
  add(`critical ${answer.locus?.parameter ?? "values"}`, list(pinned), list(answer));
  const least = a => a.analysis.modes.filter(m => m.re || m.im)[0];
  const words = m => m ? `${m.name} ${read(m.re)}${m.im ? ` ± ${read(m.im)} i` : ""} 1/s` : "none";
  add("least stable mode", words(least(pinned)), words(least(answer)));
  host.replaceChildren(table);
}

export function legend(host, answer, pinned) {
  const named = new Map((answer.locus?.branches || []).map(b => [b.index, b.name]));
  const html = [...named].map(([index]) => `<li><svg viewBox="0 0 30 10" aria-hidden="true"><path class="line ${branchClass(index)}" d="M0 5H30"/></svg> <span></span></li>`);
  if (pinned) html.push('<li><svg viewBox="0 0 30 10" aria-hidden="true"><path class="line pinned" d="M0 5H30"/></svg> pinned</li>');
  if (named.size) html.push('<li><svg viewBox="0 0 30 10" aria-hidden="true"><path class="design" d="M15 0l5 5l-5 5l-5 -5z"/></svg> the vehicle</li>');
  const key = html.join("") + [...named.values()];
  if (host.dataset.key === key) return;
  host.dataset.key = key;
  host.innerHTML = html.join("");
  host.querySelectorAll("span").forEach((span, i) => { span.textContent = [...named.values()][i]; });
}
