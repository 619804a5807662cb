// SPDX-License-Identifier: Apache-2.0
// A worker for pages that are opened from a file: browsers start no Worker there, so the script runs in a hidden frame.
// The search of the documentation uses it; pages of a web server have a real Worker.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      const started = new Promise((resolve) => {
        document.addEventListener("DOMContentLoaded", resolve);
        if (document.readyState !== "loading") resolve();
      }).then(() => {
        document.body.append(this.frame);
        return this.start(url);
      });
      this.started = started;
    }

    // Give the frame what the script expects of a worker, then load the script.
    start(url) {
      const inner = this.frame.contentWindow;
      const load = (source) =>
        new Promise((resolve, reject) => {
          const script = inner.document.createElement("script");
          script.src = source;
          script.onload = resolve;
          script.onerror = reject;
          inner.document.head.append(script);
        });
      inner.importScripts = (...sources) => sources.reduce((before, each) => before.then(() => load(each)), Promise.resolve());
      inner.postMessage = (data) => {
        const message = new MessageEvent("message", { data });
        this.dispatchEvent(message);
        this.onmessage?.(message);
      };
      return load(url);
    }

    postMessage(data) {
      this.started.then(() => {
        const inner = this.frame.contentWindow;
        inner.dispatchEvent(new inner.MessageEvent("message", { data }));
      });
    }

    terminate() {
      this.started.then(() => this.frame.remove());
    }
  };
}
