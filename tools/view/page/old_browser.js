// Plain JavaScript of 2009, which any browser can run.
(function () {
  var has = Array.prototype.at && window.createImageBitmap && window.HTMLDialogElement &&
    window.ResizeObserver && window.fetch && 'noModule' in document.createElement('script');
  if (has) return;
  document.body.textContent = 'This browser is too old for puck-view: it needs one of 2022 or ' +
    'later, such as Firefox 98, Chromium 92 or Safari 15.4.';
})();
