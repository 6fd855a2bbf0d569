// Takes live_page.png: the live page with simulated sensors, of which one has become noisy. Three minutes.
//
//   GYROD_BINARY=build/release/gyrod GYROD_CHROMIUM=/usr/bin/chromium GYROD_PLAYWRIGHT=build/release/tests/browser/npm/node_modules/playwright-core \
//     node docs/images/make_live_page.mjs
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { cleanUp, eventually, startDaemon, startSensor, writeFile } from "../../tests/browser/daemon.mjs";
import { conclude, expect, launch } from "../../tests/browser/harness.mjs";
import { loudRecording } from "../../tests/browser/live_daemon_tests.mjs";
import { read, rowOf } from "../../tests/browser/live_reader.mjs";

const kFilled_ms = 150_000; // until the drive has stopped for long enough to have an Allan deviation
const picture = join(dirname(fileURLToPath(import.meta.url)), "live_page.png");

const browser = await launch();
try {
  const daemon = await startDaemon({ patch: { health: { noisy_after_s: 5 } } });
  startSensor("simulate", "--motion", "drive", "--sensor", "roof/imu", "--seed", "2");
  startSensor("simulate", "--motion", "drive", "--sensor", "rear_axle/imu", "--seed", "3");
  startSensor("simulate", "--sensor", "cabin/imu", "--seed", "5");
  startSensor("replay", writeFile("loud.csv", loudRecording(180_000)), "--sensor", "front_axle/imu", "--speed", "10", "--batch", "10");
  const { page, close } = await read(browser, daemon.url, { height: 900, hash: "#sensor=roof%2Fimu&axis=z" });
  await page.waitForTimeout(kFilled_ms);
  const noisy = await eventually(async () => (await rowOf(page, "front_axle/imu").locator(".word").textContent()) === "noisy");
  expect(noisy, "no sensor is noisy");
  await page.screenshot({ path: picture });
  await close();
} finally {
  await browser.close();
  await cleanUp();
}
conclude();
process.exit();
