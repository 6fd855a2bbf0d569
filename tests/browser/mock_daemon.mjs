// Answers as a daemon with as many sensors as wanted, of any name and in any state: for tests of the live page that no real fleet on one
// machine could give. The answers follow docs/api.md; that the daemon's do, live_page.mjs tests with the daemon itself.
import { createServer } from "node:http";

const kAxes = ["x", "y", "z"];
const kRate_hz = 100;
const kNoise_radps = 0.006;

/// The same numbers in every run.
function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const hash = (text) => [...text].reduce((sum, c) => (Math.imul(sum, 31) + c.codePointAt(0)) >>> 0, 7);

function axis(sensor, index, health, time_s) {
  const roll = random(hash(sensor) + index);
  const level = kNoise_radps * (0.6 + 0.8 * roll()) * (health === "noisy" ? 2.2 : 1);
  const flicker = random(hash(sensor) + index + Math.floor(time_s));
  const noise_in = level * (1 + 0.02 * flicker());
  const evidence = { noisy: [2.2, 1.5], silent: [42, 1], drifting: [0.002, 0.001], lossy: [0.03, 0.01], degraded: [1, 1], warming_up: [512, 1024], stuck: [3, 1], saturated: [2, 10], ok: [0, 0] };
  const [value, limit] = evidence[health];
  if (health === "warming_up") return { health, value, limit, noise_in_radps: null, noise_out_radps: null, reduction_db: null };
  const noise_out = noise_in * (0.25 + 0.2 * roll());
  return { health, value, limit, noise_in_radps: noise_in, noise_out_radps: noise_out, reduction_db: 20 * Math.log10(noise_in / noise_out) };
}

function history(sensor, index) {
  const roll = random(hash(sensor) + 17 * index);
  return Array.from({ length: 60 }, (_, i) => (i < 6 ? null : kNoise_radps * (1 + 0.3 * Math.sin(i / 9 + index) + 0.2 * roll())));
}

function row(sensor, healths, time_s, withHistory) {
  const axes = kAxes.map((_, i) => ({ ...axis(sensor, i, healths[i], time_s), ...(withHistory ? { history: history(sensor, i) } : {}) }));
  const order = ["ok", "warming_up", "degraded", "lossy", "drifting", "noisy", "saturated", "stuck", "silent"];
  const health = healths.reduce((worst, h) => (order.indexOf(h) > order.indexOf(worst) ? h : worst));
  return {
    sensor, health, state: health === "silent" ? "silent" : "active", sample_rate_hz: kRate_hz, hop_samples: 32, overload_step: 0, noise_source: "standstill",
    at_rest: true, received: 120000, published: 119900, rejected: 3, missing: 12, axes,
  };
}

function imfs(level) {
  const classes = ["noise", "noise", "mixed", "mixed", "signal"];
  return classes.map((name, i) => ({
    class: name, mean_period_s: 0.029 * 2 ** i, mean_period_samples: 2.9 * 2 ** i, energy: level ** 2 / 2 ** i, rms_radps: level / 2 ** (i / 2), pcc: 0.8 / (i + 1),
    acf_variance: 0.0006 * 2 ** i, acf_concentration: 0.5, excess: name === "noise" ? 1.05 : 3 * 4 ** i, noise_excess_low: 0.7, noise_excess_high: 1.4,
    noise_probability: name === "noise" ? 0.6 : 0.001, model: name === "mixed" ? { family: "ar", ar_order: 2 + i, ma_order: 0, innovation_std_radps: level / 5, used: true } : null,
  }));
}

function report(one) {
  return {
    model_epoch: 371, window_samples: 1024, window_time_s: 0.0021, lag_samples: 16, hop_samples: 32, last_sequence: 119999, last_stamp_ns: "1700000000000000000", flags: [],
    axes: one.axes.map((a, i) => ({
      j: 2, k: 4, modes: 3, mean_radps: 0.0011 * (i + 1), noise_floor_radps: a.noise_in_radps, output_noise_radps: a.noise_out_radps,
      tone: i === 0 ? { frequency_hz: 27, amplitude_radps: 0.004 } : null, fit: { normalised_innovation: 1.02, misfit: false, misfits: 0, fallbacks: 0, wrong_noise: false, noise_ratio: 1, hidden_noise: false },
      imfs: imfs(a.noise_in_radps ?? kNoise_radps),
    })),
  };
}

