// The vehicle in motion: outlines that the server placed, moved frame by frame.
import { read } from "./units.js";

const SVG = "http://www.w3.org/2000/svg";
const still = matchMedia("(prefers-reduced-motion: reduce)");

function make(name, parent, attributes) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return parent.appendChild(made);
}

export class Film {
  constructor(host) {
    host.innerHTML = `<svg class="film" role="img" hidden><g class="grid"></g><g class="world"></g></svg>
      <div class="bar small"><button type="button" class="play">Play</button>
      <input type="range" class="time" min="0" max="1" value="0" aria-label="Time of the motion"><output class="clock"></output></div>
      <p class="quiet caption"></p>`;
    this.svg = host.querySelector("svg");
    [this.button, this.slider, this.clock, this.told] = [".play", ".time", ".clock", ".caption"].map(c => host.querySelector(c));
    this.playing = false;
    this.wanted = !still.matches;
    this.seen = true;
    this.button.addEventListener("click", () => { this.wanted = !this.playing; this.play(this.wanted); });
    this.slider.addEventListener("input", () => { this.wanted = false; this.play(false); this.show(Number(this.slider.value)); });
    new IntersectionObserver(entries => { this.seen = entries.at(-1).isIntersecting; }).observe(host);
    this.refuse("");
  }

  refuse(sentence) {
    this.film = null;
    this.play(false);
    this.svg.toggleAttribute("hidden", true);
    this.button.parentElement.hidden = true;
    this.told.textContent = sentence;
  }

  set({ film, caption }) {
    const part = this.film ? this.frame / this.film.times.length : 0;
    this.film = film;
    this.svg.toggleAttribute("hidden", false);
    this.button.parentElement.hidden = false;
    this.svg.setAttribute("viewBox", `0 0 ${film.width} ${film.height}`);
    this.svg.setAttribute("aria-label", caption);
    const world = this.svg.querySelector(".world");
    world.replaceChildren();
    if (film.path) make("polyline", world, { class: "path", points: film.path.join(" ") });
    this.bodies = film.bodies.map(b => make(b.closed ? "polygon" : "polyline", world, { class: b.look }));
    this.slider.max = film.times.length - 1;
    const slower = film.seconds / (film.times.at(-1) - film.times[0]);
    const pace = slower > 1.05 ? `, shown ${read(slower, 2)} times as slow` : slower < 0.95 ? `, shown ${read(1 / slower, 2)} times as fast` : "";
    this.told.textContent = `${caption}${pace}. Lines of the grid are ${read(film.grid)} m apart.`;
    this.show(Math.floor(part * film.times.length));
    this.play(this.wanted);
  }

  show(k) {
    const film = this.film, [x, y] = film.centres[k];
    this.frame = k;
    this.svg.querySelector(".world").setAttribute("transform", `translate(${film.width / 2 - x} ${film.height / 2 - y})`);
    film.bodies.forEach((b, i) => this.bodies[i].setAttribute("points", b.corners[k].join(" ")));
    this.lines(x, y);
    this.clock.textContent = `${film.times[k].toFixed(2)} s`;
    this.slider.value = k;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
  }

  lines(x, y) {
    const { grid: step, width: w, height: h } = this.film;
    let d = "";
    for (let i = Math.ceil((x - w / 2) / step); i * step < x + w / 2; i++) d += `M${i * step - x + w / 2} 0v${h}`;
    for (let i = Math.ceil((y - h / 2) / step); i * step < y + h / 2; i++) d += `M0 ${i * step - y + h / 2}h${w}`;
    this.svg.querySelector(".grid").innerHTML = `<path d="${d}"/>`;
  }

  play(on) {
    this.button.textContent = on ? "Pause" : "Play";
    if (on && !this.playing) requestAnimationFrame(now => this.tick(now, null));
    this.playing = on;
  }

  tick(now, last) {
    if (!this.playing || !this.film) return;
    const film = this.film, count = film.times.length;
    if (last === null) this.phase = this.frame / (count - 1);
    else if (this.seen) {
      this.phase = (this.phase + (now - last) / 1000 / film.seconds) % 1.15; // the last frame stays for a moment
      const k = Math.min(Math.round(this.phase * (count - 1)), count - 1);
      if (k !== this.frame) this.show(k);
    }
    requestAnimationFrame(later => this.tick(later, now));
  }
}
