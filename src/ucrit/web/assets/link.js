// The state of the page as a link, in its fragment, which no browser sends to a server. Numbers in full.
import { Problem } from "./ask.js";
import { SYSTEMS } from "./units.js";

const TEXTS = ["v", "toml", "along", "x", "y", "mode", "disturb", "units", "open"];
const CARDS = ["handling", "cycles", "equations"];
const NUMBERS = ["from", "to"];

export function write(state) {
  const found = new URLSearchParams();
  for (const key of TEXTS) if (state[key] !== undefined && state[key] !== null) found.set(key, state[key]);
  for (const key of NUMBERS) if (state[key] !== undefined) found.set(key, String(state[key]));
  for (const [name, value] of Object.entries(state.values || {})) found.set("p." + name, String(value));
  for (const [name, value] of Object.entries(state.pin || {})) found.set("pin." + name, String(value));
  return "#" + found;
}

export function readLink(fragment) {
  const state = { values: {}, pin: null };
  for (const [key, text] of new URLSearchParams(fragment.replace(/^#/, ""))) {
    const [group, name] = key.includes(".") ? [key.slice(0, key.indexOf(".")), key.slice(key.indexOf(".") + 1)] : [key, ""];
    if (group === "p" && name) state.values[name] = number(key, text);
    else if (group === "pin" && name) (state.pin ||= {})[name] = number(key, text);
    else if (NUMBERS.includes(key)) state[key] = number(key, text);
    else if (TEXTS.includes(key)) state[key] = text;
    else throw new Problem(`The link cannot be read: it has an entry '${key.slice(0, 40)}' that this page does not know.`);
  }
  if (state.units !== undefined && !Object.hasOwn(SYSTEMS, state.units))
    throw new Problem(`The link cannot be read: there are no units '${state.units.slice(0, 40)}'.`);
  if (state.mode !== undefined && !/^\d{1,3}$/.test(state.mode))
    throw new Problem(`The link cannot be read: mode must be a whole number, got '${state.mode.slice(0, 40)}'.`);
  state.open = (state.open || "").split(",").filter(Boolean);
  for (const name of state.open) if (!CARDS.includes(name))
    throw new Problem(`The link cannot be read: there is nothing to open called '${name.slice(0, 40)}'.`);
  return state;
}

function number(key, text) {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!Number.isFinite(value))
    throw new Problem(`The link cannot be read: ${key.slice(0, 40)} must be a number, got '${text.slice(0, 40)}'.`);
  return value;
}
