"use strict";
// The log of what has happened: changes of health, and of the daemon. The newest is on top.
const gyrodEvents = (() => {
  const { element } = gyrodParts;
  const health = gyrodHealth;
  const units = gyrodUnits;
  const kKept = 500;
  const kShown = 60;
  let events = new Map(); // by run and id
  let epoch = null;
  let run = 0; // of the daemon, while this page is open

  const newestFirst = (a, b) => b.run - a.run || b.id - a.id;

  /// Another run of the daemon counts its events anew; what was before it stays.
  function begin(newEpoch) {
    if (epoch === newEpoch) return;
    run += 1;
    epoch = newEpoch;
  }

  function add(more) {
    let news = false;
    for (const event of more) {
      const key = `${run} ${event.id}`;
      if (!events.has(key)) news = true;
      events.set(key, { ...event, run });
    }
    if (events.size > kKept) events = new Map([...events].sort(([, a], [, b]) => newestFirst(a, b)).slice(0, kKept));
    return news;
  }

  /// A change of health in the units of this page; anything else in the daemon's words, less the sensor's name.
  function words(event) {
    if (event.kind !== "health") return event.sensor !== null && event.text.startsWith(event.sensor) ? event.text.slice(event.sensor.length) : event.text;
    const evidence = health.evidence({ health: event.to, value: event.value, limit: event.limit });
    return `${event.axis === null ? "all axes" : `${event.axis} axis`} ${health.words(event.to)}, before ${health.words(event.from)}${evidence ? `: ${evidence}` : ""}`;
  }

  function line(event, withSensor, open) {
    const row = element("li");
    row.append(element("time", units.moment(event.time_s), "soft"));
    row.append(event.kind === "health" ? health.dot(event.to) : element("span"));
    const text = element("span");
    if (withSensor && event.sensor !== null) {
      const name = element("button", event.sensor, "as-link");
      name.type = "button";
      name.addEventListener("click", () => open(event.sensor));
      text.append(name, " ");
    }
    text.append(words(event));
    row.append(text);
    return row;
  }

  /// Writes the newest events of a sensor, or of all where `sensor` is null.
  function show(parent, sensor, open) {
    const shown = [...events.values()].filter((e) => sensor === null || e.sensor === sensor).sort(newestFirst).slice(0, kShown);
    const key = `${epoch} ${sensor} ${units.unit("rate")} ${shown.map((e) => `${e.run} ${e.id}`).join()}`;
    if (parent.dataset.key === key) return;
    parent.dataset.key = key;
    if (shown.length === 0) return parent.replaceChildren(element("p", "Nothing has happened since gyrod started, or since its log begins.", "soft"));
    const list = element("ol", undefined, "events");
    list.append(...shown.map((event) => line(event, sensor === null, open)));
    parent.replaceChildren(list);
  }

  return { begin, add, show };
})();
