// Canvases that show the newest picture: one request at a time, so a slow line gets fewer pictures.

import { getPicture, pause } from './server.js';
import { settings } from './settings.js';

export class PictureFeed {
  constructor(canvas, view, side = 0) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.view = view;
    this.side = side;
    this.seen = 0;
    this.shown = 0; // Pictures so far.
    new ResizeObserver(() => this.renew()).observe(canvas);
    document.addEventListener('visibilitychange', () => this.renew());
    this.run();
  }

  // The wishes changed: do not wait for the next event.
  renew() {
    this.seen = 0;
    if (this.request) this.request.abort();
    if (this.wake) this.wake();
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
      this.request = new AbortController();
      const { signal } = this.request;
      const picture = await getPicture(this.query(), signal);
      if (picture && picture.blob) await this.show(picture, signal);
      else if (!picture && !signal.aborted) await pause(500);
    }
  }

  async show(picture, signal) {
    let bitmap;
    try {
      bitmap = await createImageBitmap(picture.blob);
    } catch {
      return; // Cut off.
    }
    if (!signal.aborted) {
      this.seen = picture.version;
      if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
        this.canvas.width = bitmap.width;
        this.canvas.height = bitmap.height;
      }
      this.context.drawImage(bitmap, 0, 0);
      ++this.shown;
      this.canvas.dataset.shown = this.shown;
    }
    bitmap.close();
  }
}
