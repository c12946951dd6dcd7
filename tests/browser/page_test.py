"""The page in a real browser: from a log, from the live bus, and with browsers that misbehave."""

import json
import os
import socket
import tempfile
import threading
import time
import unittest
import urllib.request
from pathlib import Path

from PIL import Image

from game import Game, View
from web_driver import Browser

SHOWN = "return Number(document.getElementById(arguments[0]).dataset.shown || 0)"
TEXT = "return document.getElementById(arguments[0]).textContent"
STATE = "return fetch('state').then((reply) => reply.json())"
ARROW_RIGHT = "\ue014"

# Hides all marks but the ellipse, which is then the only thing in its colour.
ONLY_ELLIPSE = """
  localStorage.setItem('puck-view', JSON.stringify({theme: 'dark', windowUs: 100, hidden: [
    'regions', 'velocity', 'covariance', 'trail', 'truth', 'close-up', 'words', 'legend']}));
  location.reload();
"""
# The middle of the ellipse's pixels, and the size of the picture.
ELLIPSE = """
  const canvas = document.getElementById(arguments[0]);
  const {width, height} = canvas;
  const copy = Object.assign(document.createElement('canvas'), {width, height});
  const context = copy.getContext('2d', {willReadFrequently: true});
  context.drawImage(canvas, 0, 0);
  const {data} = context.getImageData(0, 0, width, height);
  const [xs, ys] = [[], []];
  for (let i = 0; i < data.length; i += 4) {
    if (Math.min(data[i], data[i + 1], data[i + 2]) < 200) continue;
    xs.push((i / 4) % width);
    ys.push(Math.floor(i / 4 / width));
  }
  const middle = (all) => (Math.min(...all) + Math.max(...all)) / 2;
  return {x: middle(xs), y: middle(ys), pixels: xs.length, width, height};
"""


def setUpModule():
    global folder, log
    folder = tempfile.TemporaryDirectory()
    with Game(folder.name) as game:
        time.sleep(8)
    log = game.log


def tearDownModule():
    folder.cleanup()


def sensor_place(seen, state):
    """Where the ellipse is in the sensor's picture, which fills the canvas as far as its shape allows."""
    scale = min(seen["width"] / state["width"], seen["height"] / state["height"])
    left = (seen["width"] - scale * state["width"]) / 2
    top = (seen["height"] - scale * state["height"]) / 2
    return (seen["x"] - left + 0.5) / scale - 0.5, (seen["y"] - top + 0.5) / scale - 0.5


class PageCase(unittest.TestCase):
    def check_ellipse(self, browser, tolerance_px):
        """The state and the picture may be some ms apart on a live bus: tries again."""
        for _ in range(20):
            state = browser.run(STATE)
            seen = browser.run(ELLIPSE, "picture-0")
            estimate = state["estimates"][0]
            if seen["pixels"] and estimate["x_px"] is not None:
                x, y = sensor_place(seen, state)
                off = max(abs(x - estimate["x_px"]), abs(y - estimate["y_px"]))
                if off <= tolerance_px:
                    return
                last = f"drawn at {x:.1f}, {y:.1f}; estimate {estimate}"
            else:
                last = f"no ellipse: {seen}, {estimate}"
            time.sleep(0.2)
        self.fail(last)

    def check_console(self, browser):
        self.assertEqual(browser.console(), [])


