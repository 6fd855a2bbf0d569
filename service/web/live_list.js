"use strict";
// The list of sensors. Only the rows in view exist, so that a thousand sensors scroll like ten.
const gyrodList = (() => {
  const { element } = gyrodParts;
  const health = gyrodHealth;
  const units = gyrodUnits;
  const kAxes = ["x", "y", "z"];
  const kOrders = {
    health: "worst first",
    sensor: "by name",
    noise: "loudest first",
    reduction: "least reduced first",
    rate: "slowest first",
  };
  const kMargin = 4; // rows beyond the view
  const kSortAgain_ms = 5000; // numbers move all the time; rows that jumped as often could not be read
  const collator = new Intl.Collator("en", { numeric: true });

  const worst = (row, of, pick) => {
    const values = row.axes.map(of).filter(units.known);
    return values.length === 0 ? null : pick(...values);
  };
  const kKeys = {
    health: (row) => health.rank(row.health),
    sensor: () => 0,
    noise: (row) => -(worst(row, (a) => a.noise_in_radps, Math.max) ?? -Infinity),
    reduction: (row) => worst(row, (a) => a.reduction_db, Math.min) ?? Infinity,
    rate: (row) => row.sample_rate_hz ?? Infinity,
  };

  function sorted(rows, order) {
    const key = kKeys[order];
    const keyed = rows.map((row) => [key(row), row]);
    keyed.sort((a, b) => (a[0] < b[0] ? -1 : a[0] > b[0] ? 1 : collator.compare(a[1].sensor, b[1].sensor)));
    return keyed.map((pair) => pair[1]);
  }

  /// A number in the list: 3 digits, without powers of ten as far as that goes.
  const short = (value) => (value === null ? "?" : gyrodCharts.number(value, 3));

  function noiseText(axis) {
    if (units.known(axis.noise_in_radps)) {
      return `${short(units.convert("rate", axis.noise_in_radps))} → ${short(units.convert("rate", axis.noise_out_radps))}`;
    }
    return axis.health === "warming_up" && axis.limit > 0 ? `fills: ${axis.value} of ${axis.limit}` : "not known yet";
  }

  const kSparkWidth = 60;
  const kSparkHeight = 16;
  const kLeastSpan = 0.5; // of the mean: below, what is shown is chance, and would look like news
  /// The noise of the last ten minutes; breaks where it was not known.
  function sparkPath(history) {
    const values = (history ?? []).filter(units.known);
    if (values.length < 2) return "";
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const span = Math.max(high - low, kLeastSpan * ((high + low) / 2)) || 1;
    const least = (high + low - span) / 2;
    let path = "";
    let pen = "M";
    history.forEach((value, i) => {
      if (!units.known(value)) return (pen = "M");
      const x = kSparkWidth - (history.length - 1 - i) * (kSparkWidth / 59);
      const y = kSparkHeight - 1.5 - ((value - least) / span) * (kSparkHeight - 3);
      path += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
      pen = "L";
    });
    return path;
  }

  const kSvg = "http://www.w3.org/2000/svg";
  function cell(axis) {
    const made = element("div", undefined, "cell");
    const dot = health.dot("ok");
    const noise = element("span", undefined, "noise");
    const unit = element("span", undefined, "unit");
    const reduction = element("span", undefined, "reduction");
    const svg = document.createElementNS(kSvg, "svg");
    svg.setAttribute("viewBox", `0 0 ${kSparkWidth} ${kSparkHeight}`);
    svg.setAttribute("preserveAspectRatio", "none");
    svg.setAttribute("class", "spark");
    const path = document.createElementNS(kSvg, "path");
    svg.append(path);
    const numbers = element("span");
    noise.append(numbers, " ", unit);
    made.append(dot, noise, element("span", axis, "axis"), reduction, svg);
    return { made, dot, numbers, unit, reduction, path };
  }

  function blank() {
    const made = element("div", undefined, "sensor");
    made.setAttribute("role", "option");
    const head = element("div", undefined, "sensor-head");
    const name = element("b", undefined, "name");
    const word = element("span", undefined, "word");
    const rate = element("span", undefined, "soft");
    const why = element("span", undefined, "why");
    head.append(name, why, word, rate);
    const cells = kAxes.map(cell);
    const box = element("div", undefined, "cells");
    box.append(...cells.map((c) => c.made));
    made.append(head, box);
    return { made, name, why, word, rate, cells, row: null, unit: null };
  }

  const write = (place, text) => place.textContent !== text && (place.textContent = text);

  function describe(row) {
    const axes = row.axes.map((a, i) => `${kAxes[i]} ${health.words(a.health)}, noise ${noiseText(a).replace("→", "to")} ${units.unit("rate")}`);
    return `${row.sensor}: ${health.words(row.health)}. ${axes.join("; ")}.`;
  }

  function fill(slot, row) {
    if (slot.row === row && slot.unit === units.unit("rate")) return;
    slot.row = row;
    slot.unit = units.unit("rate");
    write(slot.name, row.sensor);
    write(slot.why, health.evidence(row.axes.find((a) => a.health === row.health) ?? {}));
    write(slot.word, health.words(row.health));
    slot.word.dataset.tone = health.state(row.health).tone;
    write(slot.rate, units.known(row.sample_rate_hz) ? `${units.plain(row.sample_rate_hz, 4)} Hz` : "rate not known yet");
    slot.made.setAttribute("aria-label", describe(row));
    row.axes.forEach((axis, i) => {
      const place = slot.cells[i];
      health.paint(place.dot, axis.health);
      write(place.numbers, noiseText(axis));
      write(place.unit, units.known(axis.noise_in_radps) ? slot.unit : "");
      write(place.reduction, units.known(axis.reduction_db) ? units.decibel(axis.reduction_db) : "");
      const path = sparkPath(axis.history);
      if (place.path.getAttribute("d") !== path) place.path.setAttribute("d", path);
    });
  }

  /// Fills the elements list and rows. open(sensor): somebody has chosen it.
  function make({ list, rows: stage, count, open }) {
    let all = new Map();
    let shown = [];
    let active = 0;
    let chosen = "";
    let query = { search: "", sort: "health", troubled: "" };
    let sortedAt = 0;
    const slots = [];

    /// A full list takes the place of what was there; else rows that have changed. Their histories come less often than they do.
    function take({ full, channels, gone = [] }) {
      if (full) all = new Map();
      for (const row of channels) {
        const before = all.get(row.sensor);
        row.axes.forEach((axis, i) => (axis.history ??= before?.axes[i].history));
        all.set(row.sensor, row);
      }
      for (const sensor of gone) all.delete(sensor);
      arrange(full || gone.length > 0);
    }

    function arrange(now) {
      const wanted = query.search.toLowerCase();
      const kept = [...all.values()].filter((row) => (!query.troubled || health.troubled(row.health)) && row.sensor.toLowerCase().includes(wanted));
      const same = kept.length === shown.length && query.sort !== "health" && performance.now() - sortedAt < kSortAgain_ms;
      const activeSensor = shown[active]?.sensor;
      if (same && !now) {
        shown = shown.map((row) => all.get(row.sensor) ?? row);
      } else {
        shown = sorted(kept, query.sort);
        sortedAt = performance.now();
        const at = shown.findIndex((row) => row.sensor === activeSensor);
        active = at >= 0 ? at : Math.min(active, Math.max(shown.length - 1, 0));
      }
      const bad = kept.reduce((n, row) => n + Number(health.troubled(row.health)), 0);
      const of = kept.length === all.size ? "" : ` of ${units.count(all.size)}`;
      write(count, `${units.count(kept.length)}${of} ${all.size === 1 ? "sensor" : "sensors"}${query.troubled ? "" : `, ${units.count(bad)} troubled`}`);
      draw();
    }

    let height = 0;
    function measure() {
      height = parseFloat(getComputedStyle(list).getPropertyValue("--row")) || 64;
    }

    function draw() {
      if (height === 0) measure();
      const total = `${shown.length * height}px`;
      if (stage.style.height !== total) stage.style.height = total;
      const first = Math.max(0, Math.floor(list.scrollTop / height) - kMargin);
      const last = Math.min(shown.length, Math.ceil((list.scrollTop + list.clientHeight) / height) + kMargin);
      while (slots.length < last - first) {
        const slot = blank();
        slots.push(slot);
        stage.append(slot.made);
      }
      const used = new Set();
      for (let i = first; i < last; i += 1) {
        const slot = slots[i % slots.length];
        used.add(slot);
        place(slot, i);
      }
      for (const slot of slots) slot.made.hidden = !used.has(slot);
      if (shown.length > 0) list.setAttribute("aria-activedescendant", `sensor-${active}`);
      else list.removeAttribute("aria-activedescendant");
    }

    function place(slot, i) {
      fill(slot, shown[i]);
      const { made } = slot;
      const top = `translateY(${i * height}px)`;
      if (made.style.transform !== top) made.style.transform = top;
      made.id = `sensor-${i}`;
      made.dataset.index = i;
      made.setAttribute("aria-setsize", shown.length);
      made.setAttribute("aria-posinset", i + 1);
      made.setAttribute("aria-selected", String(shown[i].sensor === chosen));
      made.classList.toggle("active", i === active);
    }

    function go(to) {
      active = Math.min(Math.max(to, 0), shown.length - 1);
      const top = active * height;
      if (top < list.scrollTop) list.scrollTop = top;
      else if (top + height > list.scrollTop + list.clientHeight) list.scrollTop = top + height - list.clientHeight;
      draw();
    }

    const page = () => Math.max(Math.floor(list.clientHeight / height) - 1, 1);
    const keys = {
      ArrowDown: () => go(active + 1),
      ArrowUp: () => go(active - 1),
      PageDown: () => go(active + page()),
      PageUp: () => go(active - page()),
      Home: () => go(0),
      End: () => go(shown.length - 1),
      Enter: () => open(shown[active].sensor),
      " ": () => open(shown[active].sensor),
    };
    list.addEventListener("keydown", (event) => {
      const act = keys[event.key];
      if (!act || shown.length === 0 || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    });
    list.addEventListener("click", (event) => {
      const row = event.target.closest(".sensor");
      if (!row) return;
      active = Number(row.dataset.index);
      open(shown[active].sensor);
    });
    let waiting = false;
    list.addEventListener("scroll", () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        draw();
      });
    }, { passive: true });
    new ResizeObserver(() => {
      measure();
      draw();
    }).observe(list);

    return {
      take,
      clear: () => take({ full: true, channels: [] }),
      rows: () => all,
      redraw: draw,
      choose(sensor) {
        chosen = sensor;
        const at = shown.findIndex((row) => row.sensor === sensor);
        if (at >= 0) active = at;
        draw();
      },
      ask(changes) {
        query = { ...query, ...changes };
        list.scrollTop = 0;
        active = 0;
        arrange(true);
      },
    };
  }

  return { make, kOrders };
})();
