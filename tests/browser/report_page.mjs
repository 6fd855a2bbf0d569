// Opens reports in Chromium and looks at them as a reader would. Environment: see harness.mjs.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { conclude, expect, launch } from "./harness.mjs";

const folder = mkdtempSync(join(tmpdir(), "gyrod-report-"));
const gyrod = (...args) => execFileSync(process.env.GYROD_BINARY, args, { stdio: ["ignore", "ignore", "pipe"] });

function simulated(name, ...args) {
  const file = join(folder, name);
  gyrod("simulate", ...args, "-o", file);
  return file;
}

function report(file, name) {
  gyrod("report", file, "-o", join(folder, name));
  return { name, page: join(folder, name, "index.html"), json: JSON.parse(readFileSync(join(folder, name, "report.json"), "utf8")) };
}

/// The page of `gyrod evaluate`, as a report whose axes are its rows.
function evaluation(file, name, ...args) {
  gyrod("evaluate", file, "--lag", "0,8,16", "--turn-repeats", "1", ...args, "-o", join(folder, name));
  const json = JSON.parse(readFileSync(join(folder, name, "evaluation.json"), "utf8"));
  const axes = Object.fromEntries(json.rows.map((row, i) => [i, `${row.axis} axis`]));
  return { name, page: join(folder, name, "evaluation.html"), json: { ...json, axes } };
}

/// A recording that lies still, with accelerometer, so that all figures of the paper can be drawn.
function withAccelerometer(file) {
  const lines = readFileSync(file, "utf8").trimEnd().split("\n");
  const rows = lines.map((line, i) => line + (i === 0 ? ",accel_x_mps2,accel_y_mps2,accel_z_mps2" : ",0.01,-0.02,9.8066"));
  writeFileSync(file, rows.join("\n") + "\n");
  return file;
}

/// Refused samples, and names that would be markup if anybody took them for that.
function hostile(file) {
  const lines = readFileSync(file, "utf8").trimEnd().split("\n");
  const at = lines[0].split(",").indexOf("gyro_x_radps");
  for (let n = 100; n < lines.length; n += 400) {
    const cells = lines[n].split(",");
    cells[at] = "nan";
    lines[n] = cells.join(",");
  }
  const name = join(folder, "<img src=x onerror=alert(1)>&lt;!--<script>window.bad=1<\\script>'\".csv");
  writeFileSync(name, lines.join("\n") + "\n");
  return name;
}

/// In the page: what a reader could see wrong.
function inspect() {
  const style = getComputedStyle(document.documentElement);
  const ink = (name) => {
    const hex = style.getPropertyValue(name).trim();
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  };
  /// Pixels within the axes that have the colour of one of its curves or bars: axes, grid and marks alone have none.
  const painted = (canvas) => {
    const inks = canvas.dataset.colours.split(" ").map(ink);
    const over = canvas.parentElement.querySelector(".u-over");
    const scale = canvas.width / canvas.clientWidth;
    const [width, height] = [over.offsetWidth * scale, over.offsetHeight * scale];
    const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, -over.offsetLeft * scale, -over.offsetTop * scale);
    const { data } = copy.getImageData(0, 0, width, height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 100 && inks.some((rgb) => rgb.every((value, c) => Math.abs(data[i + c] - value) < 40))) count += 1;
    }
    return count;
  };
  const shown = [...document.querySelectorAll("figure")].filter((f) => f.offsetParent !== null);
  return {
    width: document.documentElement.scrollWidth,
    titles: shown.map((f) => f.querySelector(".title").textContent),
    blank: shown.filter((f) => [...f.querySelectorAll("canvas")].some((c) => painted(c) < 30) || !f.querySelector("canvas")).map((f) => f.querySelector(".title").textContent),
    unlabelled: [...document.querySelectorAll("canvas")].filter((c) => !c.getAttribute("aria-label")).length,
    captions: [...document.querySelectorAll("table caption")].map((c) => c.textContent),
    empty: [...document.querySelectorAll("table")].filter((t) => t.tBodies[0].rows.length === 0).map((t) => t.caption.textContent),
    absent: [...document.querySelectorAll(".absent")].map((a) => a.textContent),
    words: document.body.innerText,
    bad: window.bad === 1 || document.querySelector("img") !== null,
  };
}