class RecordedPage(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.view = View(log, log=f"{folder.name}/view.log")

    @classmethod
    def tearDownClass(cls):
        assert cls.view.stop() == 0

    def control(self, **fields):
        request = urllib.request.Request(f"{self.view.url}control", json.dumps(fields).encode(),
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=20) as reply:
            self.assertEqual(json.load(reply)["problem"], "")

    def state(self):
        with urllib.request.urlopen(f"{self.view.url}state", timeout=20) as reply:
            return json.load(reply)

    def settle(self, seconds):
        """Paused at this time."""
        self.control(action="pause")
        self.control(action="tracker", side=1, name="off")
        self.control(action="seek", value=seconds)
        end = time.monotonic() + 30
        while True:
            state = self.state()
            if state["playback"]["activity"] == "paused" and abs(state["seconds"] - seconds) < 0.02:
                return state
            self.assertLess(time.monotonic(), end, state["playback"])
            time.sleep(0.05)

    def test_the_page_plays_a_log_without_an_error(self):
        self.settle(0.5)
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait("return document.getElementById('source').textContent")
            browser.press(" ")
            browser.wait("return Number(document.getElementById('picture-0').dataset.shown) > 20")
            browser.wait("return Number(document.getElementById('table').dataset.shown) > 5")
            self.assertEqual(browser.run(TEXT, "source"), "game.lcm")
            self.assertIn("tracking", browser.wait(TEXT, "track"))
            self.check_console(browser)

    def test_the_ellipse_is_drawn_where_the_estimate_says(self):
        with Browser() as browser:
            browser.open(self.view.url)
            browser.run(ONLY_ELLIPSE)
            for seconds in (3.0, 4.5):
                self.settle(seconds)
                self.check_ellipse(browser, 1.5)

    def test_keys_pause_seek_and_step(self):
        self.settle(1)
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait(TEXT, "source")
            browser.press(".")
            browser.wait(f"return {STATE[7:]}.then((s) => Math.abs(s.seconds - 1.01) < 0.005)")
            browser.press(ARROW_RIGHT)
            browser.wait(f"return {STATE[7:]}.then((s) => Math.abs(s.seconds - 2.01) < 0.02)")
            browser.press(" ")
            browser.wait(f"return {STATE[7:]}.then((s) => s.seconds > 2.2)")
            browser.press(" ")
            browser.wait(f"return {STATE[7:]}.then((s) => s.playback.activity === 'paused')")
            at = self.state()["seconds"]
            shown = browser.run(SHOWN, "picture-0")
            time.sleep(1)
            self.assertEqual(self.state()["seconds"], at)
            # A paused picture is not drawn again and again.
            self.assertLessEqual(browser.run(SHOWN, "picture-0") - shown, 2)
            self.check_console(browser)

    def test_a_click_on_the_timeline_seeks(self):
        self.settle(1)
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait("return fetch('timeline').then((r) => r.json()).then((t) => t.complete)")
            time.sleep(1.5)  # The page asks once a second.
            browser.run("""
              const timeline = document.getElementById('timeline');
              const box = timeline.getBoundingClientRect();
              const at = {clientX: box.left + box.width / 2, clientY: box.top + 5, pointerId: 1,
                          bubbles: true, isPrimary: true};
              timeline.setPointerCapture = () => {};
              timeline.dispatchEvent(new PointerEvent('pointerdown', at));
            """)
            length = browser.run("return fetch('timeline').then((r) => r.json()).then((t) => t.seconds)")
            browser.wait(f"return {STATE[7:]}.then((s) => Math.abs(s.seconds - arguments[0]) < 0.1)",
                         length / 2)

    def test_two_trackers_are_shown_side_by_side(self):
        self.settle(2)
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait(TEXT, "source")
            self.assertTrue(browser.run("return document.getElementById('picture-1').hidden"))
            browser.press("b")
            browser.wait("return Number(document.getElementById('picture-1').dataset.shown) > 0")
            browser.press("b")
            browser.wait("return document.getElementById('picture-1').hidden")
            self.check_console(browser)

    def test_the_picture_is_saved_by_the_browser_as_png(self):
        self.settle(2)
        with tempfile.TemporaryDirectory() as downloads, Browser() as browser:
            browser.keep_downloads(downloads)
            browser.open(self.view.url)
            browser.wait(SHOWN, "picture-0")
            browser.press("i")
            saved = Path(downloads, "game-0002.0000s.png")
            end = time.monotonic() + 20
            while not saved.exists():
                self.assertLess(time.monotonic(), end, os.listdir(downloads))
                time.sleep(0.05)
            with Image.open(saved) as picture:
                shown = browser.run("const {width, height} = document.getElementById('picture-0'); return [width, height]")
                self.assertEqual(list(picture.size), shown)

    def test_every_key_is_in_the_help_and_does_something_without_an_error(self):
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait(TEXT, "source")
            browser.press("?")
            self.assertTrue(browser.wait("return document.getElementById('help').open"))
            keys = browser.run("return [...document.querySelectorAll('#help kbd')].map((k) => k.textContent)")
            self.assertGreater(len(keys), 20)
            browser.press("\ue00c")
            browser.wait("return !document.getElementById('help').open")
            for key in keys:
                if len(key) == 1 and key.isascii():
                    browser.press(key)
                    time.sleep(0.1)
            browser.press("\ue00c")
            self.check_console(browser)
        self.settle(1)

    def test_light_and_dark_and_small_screens_show_all_parts(self):
        for size in ((1280, 720), (800, 600)):
            with Browser(*size) as browser:
                browser.open(self.view.url)
                browser.wait(TEXT, "source")
                theme = browser.run("return document.documentElement.dataset.theme")
                browser.press("d")
                browser.wait("return document.documentElement.dataset.theme !== arguments[0]", theme)
                for part in ("picture-0", "table", "charts", "timeline", "play"):
                    box = browser.run("""
                      const box = document.getElementById(arguments[0]).getBoundingClientRect();
                      return [box.left, box.top, box.right, box.bottom];""", part)
                    self.assertGreaterEqual(min(box), 0, (size, part))
                    self.assertLessEqual(box[2], size[0], part)
                    self.assertLessEqual(box[3], size[1], part)
                    self.assertGreater(box[3] - box[1], 20, part)

    def test_a_browser_that_stops_reading_does_not_grow_the_server(self):
        self.settle(1)
        self.control(action="play")
        stuck = []
        request = b"GET /picture?width=1920&height=1080 HTTP/1.1\r\nHost: localhost\r\n\r\n"
        before_mb = self.view.resident_mb()
        for _ in range(8):
            client = socket.create_connection(("127.0.0.1", self.view.port))
            client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, b"\x01" + b"\0" * 15)
            try:
                for _ in range(200):
                    client.sendall(request)
            except OSError:
                pass
            stuck.append(client)
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait("return Number(document.getElementById('picture-0').dataset.shown) > 30")
        self.assertLess(self.view.resident_mb() - before_mb, 60)
        for client in stuck:
            client.close()

    def test_three_viewers_at_once_all_get_pictures(self):
        self.settle(1)
        shown = [0, 0, 0]

        def look(i):
            with Browser(800, 600) as browser:
                browser.open(self.view.url)
                browser.wait(TEXT, "source")
                ready.wait()
                before = browser.run(SHOWN, "picture-0")
                time.sleep(3)
                shown[i] = browser.run(SHOWN, "picture-0") - before

        ready = threading.Barrier(4, timeout=60)
        viewers = [threading.Thread(target=look, args=(i,)) for i in range(3)]
        for viewer in viewers:
            viewer.start()
        ready.wait()
        self.control(action="play")
        for viewer in viewers:
            viewer.join()
        self.assertGreater(min(shown), 3, shown)

    def test_a_page_of_another_origin_is_refused(self):
        request = urllib.request.Request(f"{self.view.url}control", b'{"action": "play"}', headers={
            "Content-Type": "application/json", "Origin": "http://evil.example"})
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(request, timeout=20)
        self.assertEqual(refused.exception.code, 403)
        refused.exception.close()


