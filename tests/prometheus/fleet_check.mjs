// A fleet of nine vehicles, each with another fault, before a real Prometheus with our configuration and rules, sixty times faster (hasty_rules.mjs).
// Each fault raises its own alert and no other, a drive of ten minutes and more raises none, and every expression of every rule and dashboard
// finds what it asks for.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { dashboardExpressions, selectorsOf } from "./expressions.mjs";
import { recording } from "./faults.mjs";
import { hasty, kHaste, writeHastyRules } from "./hasty_rules.mjs";
import { Rig, ask, eventually } from "./rig.mjs";

const kSpeed = 8; // of sensors with a fault; health is judged once a second, so that a fault has to last for longer
const kDriveSpeed = 20;
const kDrive_s = 600;
const kDown_ms = 120e3 / kHaste / 2; // half of the two minutes that raise GyrodDown: scrapes and rules take their time, too
const kLearned = 8500; // samples after which the bias of a sensor at rest is known

const rig = new Rig();
let prometheus;
let driving_ms;
let away_ms;
after(() => rig.stop());

const quick = { denoise: { window_samples: 256, hop_samples: 64 }, limits: { max_hop_samples: 128 }, health: { noisy_after_s: 5, loss_window_s: 2 } };

const vehicles = {
  healthy: {},
  sensors: quick,
  network: quick,
  rebooting: quick,
  // The level of each window, as method joint follows one over minutes of the sensor's own clock; and a gyrod that is not to say noisy itself.
  ageing: { ...quick, denoise: { ...quick.denoise, method: "paper" }, noise: { source: "imf1" }, health: { noisy_ratio: 10 } },
  overloaded: { denoise: { method: "paper", window_samples: 4096 }, limits: { max_delay_s: 0.01 } },
  off: {},
  parked: { denoise: { window_samples: 512, hop_samples: 128 } },
};

const sensors = [
  ["sensors", "fine", "none", 0],
  ["sensors", "frozen", "stuck", kLearned],
  ["sensors", "clipped", "saturated", kLearned],
  ["sensors", "loud", "louder", kLearned],
  ["sensors", "moved", "moved", kLearned],
  ["sensors", "leaky", "leaky", kLearned],
  ["sensors", "mute", "none", 0],
  ["network", "left", "leaky", kLearned],
  ["network", "right", "leaky", kLearned],
  ["rebooting", "moody", "rebooting", kLearned],
  ["ageing", "old", "doubled", 22 * 100 * kSpeed],
];

/** vehicle, sensor, axes: alert. */
const expected = [
  "ageing old xyz: GyroNoiseUp",
  "network: GyrodLoss",
  "off: GyrodDown",
  "overloaded: GyrodOverload",
  "rebooting: GyroClockJumps",
  "restarting: GyrodRestarting",
  "sensors clipped z: GyroSaturated",
  "sensors frozen y: GyroStuck",
  "sensors leaky: GyroLossy",
  "sensors loud xyz: GyroNoisy",
  "sensors moved x: GyroBiasJump",
  "sensors mute: GyroSilent",
];

/** What has fired until now. */
async function fired() {
  const axes = {};
  for (const { metric } of await ask(prometheus, 'max_over_time(ALERTS{alertstate="firing"}[10m])')) {
    const { vehicle, sensor, axis = "", alertname } = metric;
    const key = `${sensor ? `${vehicle} ${sensor}` : vehicle}|${alertname}`;
    axes[key] = [...(axes[key] ?? []), axis];
  }
  return Object.entries(axes)
    .map(([key, all]) => key.replace("|", `${all.join("") && ` ${all.sort().join("")}`}: `))
    .sort();
}

/** Three times ended and begun anew, at the same address. @return the longest that it was away, ms */
async function restartThrice(daemon) {
  const port = Number(daemon.address.split(":")[1]);
  let longest_ms = 0;
  for (let n = 0; n < 3; ++n) {
    const begin = await ask(prometheus, 'process_start_time_seconds{vehicle="restarting"}');
    const end_ms = Date.now();
    daemon.child.kill("SIGTERM");
    await daemon.child.over;
    daemon = await rig.daemon("restarting", { monitor: { port } });
    longest_ms = Math.max(longest_ms, Date.now() - end_ms);
    await eventually("the restart shows", async () => {
      const now = await ask(prometheus, 'process_start_time_seconds{vehicle="restarting"}');
      return now[0]?.value[1] > begin[0].value[1];
    });
  }
  return longest_ms;
}

