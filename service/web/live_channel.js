"use strict";
// The chosen sensor.
const gyrodChannel = (() => {
  const { element } = gyrodParts;
  const health = gyrodHealth;
  const facts = gyrodFacts;
  const kAxes = ["x", "y", "z"];
  const kSpans = { 10: "10 s", 30: "30 s", 60: "1 min", 120: "2 min", 300: "5 min", 600: "10 min" };
  const kPoints = 800; // least and most each: about a pair a pixel

  function card(parent, title) {
    const made = element("section", undefined, "card");
    if (title) made.append(element("h2", title));
    parent.append(made);
    return made;
  }

  /// Buttons of which one is chosen.
  function choice(parent, label, entries, choose) {
    const group = element("span", undefined, "switch");
    group.setAttribute("role", "group");
    group.setAttribute("aria-label", label);
    const buttons = Object.entries(entries).map(([value, text]) => {
      const button = element("button", text);
      button.type = "button";
      button.dataset.value = value;
      button.addEventListener("click", () => choose(value));
      group.append(button);
      return button;
    });
    parent.append(group);
    return { buttons, show: (value) => buttons.forEach((b) => b.setAttribute("aria-pressed", String(b.dataset.value === value))) };
  }

  /// Builds the panel into `parent`. set(changes) changes what is chosen; open(sensor) another one.
  function make(parent, { state, set, open, contact }) {
    let stream = null;
    let watching = ""; // sensor and span that the stream is of
    let past = gyrodHistory.make(30);
    let latest = {}; // channel, spectrum
    let plots = null;
    let drawing = 0;

    const head = element("div", undefined, "channel-head");
    const back = element("button", "‹ Sensors", "plain back");
    back.type = "button";
    back.addEventListener("click", () => set({ sensor: "" }));
    const name = element("h2", undefined, "channel-name");
    name.tabIndex = -1;
    head.append(back, name);
    const words = element("p", undefined, "channel-state");
    const problem = element("p", undefined, "absent");
    problem.hidden = true;
    const bar = element("div", undefined, "channel-bar");
    const axis = choice(bar, "Axis", { x: "x", y: "y", z: "z" }, (value) => set({ axis: value }));
    axis.buttons.forEach((button) => button.prepend(health.dot("warming_up")));
    const span = choice(bar, "Time shown", kSpans, (value) => set({ span: value }));
    parent.append(head, words, problem, bar);
    const rate = card(parent);
    const two = element("div", undefined, "two");
    parent.append(two);
    const spectrum = card(two);
    const allan = card(two);
    const imfs = card(parent, "Decomposition");
    const imfTable = element("div");
    imfs.append(imfTable);
    const pair = element("div", undefined, "two");
    parent.append(pair);
    const models = element("dl", undefined, "facts");
    card(pair, "Models and floor").append(models);
    const work = element("dl", undefined, "facts");
    card(pair, "Window and hop").append(work);
    const events = element("div");
    card(parent, "Events").append(events);
    const counts = element("dl", undefined, "facts columns-of-facts");
    card(parent, "Counts").append(counts);

    const index = () => kAxes.indexOf(state.axis);

    function build() {
      for (const plot of Object.values(plots ?? {})) plot.remove();
      for (const place of [rate, spectrum, allan]) place.replaceChildren();
      plots = {
        rate: gyrodPlots.rate(rate, state.axis, Number(state.span)),
        spectrum: gyrodPlots.spectrum(spectrum, state.axis, index()),
        allan: gyrodPlots.allan(allan, state.axis, index()),
      };
      axis.show(state.axis);
      span.show(state.span);
      drawSpectrum();
      drawChannel();
      if (latest.samples) drawRate();
    }

    /// At most once a frame, and not at all where nobody sees it.
    function drawRate() {
      if (drawing) return;
      drawing = requestAnimationFrame(() => {
        drawing = 0;
        if (latest.samples) plots.rate.update(past);
      });
    }

    function drawSpectrum() {
      if (latest.spectrum) plots.spectrum.update(latest.spectrum, latest.channel?.report);
    }

    function say(row) {
      const axesOf = new Map(); // what is said, and of which axes
      row.axes.forEach((a, i) => {
        const evidence = health.evidence(a);
        const said = `${health.words(a.health)}${evidence ? `: ${evidence}` : ""}`;
        axesOf.set(said, [...(axesOf.get(said) ?? []), kAxes[i]]);
      });
      const parts = axesOf.size === 1 ? [...axesOf.keys()] : [...axesOf].filter(([said]) => said !== "ok").map(([said, axes]) => `${axes.join(", ")} ${said}`);
      const text = parts.join(" · ");
      if (words.textContent !== text) words.textContent = text;
      words.dataset.tone = health.state(row.health).tone;
      axis.buttons.forEach((button, i) => {
        health.paint(button.firstElementChild, row.axes[i].health);
        button.setAttribute("aria-label", `${kAxes[i]} axis, ${health.words(row.axes[i].health)}`);
      });
    }

    let imfsOf = "";
    function drawChannel() {
      const { channel } = latest;
      if (!channel) return;
      say(channel);
      plots.allan.update(channel.allan);
      facts.list(models, facts.models(channel, index()));
      facts.list(work, facts.work(channel));
      facts.list(counts, facts.counts(channel));
      const now = `${channel.sensor} ${channel.report?.model_epoch} ${channel.report?.last_stamp_ns} ${state.axis} ${state.unit}`;
      if (now === imfsOf) return;
      imfsOf = now;
      gyrodImfs.update(imfTable, state.axis, channel.report?.axes?.[index()] ?? null);
    }

    function trouble(text) {
      problem.textContent = text;
      problem.hidden = text === "";
    }

    const handlers = {
      samples(data) {
        past.take(data);
        latest.samples = true;
        drawRate();
      },
      spectrum(data) {
        latest.spectrum = data;
        drawSpectrum();
      },
      channel(data) {
        latest.channel = data;
        drawChannel();
      },
      event(data) {
        contact.event(data);
      },
    };

    function close() {
      stream?.close();
      stream = null;
      watching = "";
    }

    function watch() {
      const wanted = state.sensor && !document.hidden ? `${state.span} ${state.sensor}` : "";
      if (wanted === watching) return;
      close();
      watching = wanted;
      if (!wanted) return;
      past = gyrodHistory.make(Number(state.span));
      latest.samples = false;
      stream = gyrodFeed.open(`/api/v1/channels/${encodeURIComponent(state.sensor)}/stream?seconds=${state.span}&points=${kPoints}`, {
        handlers,
        opened: () => trouble(""),
        lost: (reason) => contact.alive() && trouble(`No live data of this sensor: ${reason}. Trying again.`),
      });
    }

    function show() {
      parent.hidden = state.sensor === "";
      if (parent.hidden) return close();
      if (name.textContent !== state.sensor) {
        name.textContent = state.sensor;
        latest = {};
        words.textContent = "";
        imfsOf = "";
        trouble("");
        for (const place of [imfTable, models, work, counts]) place.replaceChildren();
      }
      watch();
      build();
      showEvents();
    }

    const showEvents = () => state.sensor && gyrodEvents.show(events, state.sensor, open);

    /// Another run of the daemon: what it said before is gone.
    function begin() {
      name.textContent = "";
      close();
      show();
    }

    document.addEventListener("visibilitychange", watch);
    return { show, begin, showEvents, row: (row) => row && say(row), focus: () => name.focus({ preventScroll: false }) };
  }

  return { make };
})();