class LivePage(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.live_folder = tempfile.TemporaryDirectory()
        cls.game = Game(cls.live_folder.name)
        cls.view = View("--lcm-url", cls.game.bus, log=f"{folder.name}/live.log")

    @classmethod
    def tearDownClass(cls):
        assert cls.view.stop() == 0
        cls.live_folder.cleanup()

    def test_a_silent_bus_is_told_as_puck_doctor_tells_it_and_a_game_appears(self):
        with Browser() as browser:
            browser.open(self.view.url)
            browser.wait("return document.getElementById('messages').textContent"
                         ".includes('services: no STATUS of any service')", seconds=30)
            with self.game:
                browser.wait("return Number(document.getElementById('picture-0').dataset.shown) > 20")
                browser.wait("return Number(document.getElementById('table').dataset.shown) > 5")
                browser.wait("return document.getElementById('services-button').textContent"
                             ".includes('5 services')")
                browser.press("s")
                services = browser.wait(TEXT, "services")
                for name in ("puck-camera", "puck-tracker", "puck-bridge", "puck-arm", "puck-logger",
                             "PUCK_EVENTS", "packet_to_estimate"):
                    self.assertIn(name, services)
                browser.press("s")
                browser.run(ONLY_ELLIPSE)
                browser.wait("return Number(document.getElementById('picture-0').dataset.shown) > 5")
                self.check_ellipse(browser, 4)
                self.check_console(browser)


if __name__ == "__main__":
    unittest.main(verbosity=2)
