"""The page in a real browser: from a log, from the live bus, and with browsers that misbehave."""

import json
import os
import socket
import tempfile
import time
import unittest
import urllib.request

from game import Game, View
from web_driver import Browser

SPACE = " "
# The mean place of the estimate's colour in the canvas of a picture, as [x, y, pixels]; marks but the
# ellipse are hidden.
ELLIPSE = """
  const canvas = document.getElementById(arguments[0]);
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let [x, y, count] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (Math.min(data[i], data[i + 1], data[i + 2]) < 200) continue;
    x += (i / 4) % canvas.width;
    y += Math.floor(i / 4 / canvas.width);
    ++count;
  }
  return [x / count, y / count, count, canvas.width, canvas.height];
"""
STATE = "return fetch('state').then((reply) => reply.json())"
SHOWN = "return Number(document.getElementById(arguments[0]).dataset.shown || 0)"
TEXT = "return document.getElementById(arguments[0]).textContent"
ONLY_ELLIPSE = """
  localStorage.setItem('puck-view', JSON.stringify({theme: 'dark', windowUs: 100, hidden: [
    'regions', 'velocity', 'covariance', 'trail', 'truth', 'words', 'legend']}));
  location.reload();
"""


def setUpModule():
    global folder, game, live, recorded, log_view
    folder = tempfile.TemporaryDirectory()
    game = Game(folder.name)
    with game:
        live = View("--lcm-url", game.bus, log=f"{folder.name}/live.log")
        LivePage.run_all()
        live.stop()
    log_view = View(game.log, log=f"{folder.name}/view.log")


def tearDownModule():
    log_view.stop()
    folder.cleanup()
"""
"""
