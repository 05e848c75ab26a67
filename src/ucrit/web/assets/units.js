// Units on the page. Values are kept in SI; only what is shown is converted.
export const SYSTEMS = { si: "SI", kmh: "km/h, degrees", mph: "mph, degrees" };
const SUPERSCRIPT = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
const DEGREES = 180 / Math.PI;

export const raised = text => text.replace(/\^(-?\d+)/g, (_, power) => [...power].map(c => SUPERSCRIPT[c]).join(""));

// What a unit is shown as: shown value = SI value * factor.
export function shownUnit(unit, system) {
  if (unit === "1") return { factor: 1, text: "" };
  if (system === "si") return { factor: 1, text: raised(unit) };
  if (unit === "m/s") return system === "kmh" ? { factor: 3.6, text: "km/h" } : { factor: 1 / 0.44704, text: "mph" };
  let factor = 1;
  for (const [, sign, name, power] of unit.matchAll(/(\/?)\s*([A-Za-z]+|1)(?:\^(-?\d+))?/g))
    if (name === "rad") factor *= DEGREES ** ((sign ? -1 : 1) * Number(power || 1));
  return { factor, text: raised(unit.replace(/\brad\b/g, "deg")) };
}

// A number as it is typed: up to so many digits, no trailing zeros, read back by Number().
export function plain(value, digits = 10) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : "";
}

// A number as it is read: a true minus sign, powers of ten written out.
export function read(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const [mantissa, exponent] = plain(value, digits).split("e");
  const power = exponent ? "·10" + [...exponent.replace("+", "")].map(c => SUPERSCRIPT[c]).join("") : "";
  return mantissa.replace("-", "−") + power;
}

export function quantity(value, unit, system, digits = 4) {
  const { factor, text } = shownUnit(unit, system);
  return read(value * factor, digits) + (text ? "\u00a0" + text : "");
}

// The largest of 1, 2, 5 times a power of ten that is not above a value.
export function roundStep(value) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  return [5, 2, 1].find(step => step * power <= value * (1 + 1e-9)) * power;
}
