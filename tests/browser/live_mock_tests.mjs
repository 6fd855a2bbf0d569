// The live page before a mock: many sensors, strange names, all states, both colour schemes, keyboard and phone.
import { expect } from "./harness.mjs";
import { inspected, read, rowOf } from "./live_reader.mjs";
import { startMock } from "./mock_daemon.mjs";

const kMany = 1000;
const kLongTask_ms = 100;
const kHostile = ["<img src=x onerror=alert(1)>", "a&b\"c'd</script>", "../../etc?x=1#y", "javascript:alert(1)", "\u202eevil", "x".repeat(64)];

/// In the page: scrolls through all rows.
async function scrollThrough() {
  const list = document.getElementById("list");
  const frame = () => new Promise(requestAnimationFrame);
  window.longest = 0;
  let blank = 0;
  let frames = 0;
  const begin = performance.now();
  for (let top = 0; top < list.scrollHeight; top += 360) {
    list.scrollTop = top;
    await frame();
    await frame();
    frames += 2;
    const box = list.getBoundingClientRect();
    for (const share of [0.1, 0.5, 0.9]) {
      if (!document.elementFromPoint(box.left + 60, box.top + share * box.height)?.closest(".sensor")) blank += 1;
    }
  }
  const last = list.scrollTop + list.clientHeight >= list.scrollHeight - 1;
  return { blank, frames, last, ms: performance.now() - begin, rows: document.querySelectorAll(".sensor").length, longest: window.longest };
}

/// A thousand rows of which each changes every second. A machine that is busy with other things can stretch any task: what is the page's own
/// doing is long each time.
async function manySensors(browser, page) {
  const sensors = Array.from({ length: kMany }, (_, i) => `car${1 + (i % 50)}/imu${Math.floor(i / 50)}`);
  const mock = await startMock({ page, sensors });
  const reader = await read(browser, mock.url);
  const { page: tab, where } = reader;
  await tab.waitForFunction((n) => document.getElementById("count").textContent.replace(/\D+/, "").startsWith(String(n)[0]) && document.querySelectorAll(".sensor").length > 5, kMany);
  await tab.waitForTimeout(1500);
  let seen = await tab.evaluate(scrollThrough);
  for (let again = 0; again < 2 && seen.longest >= kLongTask_ms; again += 1) seen = await tab.evaluate(scrollThrough);
  console.log(`${kMany} sensors: ${seen.frames} frames in ${(seen.ms / 1000).toFixed(1)} s, longest task ${seen.longest.toFixed(0)} ms, ${seen.rows} rows exist`);
  expect(seen.last && seen.blank === 0, `${where}: ${seen.blank} times no row was there while scrolling`);
  expect(seen.rows < 60, `${where}: ${seen.rows} rows exist at once`);
  expect(seen.longest < kLongTask_ms, `${where}: a task of ${seen.longest} ms with ${kMany} sensors`);

  await tab.fill("#search", "car7/imu1");
  await tab.waitForFunction(() => [...document.querySelectorAll(".sensor:not([hidden]) .name")].every((n) => n.textContent.includes("car7/imu1")));
  const found = await tab.locator(".sensor:not([hidden]) .name").allTextContents();
  expect(found.includes("car7/imu1") && found.length === 11, `${where}: search finds ${found}`);
  await tab.fill("#search", "");
  await tab.check("#troubled");
  await tab.waitForFunction(() => document.querySelectorAll(".sensor:not([hidden])").length === 0);
  mock.set("car3/imu3", 1, "noisy");
  await rowOf(tab, "car3/imu3").waitFor();
  expect((await tab.title()) === "gyrod: 1 troubled", `${where}: the title says ${await tab.title()}`);
  await reader.close();
  await mock.stop();
}

/// Names that would be markup, an address or a script if anybody took them for that.
async function hostileNames(browser, page) {
  const mock = await startMock({ page, sensors: kHostile });
  mock.set(kHostile[0], 0, "noisy");
  const reader = await read(browser, mock.url);
  const { page: tab, where } = reader;
  for (const name of kHostile) {
    await tab.locator(".sensor:not([hidden])").filter({ has: tab.getByText(name, { exact: true }) }).click();
    await tab.waitForFunction((n) => document.querySelector(".channel-name").textContent === n && document.querySelectorAll("#channel canvas").length === 3, name);
    await inspected(reader, 1440);
    const link = tab.url();
    const other = await read(browser, mock.url, { hash: new URL(link).hash });
    await other.page.waitForFunction((n) => document.querySelector(".channel-name").textContent === n && document.querySelectorAll("#channel canvas").length === 3, name);
    await other.close();
  }
  expect((await tab.locator(".channel-head + .channel-state").count()) === 1, `${where}: the state is under the name`);
  await reader.close();
  await mock.stop();
}

