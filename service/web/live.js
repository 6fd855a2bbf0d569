"use strict";
// The live page: one stream of the fleet, one of the chosen sensor.
(() => {
  const byId = (id) => document.getElementById(id);
  const { state, set, changed } = gyrodState;
  const { element } = gyrodParts;
  const units = gyrodUnits;
  const health = gyrodHealth;
  const kSilence_s = 10; // status comes each second
  const kEventsAtFirst = 500;

  let epoch = null;
  let status = null;
  let heardAt_s = null;
  let alive = false;
  let missed = true; // events may have come that nobody told us

  const open = (sensor) => set({ sensor });
  const overview = gyrodDaemon.overview(byId("overview"));
  const channel = gyrodChannel.make(byId("channel"), { state, set, open, contact: { alive: () => alive, event: (e) => addEvents([e]) } });
  const list = gyrodList.make({ list: byId("list"), rows: byId("rows"), count: byId("count"), open });

  function showEvents() {
    if (state.sensor) channel.showEvents();
    else gyrodEvents.show(overview.events, null, open);
  }

  function addEvents(more) {
    if (gyrodEvents.add(more)) showEvents();
  }

  function titled() {
    const bad = [...list.rows().values()].filter((row) => health.troubled(row.health)).length;
    const text = alive ? (bad > 0 ? `gyrod: ${bad} troubled` : "gyrod") : "gyrod: disconnected";
    if (document.title !== text) document.title = text;
  }

  function say(id, text) {
    if (byId(id).textContent !== text) byId(id).textContent = text;
    byId(id).hidden = text === "";
  }

  async function fetchEvents() {
    try {
      addEvents((await gyrodFeed.json(`/api/v1/events?limit=${kEventsAtFirst}`)).events);
    } catch {
      missed = true; // the next status asks again
    }
  }

  function takeStatus(data) {
    status = data;
    heardAt_s = Date.now() / 1000;
    if (data.epoch !== epoch) {
      const restarted = epoch !== null;
      epoch = data.epoch;
      gyrodEvents.begin(epoch);
      if (restarted) channel.begin();
    }
    const ask = missed;
    missed = false;
    if (ask) fetchEvents();
    gyrodDaemon.vitals(byId("vitals"), data);
    overview.update(data);
    say("trouble", data.ready ? "" : `gyrod cannot denoise: ${data.ready_reason ?? "it does not say why"}.`);
    const none = data.channels.open === 0 && list.rows().size === 0;
    byId("empty").hidden = !none;
    byId("list").hidden = none;
    if (none) gyrodDaemon.empty(byId("empty"), data);
  }

  function takeChannels(data) {
    list.take(data);
    if (list.rows().size > 0) {
      byId("empty").hidden = true;
      byId("list").hidden = false;
    }
    if (state.sensor) channel.row(list.rows().get(state.sensor));
    titled();
  }

  function connected() {
    alive = true;
    missed = true;
    document.body.classList.remove("stale");
    byId("link").textContent = "live";
    byId("link").dataset.tone = "green";
    say("lost", "");
    titled();
  }

  function lost(reason) {
    alive = false;
    document.body.classList.add("stale");
    const since = heardAt_s === null ? "" : ` since ${units.moment(heardAt_s)}`;
    byId("link").textContent = "disconnected";
    byId("link").dataset.tone = "red";
    const old = heardAt_s === null ? "" : " What you see is from then.";
    say("lost", `Disconnected from gyrod${since}: ${reason}. Trying again every 2 s.${old}`);
    titled();
  }

  function controls() {
    const sort = byId("sort");
    for (const [value, text] of Object.entries(gyrodList.kOrders)) {
      const option = element("option", text);
      option.value = value;
      sort.append(option);
    }
    sort.addEventListener("change", () => set({ sort: sort.value }));
    byId("search").addEventListener("input", () => set({ search: byId("search").value }));
    byId("troubled").addEventListener("change", () => set({ troubled: byId("troubled").checked ? "1" : "" }));
    for (const [value, text] of [["deg", "deg/s"], ["rad", "rad/s"]]) {
      const button = element("button", text);
      button.type = "button";
      button.dataset.value = value;
      button.addEventListener("click", () => set({ unit: value }));
      byId("units").append(button);
    }
    document.addEventListener("keydown", (event) => {
      if (event.target.matches("input, select")) return event.key === "Escape" && byId("list").focus();
      if (event.key === "/") {
        event.preventDefault();
        byId("search").focus();
      } else if (event.key === "Escape" && state.sensor) {
        if (!event.target.closest(".plot")) set({ sensor: "" });
      }
    });
  }

  /// Brings the page into the state that is chosen.
  function apply(changes) {
    const has = (...names) => names.some((name) => changes.has(name));
    if (has("unit")) {
      units.use(state.unit);
      for (const button of byId("units").children) button.setAttribute("aria-pressed", String(button.dataset.value === state.unit));
    }
    if (has("search", "sort", "troubled")) {
      if (byId("search").value !== state.search) byId("search").value = state.search;
      byId("sort").value = state.sort;
      byId("troubled").checked = state.troubled === "1";
      list.ask({ search: state.search, sort: state.sort, troubled: state.troubled });
    }
    if (has("sensor")) {
      document.body.dataset.view = state.sensor ? "channel" : "list";
      byId("overview").hidden = state.sensor !== "";
      list.choose(state.sensor);
    }
    if (has("unit")) list.redraw();
    if (has("sensor", "axis", "span", "unit")) {
      channel.show();
      if (state.sensor) channel.row(list.rows().get(state.sensor));
      showEvents();
    }
    if (has("sensor") && started) (state.sensor ? channel : { focus: () => byId("list").focus({ preventScroll: true }) }).focus();
  }

  const head = document.querySelector("header.daemon");
  new ResizeObserver(() => document.documentElement.style.setProperty("--head", `${head.offsetHeight}px`)).observe(head);

  let started = false;
  controls();
  changed(apply);
  apply(new Set(Object.keys(state)));
  started = true;
  gyrodFeed.open("/api/v1/stream?channels=1", {
    handlers: { status: takeStatus, channels: takeChannels, event: (e) => addEvents([e]) },
    opened: connected,
    lost,
    silence_s: kSilence_s,
  });
})();