before(async () => {
  writeHastyRules(rig.path("rules"));
  const daemons = Object.fromEntries(
    await Promise.all([...Object.keys(vehicles), "restarting"].map(async (name) => [name, await rig.daemon(name, vehicles[name])])),
  );
  prometheus = await rig.prometheus(hasty);
  rig.discover(...Object.values(daemons));
  await eventually("all vehicles are scraped", async () => (await ask(prometheus, 'up{job="gyrod"} == 1')).length === 9);

  const { healthy, overloaded, off, parked, restarting } = daemons;
  const simulate = ({ vehicle, config }, ...args) => rig.gyrod(vehicle, "simulate", ...args, "--config", config);
  simulate(healthy, "--motion", "drive", "--engine-tone", "1", "--speed", `${kDriveSpeed}`, "--batch", "10");
  driving_ms = Date.now();
  simulate(overloaded, "--sensors", "3", "--speed", "10");
  simulate(parked, "--rate", "10", "--bias-instability", "60", "--speed", "300", "--batch", "10"); // hours, so that B shows
  const started = Object.fromEntries(
    sensors.map(([vehicle, name, fault, healthySamples], n) => [
      name,
      rig.sensor(daemons[vehicle], name, recording({ fault, healthy: healthySamples, seed: 11 + n }), kSpeed),
    ]),
  );
  await eventually("the one that falls silent has been heard", async () => (await ask(prometheus, 'gyrod_sensor_health{sensor="mute"} == 0')).length > 0);
  started.mute.kill("SIGSTOP"); // it lives and says nothing
  off.child.kill("SIGTERM");
  away_ms = await restartThrice(restarting);
});

test("each fault raises its own alert and no other, and a drive none", async () => {
  await eventually("all alerts have fired", async () => {
    const now = await fired();
    return expected.every((alert) => now.includes(alert));
  }).catch(() => {});
  await eventually("the drive is long enough", () => ((Date.now() - driving_ms) / 1000) * kDriveSpeed > kDrive_s);
  // A busy machine restarts it in more than what are two minutes here: then it has been down, and that is said rightly.
  const mayBeDown = away_ms > kDown_ms;
  const now = (await fired()).filter((alert) => !(mayBeDown && alert === "restarting: GyrodDown"));
  const surprising = new Set(now.filter((alert) => !expected.includes(alert)).map((alert) => alert.split(/[ :]/)[0]));
  for (const vehicle of surprising) console.log(`gyrod of ${vehicle} said:\n${rig.said(`gyrod-${vehicle}`)}`);
  assert.deepEqual(now, expected);
});

test("every rule is evaluated without an error, and what it looks at is there", async () => {
  const { data } = await (await fetch(`${prometheus}/api/v1/rules`)).json();
  const rules = data.groups.flatMap((group) => group.rules);
  assert.equal(rules.length, 18);
  for (const { name, query, health, lastError } of rules) {
    assert.equal(health, "ok", `${name}: ${lastError}`);
    const selectors = selectorsOf(query);
    assert.notEqual(selectors.length, 0, query);
    for (const selector of selectors) assert.notEqual((await ask(prometheus, selector)).length, 0, `${name}: no series ${selector}`);
  }
});

test("every expression of every dashboard finds something", async () => {
  // Some of it only the engine of the one, or the long rest of the other has to show.
  const shown = ["sensors", "healthy", "parked"];
  for (const dashboard of ["fleet.json", "vehicle.json"]) {
    const [every, ...others] = shown.map((vehicle) => dashboardExpressions(dashboard, { __rate_interval: "5s", vehicle, sensor: ".*" }));
    for (const [n, { where, expr, rare }] of every.entries()) {
      const found = [];
      for (const one of [expr, ...others.map((other) => other[n].expr)]) found.push(...(await ask(prometheus, one)));
      if (!rare) assert.notEqual(found.length, 0, `${where}: nothing for ${expr}`);
    }
  }
});