async function open(browser, report, width, colorScheme) {
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme });
  const page = await context.newPage();
  const where = `${report.name}, ${width} px, ${colorScheme}`;
  page.on("console", (message) => expect(false, `${where}: console says ${message.text()}`));
  page.on("pageerror", (error) => expect(false, `${where}: ${error.stack}`));
  page.on("dialog", () => expect(false, `${where}: a dialog opened`));
  page.on("request", (request) => expect(request.url().startsWith("file:") && request.isNavigationRequest(), `${where}: asks for ${request.url()}`));
  await page.goto(pathToFileURL(report.page).href);
  return { page, where, close: () => context.close() };
}

async function look(browser, report, width, colorScheme, figures, tables) {
  const { page, where, close } = await open(browser, report, width, colorScheme);
  for (const axis of Object.keys(report.json.axes)) {
    await page.click(`#tab-${axis}`);
    const seen = await page.evaluate(inspect);
    expect(seen.width <= width, `${where}: ${seen.width} px wide`);
    expect(seen.blank.length === 0, `${where}: nothing drawn in ${seen.blank}`);
    expect(seen.empty.length === 0, `${where}: empty tables ${seen.empty}`);
    expect(seen.unlabelled === 0, `${where}: ${seen.unlabelled} canvases say nothing to a blind reader`);
    expect(!seen.bad, `${where}: text became markup`);
    expect(!/NaN|undefined|\[object/.test(seen.words), `${where}: a number that is none: ${/.{30}(NaN|undefined|\[object).{30}/s.exec(seen.words)?.[0]}`);
    for (const figure of figures) expect(seen.titles.some((t) => t.startsWith(figure)), `${where}: no ${figure} on axis ${axis}`);
    for (const table of tables) expect(seen.captions.some((t) => t.startsWith(table)), `${where}: no ${table}`);
  }
  const seen = await page.evaluate(inspect);
  await close();
  return seen;
}

/// In the summary each method stands beside filters that may be as late as it is.
async function compare(browser, report) {
  const { page, where, close } = await open(browser, report, 1280, "light");
  const lines = await page.$$eval("#summary tbody tr", (all) => all.map((line) => [...line.cells].map((cell) => cell.textContent)));
  await close();
  const { rows, own_lag_samples: own } = report.json;
  expect(lines.length === rows.length * 3, `${where}: ${lines.length} lines in short`);
  lines.forEach(([, method, lag, rmse, , filter], i) => {
    const expected = method === "realtime" ? 0 : own;
    const { estimators } = rows[Math.floor(i / 3)];
    const at = (e) => e.lags.find((l) => l.lag_bound_samples === expected).rmse_dps;
    const best = Math.min(...estimators.filter((e) => e.kind === "filter").map(at));
    expect(lag === `${expected}`, `${where}: ${method} at lag ${lag}`);
    for (const [shown, right] of [[rmse, at(estimators.find((e) => e.name === method))], [filter, best]]) {
      expect(Math.abs(Number(shown) / right - 1) < 0.005, `${where}: ${method} has ${shown} in short, ${right} is right`);
    }
  });
}

/// Zoom by mouse, back by double click and by key; the other axes by keyboard.
async function use(browser, report, tab = "x", next = "y") {
  const { page, where, close } = await open(browser, report, 1280, "light");
  const plot = page.locator("figure .plot").first();
  await plot.scrollIntoViewIfNeeded();
  const over = await plot.locator(".u-over").boundingBox();
  const pixels = () => plot.locator("canvas").evaluate((canvas) => canvas.toDataURL());
  const whole = await pixels();
  const drag = async () => {
    await page.mouse.move(over.x + over.width * 0.2, over.y + 20);
    await page.mouse.down();
    await page.mouse.move(over.x + over.width * 0.4, over.y + 40, { steps: 4 });
    await page.mouse.up();
  };
  await drag();
  expect((await pixels()) !== whole, `${where}: dragging does not zoom`);
  await page.mouse.dblclick(over.x + over.width * 0.5, over.y + 30);
  expect((await pixels()) === whole, `${where}: a double click does not show all`);
  await plot.focus();
  await page.keyboard.press("+");
  expect((await pixels()) !== whole, `${where}: plus does not zoom`);
  await page.keyboard.press("0");
  expect((await pixels()) === whole, `${where}: 0 does not show all`);
  await page.focus(`#tab-${tab}`);
  await page.keyboard.press("ArrowRight");
  expect(await page.isVisible(`#panel-${next}`), `${where}: an arrow key does not go to the next axis`);
  await close();
}

/// All axes, on white, none wider than the paper.
async function print(browser, report) {
  const { page, where, close } = await open(browser, report, 1280, "dark");
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const seen = await page.evaluate(inspect);
  expect(seen.blank.length === 0, `${where}, printed: nothing drawn in ${seen.blank}`);
  for (const [axis, row] of Object.entries(report.json.axes)) {
    const ending = typeof row === "string" ? row : `${axis} axis`;
    expect(seen.titles.some((t) => t.endsWith(ending)), `${where}, printed: axis ${axis} is missing`);
  }
  const ink = await page.evaluate(() => [...document.querySelectorAll("canvas")].map((c) => c.getBoundingClientRect().width));
  expect(Math.max(...ink) <= 690, `${where}, printed: a figure is ${Math.max(...ink)} px wide`);
  expect(!(await page.isVisible(".tools button")), `${where}, printed: buttons`);
  const pdf = await page.pdf({ format: "A4" });
  expect(pdf.length > 50_000, `${where}: the printed report has ${pdf.length} bytes`);
  await close();
}

const kFigures = ["Fig. 3", "Fig. 4", "Fig. 5", "Fig. 6", "Fig. 7", "Figs 8, 9", "Fig. 10"];
const kTables = ["Table 4", "Table 5", "Table 6"];
const kEvaluationFigures = ["RMSE by lag", "Errors, how often", "10 deg/s within 0.3 s", "2 deg/s within 0.3 s", "20 deg/s^2 for 1 s"];
const kEvaluationTables = ["RMSE in deg/s, each method at its own lag", "RMSE in deg/s by lag", "More of the errors", "What an estimate must not do", "Turns in numbers", "What was run", "All numbers"];
const kNavigationFigures = ["Fig. 11", "Fig. 12", "Fig. 13"];
const kNavigationTables = ["Table 7", "Table 8", "Table 9"];

const browser = await launch();
try {
  const still = report(withAccelerometer(simulated("still.csv", "--seconds", "90", "--seed", "3")), "still");
  const drive = report(simulated("drive.csv", "--motion", "drive", "--seconds", "120", "--seed", "5"), "drive");
  const short = report(simulated("short.csv", "--samples", "200"), "short");
  const strange = report(hostile(simulated("strange.csv", "--seconds", "30")), "strange");
  const tiny = report(simulated("tiny.csv", "--samples", "5"), "tiny");
  const judged = evaluation(join(folder, "drive.csv"), "judged");
  const composite = evaluation(hostile(join(folder, "drive.csv")), "composite", "--noise", join(folder, "still.csv"), "--noise-scale", "0.5,2", "--axis", "y,z");

  for (const [width, scheme] of [[1280, "light"], [1280, "dark"], [390, "light"], [390, "dark"]]) {
    await look(browser, still, width, scheme, [...kFigures, ...kNavigationFigures], [...kTables, ...kNavigationTables]);
    await look(browser, drive, width, scheme, kFigures, kTables);
    await look(browser, short, width, scheme, kFigures, kTables);
    await look(browser, strange, width, scheme, kFigures, kTables);
    await look(browser, judged, width, scheme, kEvaluationFigures, kEvaluationTables);
    await look(browser, composite, width, scheme, kEvaluationFigures, kEvaluationTables);
  }
  expect(still.json.record.still && !drive.json.record.still, "the still record is still, the drive is not");

  const moving = await look(browser, drive, 1280, "light", [], []);
  expect(moving.absent.some((a) => a.includes("moves")), "a moving record: the paper's rule is questioned");
  expect(moving.absent.some((a) => a.startsWith("Figs 11 to 13")), "no accelerometer: said where the figures would be");
  const few = await look(browser, tiny, 390, "light", ["Fig. 3"], ["Table 5"]);
  for (const what of ["Figs 4 to 7", "Table 4", "Fig. 10 and Table 6", "Figs 11 to 13"]) {
    expect(few.absent.some((a) => a.startsWith(what)), `5 samples: nothing says why ${what} is missing`);
  }
  const odd = await look(browser, strange, 1280, "light", [], []);
  expect(odd.words.includes("<img src=x onerror=alert(1)>"), "a strange file name is shown as it is");
  expect(odd.absent.some((a) => a.includes("refused")), "refused samples are told");

  await use(browser, still);
  await print(browser, still);
  await use(browser, judged, "0", "1");
  await compare(browser, judged);
  await print(browser, judged);
} catch (error) {
  expect(false, error.stack);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
conclude();