function allan() {
  const tau_s = Array.from({ length: 14 }, (_, i) => 0.01 * 2 ** i);
  return {
    at_rest_s: 320,
    axes: kAxes.map((_, i) => ({
      tau_s, deviation_radps: tau_s.map((tau) => Math.hypot(0.0006 / Math.sqrt(tau), 0.00004)), terms: [], angle_random_walk_radps_sqrt_hz: 0.0006,
      bias_instability_radps: i === 2 ? null : 0.00006, rate_random_walk_radps_per_sqrt_s: null, needs_s: i === 2 ? 900 : null,
    })),
  };
}

const rate = (t, i) => 0.05 * Math.sin(0.7 * t + i);

function samples(from_s, to_s, points_s, append) {
  const roll = random(Math.floor(from_s * 1000));
  const t_s = [];
  const parts = [{ t_s }, { t_s }];
  for (const part of parts) for (const a of kAxes) [part[`${a}_min`], part[`${a}_max`]] = [[], []];
  for (let t = Math.ceil(from_s / points_s) * points_s; t < to_s; t += points_s) {
    if (Math.floor(t) % 20 === 7 && t % 1 < 0.4) continue; // a gap
    t_s.push(t - from_s);
    kAxes.forEach((a, i) => {
      const noise = kNoise_radps * (roll() + roll() - 1);
      const spread = kNoise_radps * roll();
      parts[0][`${a}_min`].push(rate(t, i) + noise - spread);
      parts[0][`${a}_max`].push(rate(t, i) + noise + spread);
      parts[1][`${a}_min`].push(rate(t, i) - 0.001);
      parts[1][`${a}_max`].push(rate(t, i) + 0.001);
    });
  }
  const gaps = [];
  const rest = [];
  for (let t = Math.floor(from_s); t < to_s; t += 1) {
    if (t % 20 === 7) gaps.push([t - from_s, t + 0.4 - from_s]);
    if (t % 20 >= 12) rest.push([t - from_s, t + 1 - from_s]);
  }
  return { from_ns: String(Math.round(from_s * 1e9)), bucket_s: points_s, watched_s: 900, raw: parts[0], denoised: parts[1], rest, gaps, ...(append ? { append: true } : {}) };
}

function spectrum(sensor, axes) {
  const frequency_hz = Array.from({ length: 257 }, (_, i) => (i * kRate_hz) / 512);
  const density = (f, i) => 0.0008 * (1 + 1 / (f + 0.05)) + (i === 0 ? 0.01 * Math.exp(-(((f - 27) / 0.4) ** 2)) : 0);
  return {
    sensor, samples_used: 8192, frequency_hz, needs_s: null,
    axes: axes.map((_, i) => ({ raw: frequency_hz.map((f) => density(f, i)), denoised: frequency_hz.map((f) => density(f, 1) / (1 + (f / 3) ** 2)), noise_floor: 0.0008 })),
  };
}

function status(mock, time_s) {
  const by_health = {};
  for (const healths of mock.sensors.values()) {
    const { health } = row("s", healths, 0, false);
    by_health[health] = (by_health[health] ?? 0) + 1;
  }
  const open = mock.sensors.size;
  return {
    api: "v1", version: "0.1.0", time_s, start_time_s: mock.start_s, uptime_s: time_s - mock.start_s, epoch: mock.epoch, ready: true, ready_reason: null,
    samples: { received: 120000 * open, published: 119900 * open, rejected: { not_finite: 3 * open }, rejected_total: 3 * open, in_flight: 97 * open, missing: 12 * open, bridged: 2, warming_up: 0, passed_through: 0, realtime: 0 },
    rates: { samples_per_s: kRate_hz * open, windows_per_s: (kRate_hz / 32) * open }, windows: 371 * open, queued_windows: 0, workers: 4, workers_busy: 1,
    window_time_s: { p50: 0.0019, p99: 0.0042 }, added_latency_s: { p50: 0.0031, p99: 0.0087 }, overload_step: 0,
    channels: { open, silent: by_health.silent ?? 0, forgotten: 0, by_health },
    bus: { domain: 0, matched_writers: open, input_topics: ["gyro/raw", "gyro/raw_batch"], malformed_messages: 0, refusals: 0, write_errors: 0, incompatible_peers: [], deadlines_missed: 0, liveliness_lost: 0, simulate_hint: "gyrod simulate --motion drive --sensor demo" },
    fleet: { shard: "1/1", active: true, peers: 0, twins: 0, overlapping: 0, missing: 0, disputes: 0, foreign_samples: 0 }, standby: null,
  };
}

