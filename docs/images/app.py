"""Draw the picture of the explorer: ``python docs/images/app.py``, with Playwright and a Chromium.

The words of the page are kept inside the file, for a test to compare with those of the page as it is.
"""

import json
import runpy
import threading
from pathlib import Path

import uvicorn
from PIL import Image
from PIL.PngImagePlugin import PngInfo
from playwright.sync_api import sync_playwright

from ucrit.web.routes import application
from ucrit.web.serve import listen

PICTURE = Path(__file__).with_name("app.png")
LINK = "#v=caravan&units=kmh&p.c=7000&pin.c=4000"
SIZE = {"width": 1360, "height": 1000}


def wait(page):
    """Wait until everything on the page is there, and show the motion at a moment in its middle."""
    for place in ("#film .body", "#map .design", "#sure:not(:empty)", "#remedies button"):
        page.wait_for_selector(place)
    page.locator("#film .time").evaluate("e => { e.value = 40; e.dispatchEvent(new Event('input')); }")


def words(page):
    """Return the words and numbers of the page, those of its pictures among them."""
    return page.locator("header, main").evaluate_all("list => list.map(e => e.textContent.split(/\\s+/)).flat()")


def kept():
    """Return the words of the page when the picture was drawn."""
    with Image.open(PICTURE) as image:
        return json.loads(image.info["data"])


if __name__ == "__main__":
    listening = listen("127.0.0.1", 0)
    server = uvicorn.Server(uvicorn.Config(application(), log_level="error", access_log=False))
    threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True).start()
    with sync_playwright() as playwright:
        find = runpy.run_path(str(PICTURE.parents[2] / "tools" / "browser.py"))["find"]
        browser = playwright.chromium.launch(executable_path=find(), args=["--no-sandbox"])
        page = browser.new_page(viewport=SIZE, reduced_motion="reduce")
        page.goto(f"http://127.0.0.1:{listening.getsockname()[1]}/{LINK}")
        page.wait_for_selector("html[data-settled]", state="attached")
        wait(page)
        page.screenshot(path=PICTURE)
        data = PngInfo()
        data.add_text("data", json.dumps(words(page)), zip=True)
        browser.close()
    server.should_exit = True
    with Image.open(PICTURE) as image:
        image.load()
        image.save(PICTURE, pnginfo=data, optimize=True)
