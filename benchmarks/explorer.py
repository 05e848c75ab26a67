"""The explorer in a headless Chromium: from the move of a slider to the frame that shows the new root locus."""

from __future__ import annotations

import runpy
import statistics
import threading
from pathlib import Path

from benchmarks.timing import Row

STEPS = 60
LIMIT = 0.050
"""Seconds from slider to picture, median, on the caravan, which is of fourth order."""

DRAG = """async steps => {
  const slider = document.querySelector("input[data-name=a]"), root = document.documentElement, times = [];
  const drawn = () => new Promise(done => new MutationObserver((_, seen) => {
    seen.disconnect();
    requestAnimationFrame(done);
  }).observe(root, { attributes: true, attributeFilter: ["data-drawn"] }));
  for (let k = 0; k < steps; k++) {
    const start = performance.now(), wait = drawn();
    slider.value = Number(slider.min) + 40 + 2 * k;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await wait;
    times.push((performance.now() - start) / 1000);
  }
  return times;
}"""


def latency() -> list[Row]:
    """Drag a slider step by step; without a Chromium the line says so and misses nothing."""
    browser = runpy.run_path(str(Path(__file__).parents[1] / "tools" / "browser.py"))["find"]()
    rows = [Row("\nExplorer, from slider to picture, by the clock")]
    try:
        import uvicorn
        from playwright.sync_api import sync_playwright

        from ucrit.web.routes import application
        from ucrit.web.serve import listen
    except ImportError as error:
        return [*rows, Row(f"  not measured: {error.name} is not installed")]
    if browser is None:
        return [*rows, Row("  not measured: there is no Chromium")]
    listening = listen("127.0.0.1", 0)
    server = uvicorn.Server(uvicorn.Config(application(), log_level="error", access_log=False))
    threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True).start()
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        page = chromium.new_page(viewport={"width": 1300, "height": 900})
        page.goto(f"http://127.0.0.1:{listening.getsockname()[1]}/#v=caravan")
        page.wait_for_selector("html[data-settled]", state="attached")
        page.evaluate(DRAG, 10)
        times = sorted(page.evaluate(DRAG, STEPS))
        chromium.close()
    server.should_exit = True
    median, late = statistics.median(times), times[int(0.95 * len(times))]
    note = f"(limit {1e3 * LIMIT:.0f} ms; 95 % within {1e3 * late:.0f} ms)"
    return [*rows, Row("slider to redrawn root locus, 4th-order trailer", median, ok=median <= LIMIT, note=note)]
