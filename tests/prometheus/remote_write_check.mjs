// Prometheus hands on what it scrapes, by the remote_write of prometheus.yml, to a real VictoriaMetrics, which answers as Prometheus does.
// Environment besides the rig's: GYROD_VICTORIA_METRICS.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { withParts } from "./commented.mjs";
import { hasty, writeHastyRules } from "./hasty_rules.mjs";
import { Rig, ask, eventually, freePort } from "./rig.mjs";

const rig = new Rig();
let prometheus;
let victoria;
after(() => rig.stop());

before(async () => {
  writeHastyRules(rig.path("rules"));
  const port = await freePort();
  const server = rig.start("victoria-metrics", process.env.GYROD_VICTORIA_METRICS, [
    `-httpListenAddr=127.0.0.1:${port}`,
    `-storageDataPath=${rig.path("victoria")}`,
    "-retentionPeriod=3y",
    "-memory.allowedBytes=64MB",
    "-search.latencyOffset=0s",
  ]);
  victoria = `http://127.0.0.1:${port}`;
  await eventually("VictoriaMetrics is ready", async () => {
    if (server.exitCode !== null) throw new Error(`VictoriaMetrics ended: ${server.said}`);
    return (await fetch(`${victoria}/health`).catch(() => ({ ok: false }))).ok;
  });
  const daemon = await rig.daemon("bench");
  // As somebody does who follows the file's own advice.
  prometheus = await rig.prometheus((text) =>
    hasty(withParts(text, "remote_write:").replaceAll("http://127.0.0.1:8428", victoria)),
  );
  rig.discover(daemon);
  rig.gyrod("drive", "simulate", "--motion", "drive", "--speed", "5", "--batch", "5", "--config", daemon.config);
});

test("what was scraped and what rules made of it is there, with its labels", async () => {
  for (const expr of [
    'gyrod_sensor_health{vehicle="bench",sensor="sim"}',
    'vehicle:gyrod_samples_lost:ratio5m{vehicle="bench"}',
    'deg(gyrod_axis_noise_floor_radians_per_second{vehicle="bench",axis="x"})',
  ]) {
    await eventually(`VictoriaMetrics has ${expr}`, async () => (await ask(victoria, expr)).length === 1);
  }
});

test("an answer is that of Prometheus", async () => {
  const expr = 'max_over_time(gyrod_samples_received_total{vehicle="bench"}[1m])';
  const found = await eventually("samples", async () => (await ask(prometheus, expr)).filter(({ value }) => value[1] > 0)[0]);
  const at = found.value[0];
  // A scrape that began before that instant may be on its way to either.
  await eventually(`both have one answer to ${expr} of that instant`, async () => {
    const [its, ours] = await Promise.all([prometheus, victoria].map((server) => ask(server, expr, at)));
    return Number(ours[0]?.value[1]) > 0 && its[0]?.value[1] === ours[0].value[1];
  });
});
