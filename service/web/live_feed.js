"use strict";
// Event streams that come back by themselves.
const gyrodFeed = (() => {
  const kRetry_ms = 2000;

  /// Reads `url` until close(). handlers: {event name: f(data)}; opened() before the first event of each connection;
  /// lost(reason) whenever the connection is gone, again and again until it is back. A stream that says nothing for `silence_s` counts as lost;
  /// 0: silence is all right.
  function open(url, { handlers, opened = () => {}, lost = () => {}, silence_s = 0 }) {
    let source = null;
    let timer = 0;
    let watch = 0;
    let closed = false;

    function heard() {
      clearTimeout(watch);
      if (silence_s > 0) watch = setTimeout(() => again("nothing heard"), 1000 * silence_s);
    }

    function again(reason) {
      source.close();
      clearTimeout(watch);
      clearTimeout(timer);
      lost(reason);
      if (!closed) timer = setTimeout(connect, kRetry_ms);
    }

    function connect() {
      if (closed) return;
      const mine = (source = new EventSource(url));
      heard();
      mine.onopen = () => {
        heard();
        opened();
      };
      mine.onerror = async () => {
        if (mine !== source || closed) return;
        mine.close();
        again(await reasonOf(url));
      };
      for (const [name, handle] of Object.entries(handlers)) {
        mine.addEventListener(name, (event) => {
          if (closed || mine !== source) return;
          heard();
          handle(JSON.parse(event.data));
        });
      }
    }

    connect();
    return {
      close() {
        closed = true;
        clearTimeout(watch);
        clearTimeout(timer);
        source.close();
      },
    };
  }

  /// An EventSource does not tell why it was refused: asked again, without the stream, the daemon says so.
  async function reasonOf(url) {
    try {
      const answer = await fetch(url.replace(/\/stream\b.*$/, url.includes("/channels/") ? "" : "/status"), { signal: AbortSignal.timeout(2000) });
      if (answer.ok) return "the stream ended";
      return (await answer.json()).error ?? `status ${answer.status}`;
    } catch {
      return "no answer";
    }
  }

  async function json(url) {
    const answer = await fetch(url, { signal: AbortSignal.timeout(5000) });
    const body = await answer.json();
    if (!answer.ok) throw new Error(body.error ?? `status ${answer.status}`);
    return body;
  }

  return { open, json };
})();
