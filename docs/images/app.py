"""Draw the picture of the explorer: ``python docs/images/app.py``, with Playwright and a Chromium."""

import runpy
import threading
from pathlib import Path

import uvicorn
from playwright.sync_api import sync_playwright

from ucrit.web.routes import application
from ucrit.web.serve import listen

HERE = Path(__file__).parent

if __name__ == "__main__":
    listening = listen("127.0.0.1", 0)
    server = uvicorn.Server(uvicorn.Config(application(), log_level="error", access_log=False))
    threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True).start()
    with sync_playwright() as playwright:
        find = runpy.run_path(str(HERE.parents[1] / "tools" / "browser.py"))["find"]
        browser = playwright.chromium.launch(executable_path=find(), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1360, "height": 1000}, reduced_motion="reduce")
        link = "#v=caravan&units=kmh&p.c=7000&pin.c=4000"
        page.goto(f"http://127.0.0.1:{listening.getsockname()[1]}/{link}")
        page.wait_for_selector("html[data-settled]", state="attached")
        page.wait_for_selector("#film .body")
        page.wait_for_selector("#map .design")
        page.wait_for_selector("#sure:not(:empty)")
        page.locator("#film .time").evaluate("e => { e.value = 40; e.dispatchEvent(new Event('input')); }")
        page.screenshot(path=HERE / "app.png")
        browser.close()
    server.should_exit = True
