#!/usr/bin/python3
"""Makes the README's picture of puck-view: a screenshot of its page while a simulated game is played.

  tests/browser/picture.py docs/page.png

Needs tools/install-deps.sh --browser and the target puck_programs.
"""

import os
import sys
import tempfile

from PIL import Image

from game import Game, View
from web_driver import Browser

MOST_BYTES = 150_000
# A shot that the robot is going to meet, ten seconds after the start.
A_SHOT = """
  return fetch('state').then((reply) => reply.json()).then((state) => {
    const estimate = state.estimates[0];
    const y = state.samples.y[0];
    const errors = state.samples.error[0].filter((error) => error !== null);
    return y.at(-1) > y.at(-10) && Math.max(...errors) < 10 && state.seconds > 10 && estimate.state === 'tracking' && estimate.speed_px_s > 350
      && estimate.y_px > 120 && estimate.y_px < 300;
  });
"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    with tempfile.TemporaryDirectory() as folder, Game(folder) as game, Browser(1120, 640) as browser:
        view = View("--lcm-url", game.bus, log=f"{folder}/view.log")
        try:
            browser.open(view.url)
            browser.run("document.getElementById('messages').style.display = 'none'")
            browser.wait(A_SHOT, seconds=150)
            browser.screenshot(f"{folder}/page.png")
        finally:
            view.stop()
        picture = Image.open(f"{folder}/page.png").convert("RGB")
        for colours in (256, 128, 64, 32):
            # Keeps colours of few pixels, such as those of the marks.
            reduced = picture.quantize(colours, Image.Quantize.MAXCOVERAGE, kmeans=2,
                                       dither=Image.Dither.NONE)
            reduced.save(sys.argv[1], optimize=True)
            if os.path.getsize(sys.argv[1]) <= MOST_BYTES:
                break


if __name__ == "__main__":
    main()
