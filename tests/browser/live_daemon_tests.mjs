// The live page with a daemon and sensors: what it shows is what the API says, and it follows what happens to them.
import { eventually, startDaemon, startSensor, stop, writeFile } from "./daemon.mjs";
import { expect } from "./harness.mjs";
import { inspected, read, rowOf } from "./live_reader.mjs";

const kDegrees = 180 / Math.PI;
const kFault = 8500; // samples: a level takes a while of rest to be learned
const kEnd = 13500;

/// A sensor at rest, at 100 Hz, that becomes three times as loud. end: samples.
export function loudRecording(end = kEnd) {
  let state = 11;
  const uniform = () => {
    // mulberry32: a plainer generator's pairs are not independent, and rest is told by whiteness
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return (((mixed ^ (mixed >>> 14)) >>> 0) + 0.5) / 2 ** 32;
  };
  const normal = () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
  const rows = Array.from({ length: end }, (_, n) => {
    const rates = [0, 1, 2].map(() => (normal() * 0.006 * (n < kFault ? 1 : 3)).toFixed(9));
    return `${n},${n * 10_000_000},${rates.join()}`;
  });
  return `sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n${rows.join("\n")}\n`;
}

const wordOf = (page, sensor) => rowOf(page, sensor).locator(".word");
const numbersOf = (text) => text.replace(/[\u202f ](?=\d{3})/g, "").replace(/−/g, "-").match(/-?\d+(\.\d+)?/g)?.map(Number) ?? [];
const near = (shown, value) => Math.abs(shown - value) <= 0.006 * Math.abs(value); // three digits

async function becomes(page, sensor, state, tone) {
  const found = await eventually(async () => (await wordOf(page, sensor).textContent().catch(() => "")) === state);
  const seen = found ? "" : await rowOf(page, sensor).textContent().catch(() => "no such row");
  expect(found && (await wordOf(page, sensor).getAttribute("data-tone")) === tone, `${sensor} does not become ${state}, ${tone}: ${seen}`);
}

const factOf = (page, name) => page.locator("#channel dt", { hasText: new RegExp(`^${name}$`) }).locator("xpath=following-sibling::dd[1]").textContent();

/// All shown of a sensor that is silent, so that neither changes while they are compared.
async function compare(page, url, sensor) {
  const api = async (path) => (await fetch(`${url}api/v1/${path}`)).json();
  const row = await api(`channels/${sensor}`);
  const cells = await rowOf(page, sensor).locator(".cell").all();
  for (const [i, axis] of row.axes.entries()) {
    const shown = numbersOf(await cells[i].locator(".noise").textContent());
    expect(near(shown[0], axis.noise_in_radps * kDegrees) && near(shown[1], axis.noise_out_radps * kDegrees), `${sensor}: noise ${shown} in the list, ${axis.noise_in_radps * kDegrees} and ${axis.noise_out_radps * kDegrees} by the API`);
    const reduction = numbersOf(await cells[i].locator(".reduction").textContent());
    expect(Math.abs(reduction[0] - axis.reduction_db) <= 0.051, `${sensor}: reduction ${reduction} in the list, ${axis.reduction_db} by the API`);
  }
  for (const name of ["received", "published", "missing"]) {
    const same = await eventually(async () => numbersOf(await factOf(page, name))[0] === row.counts[name]);
    expect(same, `${sensor}: ${name} ${await factOf(page, name)} on the page, ${row.counts[name]} by the API`);
  }
  expect(numbersOf(await factOf(page, "window number"))[0] === row.report.model_epoch, `${sensor}: window ${await factOf(page, "window number")}, ${row.report.model_epoch} by the API`);
  expect(near(numbersOf(await factOf(page, "σ of the noise, raw"))[0], row.axes[0].noise_in_radps * kDegrees), `${sensor}: the noise floor differs`);
  const status = await api("status");
  const vitals = await page.locator("#vitals").textContent();
  expect(vitals.includes(status.version) && vitals.includes(`of ${status.workers}`), `the line on top says ${vitals}`);
  const metrics = await (await fetch(`${url}metrics`)).text();
  const line = metrics.split("\n").find((l) => l.startsWith("gyrod_axis_noise_floor_radians_per_second{") && l.includes(`sensor="${sensor}"`) && l.includes('axis="x"'));
  const metric = Number(line?.split(" ")[1]);
  expect(near(metric, row.axes[0].noise_in_radps), `${sensor}: noise ${metric} by the metrics, ${row.axes[0].noise_in_radps} by the API`);
}

async function emptyFleet(browser, daemon) {
  const reader = await read(browser, daemon.url);
  await reader.page.getByText("No sensors yet").waitFor();
  const { bus } = await (await fetch(`${daemon.url}api/v1/status`)).json();
  const shown = await reader.page.textContent("#empty");
  expect(shown.includes(bus.simulate_hint) && bus.input_topics.every((topic) => shown.includes(topic)), `an empty fleet says ${shown}`);
  await inspected(reader, 1440);
  return reader;
}

export async function testDaemon(browser, daemon) {
  const begin = Date.now();
  const reader = await emptyFleet(browser, daemon);
  const { page, where } = reader;
  const file = writeFile("loud.csv", loudRecording());
  const calm = startSensor("simulate", "--sensor", "calm", "--seed", "3", "--step", "0");
  const killed = startSensor("simulate", "--sensor", "killed", "--seed", "4", "--step", "0");

  await becomes(page, "calm", "ok", "green");
  const loud = startSensor("replay", file, "--sensor", "loud", "--speed", "10", "--batch", "10");
  await rowOf(page, "calm").click();
  await page.waitForFunction(() => document.querySelectorAll("#channel canvas").length >= 2);
  await becomes(page, "loud", "noisy", "red");
  const why = await rowOf(page, "loud").locator(".why").textContent();
  expect(/^\d/.test(why) && (await rowOf(page, "calm").locator(".why").textContent()) === "", `the list says why: ${why}`);
  await inspected(reader, 1440);
  await loud.ended;
  await becomes(page, "loud", "silent", "grey");
  await rowOf(page, "loud").click();
  await page.waitForFunction(() => document.querySelector("#channel .events")?.textContent.includes("noisy"));
  await stop(killed, "SIGKILL");
  await becomes(page, "killed", "silent", "grey");
  await compare(page, daemon.url, "loud");

  await reader.close();
  const other = await read(browser, daemon.url, { hash: "#sensor=calm&axis=z", quiet: /Failed to load resource/ });
  await rowOf(other.page, "killed").waitFor();
  await stop(daemon.process);
  await other.page.getByText(/Disconnected from gyrod since/).waitFor();
  const after = await startDaemon({ port: daemon.port });
  await other.page.waitForFunction(() => document.getElementById("link").textContent === "live");
  await becomes(other.page, "calm", "warming up", "blue");
  expect((await rowOf(other.page, "killed").count()) === 0, `${where}: a sensor that the new daemon has never heard is still there`);
  await other.page.getByText("Rate, z axis").waitFor();
  await other.page.waitForFunction(() => document.querySelectorAll("#channel canvas").length >= 1);
  await other.close();
  await stop(calm);
  await stop(after.process);
  console.log(`daemon: ${((Date.now() - begin) / 1000).toFixed(1)} s`);
}
