// A reader of the live page, and what it must never see.
import { expect } from "./harness.mjs";

/// Opens the page in a tab of its own. quiet: what the console may say (a daemon that is gone is told there by the browser); access: how the
/// browser gets in.
export async function read(browser, url, { width = 1440, height = 900, scheme = "light", hash = "", quiet = /^$/, access = {} } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, ...access });
  const page = await context.newPage();
  const where = `${width} px, ${scheme}, ${hash || "no sensor"}`;
  page.on("console", (message) => expect(quiet.test(message.text()), `${where}: console says ${message.text()}`));
  page.on("pageerror", (error) => expect(false, `${where}: ${error.stack}`));
  page.on("dialog", () => expect(false, `${where}: a dialog opened`));
  page.on("request", (request) => expect(request.url().startsWith(url) || request.url().startsWith("data:"), `${where}: asks for ${request.url()}`));
  await page.addInitScript(() => {
    window.longest = 0;
    new PerformanceObserver((list) => list.getEntries().forEach((e) => (window.longest = Math.max(window.longest, e.duration)))).observe({ type: "longtask", buffered: true });
  });
  await page.goto(url + hash);
  await page.waitForFunction(() => document.getElementById("link").textContent === "live");
  return { page, where, close: () => context.close() };
}

/// The row of a sensor in the list.
export const rowOf = (page, sensor) => page.locator(".sensor:not([hidden])", { has: page.locator(".name", { hasText: new RegExp(`^${sensor.replace(/[.*+?^${}()|[\]\\/]/g, "\\$&")}$`) }) });

/// In the page: text that is too faint, and anything else that a reader could see wrong.
function inspect() {
  const numbers = (colour) => {
    const [r, g, b, a = 1] = colour.match(/[\d.]+/g).map(Number);
    return { r, g, b, a };
  };
  const over = (top, below) => ({ r: top.r * top.a + below.r * (1 - top.a), g: top.g * top.a + below.g * (1 - top.a), b: top.b * top.a + below.b * (1 - top.a), a: 1 });
  const behind = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) layers.push(numbers(getComputedStyle(at).backgroundColor));
    return layers.reverse().reduce((below, top) => over(top, below), { r: 255, g: 255, b: 255, a: 1 });
  };
  const luminance = ({ r, g, b }) => {
    const [x, y, z] = [r, g, b].map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const contrast = (a, b) => {
    const [low, high] = [luminance(a), luminance(b)].sort((m, n) => m - n);
    return (high + 0.05) / (low + 0.05);
  };
  const faint = new Set();
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const element = walk.currentNode.parentElement;
    if (!walk.currentNode.data.trim() || !element.checkVisibility() || element.closest("script, style, noscript")) continue;
    const back = behind(element);
    const ratio = contrast(over(numbers(getComputedStyle(element).color), back), back);
    if (ratio < 4.5) faint.add(`"${walk.currentNode.data.trim().slice(0, 40)}" ${ratio.toFixed(2)}`);
  }
  const unnamed = [...document.querySelectorAll("button, input, select, canvas, [role=listbox], [role=group]")]
    .filter((e) => e.checkVisibility() && !(e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim()))
    .map((e) => e.outerHTML.slice(0, 80));
  return { faint: [...faint], unnamed, width: document.documentElement.scrollWidth, words: document.body.innerText, bad: document.querySelector("img") !== null };
}

export async function inspected({ page, where }, width) {
  const seen = await page.evaluate(inspect);
  expect(seen.faint.length === 0, `${where}: too faint: ${seen.faint.join("; ")}`);
  expect(seen.unnamed.length === 0, `${where}: says nothing to a blind reader: ${seen.unnamed.join(" ")}`);
  expect(seen.width <= width, `${where}: ${seen.width} px wide`);
  expect(!seen.bad, `${where}: text became markup`);
  expect(!/NaN|undefined|\[object/.test(seen.words), `${where}: a number that is none: ${/.{0,30}(NaN|undefined|\[object).{0,30}/s.exec(seen.words)?.[0]}`);
  return seen;
}
