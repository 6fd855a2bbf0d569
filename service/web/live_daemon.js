"use strict";
// How gyrod itself is doing: the line on top, the fleet at a glance, and what to do where there is no sensor yet.
const gyrodDaemon = (() => {
  const { element } = gyrodParts;
  const health = gyrodHealth;
  const units = gyrodUnits;
  const facts = gyrodFacts;

  const kSteps = ["0 of 2", "1 of 2: fewer models", "2 of 2: passing through"];

  function vitals(parent, status) {
    facts.list(parent, [
      ["samples/s", units.perSecond(status.rates.samples_per_s)],
      ["windows/s", units.perSecond(status.rates.windows_per_s)],
      ["added latency, p99", units.time(status.added_latency_s.p99)],
      ["workers busy", `${status.workers_busy} of ${status.workers}`],
      ["queue", `${units.count(status.queued_windows)} ${status.queued_windows === 1 ? "window" : "windows"}`],
      ["overload step", kSteps[status.overload_step] ?? String(status.overload_step)],
      ["up for", units.time(status.uptime_s)],
      ["version", status.version],
    ]);
  }

  /// Sensors by state of health, worst first: also the legend of the letters.
  function states(parent, byHealth) {
    const list = element("ul", undefined, "states");
    for (const name of health.kOrder) {
      const count = byHealth[name] ?? 0;
      const item = element("li", undefined, count === 0 ? "soft" : "");
      item.title = health.state(name).means;
      item.append(health.dot(name), element("b", units.count(count)), ` ${health.words(name)}`);
      list.append(item);
    }
    parent.append(list);
  }

  function section(parent, title) {
    const made = element("section", undefined, "card");
    made.append(element("h2", title));
    parent.append(made);
    return made;
  }

  const reasons = (counts) => Object.entries(counts ?? {}).filter(([, n]) => n > 0).map(([reason, n]) => `${reason.replaceAll("_", " ")} ${units.count(n)}`).join(", ");

  function samples({ samples: s, windows, window_time_s: time }) {
    const refused = reasons(s.rejected);
    return [
      ["received", units.count(s.received)],
      ["published", units.count(s.published)],
      ["in flight", units.count(s.in_flight)],
      ["refused", units.count(s.rejected_total) + (refused ? `: ${refused}` : "")],
      ["missing", units.count(s.missing)],
      ["bridged", units.count(s.bridged)],
      ["while warming up", units.count(s.warming_up)],
      ["passed through undenoised", units.count(s.passed_through)],
      ["without look-ahead", units.count(s.realtime)],
      ["windows", units.count(windows)],
      ["computing a window, p50 and p99", `${units.time(time.p50)}, ${units.time(time.p99)}`],
    ];
  }

  function bus({ bus: b, channels: c, fleet, standby }) {
    const unmatched = b.incompatible_peers.filter((p) => p.peers > 0).map((p) => `${p.peers} by ${p.policy} (${p.direction})`).join(", ");
    const list = [
      ["DDS domain", units.known(b.domain) ? String(b.domain) : "not known"],
      ["reads", b.input_topics.join(", ")],
      ["writers that send", units.count(b.matched_writers)],
      ["peers that do not match", unmatched || "0"],
      ["messages that cannot be read", units.count(b.malformed_messages)],
      ["times a full cache had a writer wait", units.count(b.refusals)],
      ["messages that could not be written", units.count(b.write_errors)],
      ["deadlines missed", units.count(b.deadlines_missed)],
      ["liveliness lost", units.count(b.liveliness_lost)],
      ["sensors open, silent, forgotten", [c.open, c.silent, c.forgotten].map(units.count).join(", ")],
    ];
    for (const { topic, readers } of b.matched_readers ?? []) list.push([`readers of ${topic}`, units.count(readers)]);
    if (b.ros2_topics > 0) list.push(["ROS 2 topics open, refused", `${units.count(b.ros2_topics)}, ${units.count(b.ros2_refused_topics)}`]);
    if (units.known(b.certificate_expiry_s)) list.push(["the first certificate ends", units.moment(b.certificate_expiry_s)]);
    if (fleet && fleet.shard !== "1/1") list.push(["shard", `${fleet.shard}, ${fleet.active ? "active" : "joining"}, ${units.count(fleet.peers)} others`]);
    if (standby) list.push(["hot standby", `${units.count(standby.others)} others, publishes ${units.count(standby.sensors)} sensors, ${units.count(standby.takeovers)} takeovers`]);
    return list;
  }

  /// Builds the overview. @return {update(status), events: where the log goes}
  function overview(parent) {
    const fleet = section(parent, "Fleet");
    const counts = element("div");
    fleet.append(counts);
    const hint = element("p", "Choose a sensor to see its rates, spectrum, Allan deviation and modes.", "soft wide-only");
    fleet.append(hint);
    const log = section(parent, "Events");
    const events = element("div");
    log.append(events);
    const both = element("div", undefined, "two");
    parent.append(both);
    const inOut = element("dl", undefined, "facts");
    section(both, "Samples").append(inOut);
    const onBus = element("dl", undefined, "facts");
    section(both, "Bus").append(onBus);
    let key = "";
    function update(status) {
      const now = JSON.stringify(status.channels.by_health);
      if (now !== key) {
        key = now;
        counts.replaceChildren();
        states(counts, status.channels.by_health);
      }
      facts.list(inOut, samples(status));
      facts.list(onBus, bus(status));
    }
    return { update, events };
  }

  /// What to do where there is no sensor.
  function empty(parent, { bus: b }) {
    const key = JSON.stringify([b.input_topics, b.domain, b.simulate_hint, b.matched_writers > 0]);
    if (parent.dataset.key === key) return;
    parent.dataset.key = key;
    parent.replaceChildren(element("h2", "No sensors yet"));
    const where = units.known(b.domain) ? ` on DDS domain ${b.domain}` : "";
    const listens = element("p", `gyrod listens${where} to `);
    b.input_topics.forEach((topic, i) => listens.append(...(i > 0 ? [i === b.input_topics.length - 1 ? " and " : ", "] : []), element("code", topic)));
    listens.append(". A sensor appears here with its first sample.");
    parent.append(listens);
    if (b.matched_writers > 0) parent.append(element("p", "Somebody is there who could send: a writer matches, but no sample has come."));
    if (!b.simulate_hint) return;
    parent.append(element("p", "No sensor at hand? This simulates one:"));
    const command = element("pre", b.simulate_hint, "command");
    command.tabIndex = 0;
    parent.append(command);
    if (!navigator.clipboard) return;
    const copy = element("button", "Copy");
    copy.type = "button";
    copy.className = "plain";
    copy.addEventListener("click", async () => {
      await navigator.clipboard.writeText(b.simulate_hint);
      copy.textContent = "Copied";
    });
    parent.append(copy);
  }

  return { vitals, overview, empty };
})();
