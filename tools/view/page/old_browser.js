document.body.textContent =
  'This browser is too old for puck-view: it needs one of 2020 or later, such as Firefox 80 or Chromium 80.';
