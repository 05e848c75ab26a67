// A row for each parameter: slider, exact number, unit, reset. Sliders move in round steps of the shown unit.
import { plain, quantity, roundStep, shownUnit } from "./units.js";

const STEPS = 400;

function knownWords({ known: { sd, range }, unit }, value, system) {
  const say = v => quantity(v, unit, system);
  if (range && !(range[0] <= value && value <= range[1])) return `outside of the file's ${say(range[0])} to ${say(range[1])}`;
  return [sd && `standard deviation ${say(sd)}`, range && `between ${say(range[0])} and ${say(range[1])}`].filter(Boolean).join(", ");
}

export class Panel {
  // changed(name, value): a number in SI, or a text with a unit, which the server reads
  constructor(form, changed) {
    Object.assign(this, { form, changed, rows: {} });
    form.addEventListener("submit", event => event.preventDefault());
  }

  build(parameters, ranges, system) {
    this.system = system;
    this.rows = {};
    this.form.innerHTML = parameters.map((p, i) => `<div class="row" role="group" aria-label="${p.name}">
      <label for="s${i}"><span class="symbol">${p.symbol}</span> <span class="meaning"></span></label>
      <input type="range" id="s${i}" data-name="${p.name}">
      <input type="text" id="n${i}" class="exact" inputmode="decimal" autocomplete="off" spellcheck="false" aria-describedby="u${i} e${i}">
      <span class="unit" id="u${i}"></span>
      <button type="button" class="undo" hidden>↺</button>
      <p class="known" hidden></p>
      <p class="wrong" id="e${i}" role="alert"></p></div>`).join("");
    parameters.forEach((about, i) => this.row(about, this.form.children[i], ranges[about.name], i));
  }

  row(about, element, range, i) {
    const [slider, field] = element.querySelectorAll("input"), undo = element.querySelector("button");
    const known = element.querySelector(".known"), row = { about, element, known, slider, field, undo, range: [...range], unit: shownUnit(about.unit, this.system) };
    element.querySelector(".meaning").textContent = about.meaning;
    element.querySelector(".unit").textContent = row.unit.text;
    known.hidden = !about.known;
    slider.setAttribute("aria-label", `${about.meaning} ${about.name}, slider`);
    field.setAttribute("aria-label", `${about.meaning} ${about.name}, exact value${row.unit.text ? " in " + row.unit.text : ""}`);
    field.title = `${about.allowed}; another unit may stand behind the number`;
    undo.setAttribute("aria-label", `Reset ${about.meaning} ${about.name}`);
    slider.addEventListener("input", () => this.changed(about.name, Number((slider.value * row.step).toPrecision(12)) / row.unit.factor));
    field.addEventListener("change", () => this.typed(row));
    field.addEventListener("keydown", event => { if (event.key === "Enter") { event.preventDefault(); this.typed(row); } });
    undo.addEventListener("click", () => { this.changed(about.name, about.value); field.focus(); });
    this.rows[about.name] = row;
    this.span(row);
  }

  typed(row) {
    const text = row.field.value.trim().replace("−", "-");
    if (text === row.written) return; // what was shown is not what is stored: an untouched field changes nothing
    row.written = text;
    const value = text === "" ? NaN : Number(text);
    this.changed(row.about.name, Number.isNaN(value) ? text : value / row.unit.factor);
  }

  span(row) {
    const [low, high] = row.range.map(v => v * row.unit.factor);
    row.step = roundStep((high - low) / STEPS);
    row.slider.min = Math.ceil(low / row.step - 1e-9);
    row.slider.max = Math.floor(high / row.step + 1e-9);
    row.slider.step = 1;
  }

  // Show values; a slider whose value lies outside of it is stretched. Returns the names of those.
  show(values, moving) {
    const stretched = [];
    for (const [name, row] of Object.entries(this.rows)) {
      const value = values[name];
      if (value < row.range[0] || value > row.range[1]) {
        const above = 1.25 * value, [low, high] = row.range;
        row.range = value > 0 ? [Math.min(low, value), Math.max(high, above)] : [Math.min(low, above), Math.max(high, value)];
        this.span(row);
        stretched.push(name);
      }
      if (name !== moving || document.activeElement !== row.slider) row.slider.value = Math.round(value * row.unit.factor / row.step);
      row.slider.setAttribute("aria-valuetext", quantity(value, row.about.unit, this.system, 6));
      row.written = plain(value * row.unit.factor, 9);
      row.field.value = row.written;
      if (row.about.known) row.known.textContent = knownWords(row.about, value, this.system);
      row.undo.hidden = value === row.about.value;
      row.element.classList.toggle("moved", value !== row.about.value);
      this.mend(row);
    }
    return stretched;
  }

  // Say what is wrong beside the field that was changed last; false where there is no such field.
  refuse(name, sentence) {
    const row = this.rows[name];
    if (!row) return false;
    row.field.setAttribute("aria-invalid", "true");
    row.element.querySelector(".wrong").textContent = sentence;
    row.undo.hidden = false;
    return true;
  }

  mend(row) {
    row.field.removeAttribute("aria-invalid");
    row.element.querySelector(".wrong").textContent = "";
  }
}
