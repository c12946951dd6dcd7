// Canvases that show the newest picture: one request at a time, so a slow line gets fewer pictures.

import { getPicture, pause } from './server.js';
import { settings } from './settings.js';

const kHeld_ms = 60; // A request that is not answered by then waits for news.

export class PictureFeed {
  constructor(canvas, view, side = 0) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.view = view;
    this.side = side;
    this.seen = 0;
    this.shown = 0; // Pictures so far.
    this.changes = 0; // Of the wishes.
    this.requested = 0; // Changes that the request knows.
    this.request = null;
    this.renewal = null;
    new ResizeObserver(() => this.renew()).observe(canvas);
    document.addEventListener('visibilitychange', () => this.renew());
    this.run();
  }

  // The wishes changed: do not wait for the next event. A request that is answered soon is left alone.
  renew() {
    this.seen = 0;
    ++this.changes;
    if (this.wake) this.wake();
    if (this.renewal) return;
    this.renewal = setTimeout(() => {
      this.renewal = null;
      if (this.request && this.requested !== this.changes) this.request.abort();
    }, kHeld_ms);
  }

  get isVisible() {
    return !document.hidden && this.canvas.clientWidth > 0 && this.canvas.clientHeight > 0;
  }

  query() {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    return new URLSearchParams({
      view: this.view,
      side: this.side,
      backdrop: settings.backdrop,
      theme: settings.theme,
      window_us: settings.windowUs,
      width: Math.round(this.canvas.clientWidth * scale),
      height: Math.round(this.canvas.clientHeight * scale),
      hide: settings.hidden.join(','),
      seen: this.seen,
    });
  }

  async run() {
    for (;;) {
      if (!this.isVisible) {
        await new Promise((wake) => { this.wake = wake; });
        continue;
      }
      const request = new AbortController();
      this.request = request;
      const { changes } = this;
      this.requested = changes;
      const picture = await getPicture(this.query(), request.signal);
      this.request = null;
      if (picture && picture.blob) await this.show(picture, changes);
      else if (!picture && !request.signal.aborted) await pause(500);
    }
  }

  async show(picture, changes) {
    let bitmap;
    try {
      bitmap = await createImageBitmap(picture.blob);
    } catch {
      return; // Cut off.
    }
    if (changes === this.changes) this.seen = picture.version;
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
    }
    this.context.drawImage(bitmap, 0, 0);
    bitmap.close();
    ++this.shown;
    this.canvas.dataset.shown = this.shown;
  }
}