/// All states, light and dark, wide and on a phone.
async function looks(browser, page) {
  const states = ["ok", "warming_up", "degraded", "lossy", "drifting", "noisy", "saturated", "stuck", "silent"];
  const mock = await startMock({ page, sensors: states.map((s) => `is_${s}`) });
  const empty = await startMock({ page, sensors: [] });
  for (const state of states) if (state !== "ok") mock.set(`is_${state}`, 0, state);
  for (const scheme of ["light", "dark"]) {
    for (const [width, height] of [[1440, 900], [390, 844]]) {
      const reader = await read(browser, mock.url, { width, height, scheme });
      await reader.page.waitForFunction(() => document.querySelectorAll(".sensor:not([hidden])").length > 3);
      const letters = await reader.page.locator(".states .dot").allTextContents();
      expect(new Set(letters).size === states.length, `${reader.where}: each state has a letter of its own: ${letters}`);
      await inspected(reader, width);
      await rowOf(reader.page, "is_silent").click();
      await reader.page.waitForFunction(() => document.querySelectorAll("#channel canvas").length === 3);
      const seen = await inspected(reader, width);
      for (const words of ["Rate, x axis", "Spectrum, x axis", "Allan deviation at rest", "Decomposition", "Models and floor", "Window and hop", "Events"]) {
        expect(seen.words.includes(words), `${reader.where}: nothing says "${words}"`);
      }
      await reader.page.click('[aria-label^="z axis"]');
      await reader.page.getByText("B: not observable yet, 320 s of at least 900 s at rest").waitFor();
      if (width === 390) {
        expect(!(await reader.page.isVisible("#list")), `${reader.where}: the list is still there`);
        await reader.page.click(".back");
        expect(await reader.page.isVisible("#list"), `${reader.where}: there is no way back to the list`);
      }
      await reader.close();
      const nobody = await read(browser, empty.url, { width, height, scheme });
      await nobody.page.getByText("gyrod simulate --motion drive --sensor demo").waitFor();
      const taught = await inspected(nobody, width);
      expect(taught.words.includes("gyro/raw_batch"), `${nobody.where}: an empty fleet does not say what gyrod listens to`);
      await nobody.close();
    }
  }
  await mock.stop();
  await empty.stop();
}

/// From the top of the page to a sensor's y axis without a mouse, and the address that it leaves.
async function keyboard(browser, page) {
  const mock = await startMock({ page, sensors: ["a", "b", "c"] });
  const reader = await read(browser, mock.url);
  const { page: tab, where } = reader;
  await rowOf(tab, "b").waitFor();
  const focused = () => tab.evaluate(() => document.activeElement.id);
  for (let i = 0; i < 10 && (await focused()) !== "list"; i += 1) await tab.keyboard.press("Tab");
  expect((await focused()) === "list", `${where}: Tab does not reach the list`);
  const outline = await tab.evaluate(() => getComputedStyle(document.querySelector(".sensor.active")).outlineStyle);
  expect(outline === "solid", `${where}: one does not see where one is`);
  await tab.keyboard.press("ArrowDown");
  expect((await tab.locator(`#${await tab.getAttribute("#list", "aria-activedescendant")} .name`).textContent()) === "b", `${where}: an arrow does not go to the next sensor`);
  await tab.keyboard.press("Enter");
  await tab.waitForFunction(() => document.activeElement.classList.contains("channel-name"));
  await tab.keyboard.press("Tab");
  await tab.keyboard.press("Tab");
  await tab.keyboard.press("Enter");
  await tab.getByText("Rate, y axis").waitFor();
  await tab.click('[aria-label="Unit of rates"] [data-value="rad"]');
  expect(new URL(tab.url()).hash === "#sensor=b&axis=y&unit=rad", `${where}: the address says ${new URL(tab.url()).hash}`);
  await tab.getByText("rate, rad/s").or(tab.getByText("raw, rad/s")).first().waitFor();
  await tab.keyboard.press("Escape");
  expect(await tab.isVisible("#overview"), `${where}: Escape does not lead back`);
  await tab.goBack();
  expect(await tab.isVisible("#channel"), `${where}: the browser's back does not lead back`);
  await reader.close();
  await mock.stop();
}

/// A daemon that is restarted on its port: what it said before is marked as old, then gone.
async function restart(browser, page) {
  const before = await startMock({ page, sensors: ["a", "b"] });
  const reader = await read(browser, before.url, { hash: "#sensor=a", quiet: /Failed to load resource/ });
  const { page: tab, where } = reader;
  await rowOf(tab, "b").waitFor();
  await before.stop();
  await tab.getByText(/Disconnected from gyrod since \d\d:\d\d:\d\d/).waitFor();
  await inspected(reader, 1440);
  expect((await tab.title()) === "gyrod: disconnected", `${where}: the title does not say so`);
  const after = await startMock({ page, sensors: ["a", "new"], port: before.port, epoch: "2" });
  await rowOf(tab, "new").waitFor();
  expect((await rowOf(tab, "b").count()) === 0, `${where}: a sensor of the daemon before is still there`);
  await tab.waitForFunction(() => document.querySelectorAll("#channel canvas").length === 3 && document.getElementById("lost").hidden);
  await reader.close();
  await after.stop();
}

export async function testMock(browser, page) {
  for (const test of [manySensors, hostileNames, looks, keyboard, restart]) {
    const begin = Date.now();
    await test(browser, page);
    console.log(`${test.name}: ${((Date.now() - begin) / 1000).toFixed(1)} s`);
  }
}