/// Starts one on a free port of this machine, or on `port`. page: {body, headers} of the daemon's own page. sensors: [id], each ok until told
/// otherwise. @return {url, port, set(sensor, axis, health), stop()}
export async function startMock({ page, sensors, port = 0, epoch = "1" }) {
  const now_s = () => Date.now() / 1000;
  const mock = { sensors: new Map(sensors.map((id) => [id, ["ok", "ok", "ok"]])), start_s: now_s() - 7412, epoch, events: [] };
  const timers = new Set();

  const full = (sensor) => {
    const one = row(sensor, mock.sensors.get(sensor), now_s(), false);
    return { ...one, time_s: now_s(), counts: { received: 120000, published: 119900, rejected: { not_finite: 3 }, missing: 12 }, queued_windows: 0, last_stamp_ns: "1700000000000000000", report: report(one), bias: { axes_radps: [0.001, 0.002, -0.001], seconds: 320 }, allan: allan() };
  };

  function every(response, milliseconds, act) {
    const timer = setInterval(act, milliseconds);
    timers.add(timer);
    response.on("close", () => {
      clearInterval(timer);
      timers.delete(timer);
    });
  }

  const send = (response, event, data) => response.write(`event: ${event}\ndata: ${JSON.stringify(data)}\n\n`);

  function fleetStream(response) {
    send(response, "status", status(mock, now_s()));
    send(response, "channels", { time_s: now_s(), full: true, total: mock.sensors.size, channels: [...mock.sensors].map(([id, h]) => row(id, h, now_s(), true)), gone: [] });
    every(response, 1000, () => {
      send(response, "status", status(mock, now_s()));
      send(response, "channels", { time_s: now_s(), full: false, total: mock.sensors.size, channels: [...mock.sensors].map(([id, h]) => row(id, h, now_s(), false)), gone: [] });
    });
  }

  function channelStream(response, sensor, query) {
    const seconds = Number(query.get("seconds") ?? 30);
    const points_s = Math.max(seconds / Number(query.get("points") ?? 1000), 1 / kRate_hz);
    let at = now_s();
    send(response, "channel", full(sensor));
    send(response, "samples", { sensor, ...samples(at - seconds, at, points_s, false) });
    send(response, "spectrum", spectrum(sensor, kAxes));
    every(response, 200, () => {
      const to = now_s();
      send(response, "samples", { sensor, ...samples(at, to, points_s, true) });
      at = to;
    });
    every(response, 1000, () => send(response, "channel", full(sensor)));
    every(response, 2000, () => send(response, "spectrum", spectrum(sensor, kAxes)));
  }

  function answer(request, response) {
    const url = new URL(request.url, "http://mock");
    const path = url.pathname;
    const json = (body, code = 200) => response.writeHead(code, { "Content-Type": "application/json" }).end(JSON.stringify(body));
    const stream = (fill) => {
      response.writeHead(200, { "Content-Type": "text/event-stream" });
      fill();
    };
    if (path === "/") return response.writeHead(200, page.headers).end(page.body);
    if (path === "/api/v1/status") return json(status(mock, now_s()));
    if (path === "/api/v1/events") return json({ events: mock.events, first_id: 1, last_id: mock.events.length });
    if (path === "/api/v1/stream") return stream(() => fleetStream(response));
    const [, id, streams] = /^\/api\/v1\/channels\/([^/]+)(\/stream)?$/.exec(path) ?? [];
    const sensor = id === undefined ? undefined : decodeURIComponent(id);
    if (sensor === undefined || !mock.sensors.has(sensor)) return json({ error: `no sensor "${sensor}"` }, 404);
    return streams ? stream(() => channelStream(response, sensor, url.searchParams)) : json(full(sensor));
  }

  const server = createServer(answer);
  await new Promise((done) => server.listen(port, "127.0.0.1", done));
  return {
    port: server.address().port,
    url: `http://127.0.0.1:${server.address().port}/`,
    set(sensor, index, health) {
      const healths = [...mock.sensors.get(sensor)];
      const from = healths[index];
      healths[index] = health;
      mock.sensors.set(sensor, healths);
      const { value, limit } = axis(sensor, index, health, 0);
      const id = mock.events.length + 1;
      mock.events.push({ id, time_s: now_s() - 60 + id, sensor, kind: "health", axis: kAxes[index], from, to: health, value, limit, unit: null, text: `${sensor} axis ${kAxes[index]} is ${health}, before ${from}.` });
    },
    stop: () => new Promise((done) => {
      timers.forEach(clearInterval);
      server.close(done);
      server.closeAllConnections();
    }),
  };
}
