// The live page of a daemon with TLS that asks who one is: one who knows the password sees all of it, also after a restart.
import { execFileSync } from "node:child_process";
import { eventually, pathOf, startDaemon, startSensor, stop, writeFile } from "./daemon.mjs";
import { expect } from "./harness.mjs";
import { read, rowOf } from "./live_reader.mjs";

/// By `openssl passwd -6 -salt abcdefgh 'open sesame'`.
const kUsers = "anna:$6$abcdefgh$CkjGkP7IIgZVUCNlt.Vi53LOYJLXZ5KzdpzEYCj01XGruA1hxZYJqccTU2zz68oJwAGsd1iPty5F7dHIatUTy/\n";
const kAnna = { ignoreHTTPSErrors: true, httpCredentials: { username: "anna", password: "open sesame" } };
const kStrangers = { "nobody": { ignoreHTTPSErrors: true }, "a guess": { ...kAnna, httpCredentials: { username: "anna", password: "sesame" } } };

function access() {
  const [certificate, key] = [pathOf("tls.pem"), pathOf("tls.key")];
  const made = ["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=gyrod", "-keyout", key, "-out", certificate];
  execFileSync("openssl", made, { stdio: "ignore" });
  return { tls: { certificate_file: certificate, key_file: key }, auth: { users_file: writeFile("users", kUsers, 0o600) } };
}

/// What the page was told by its streams, and that it draws.
async function follows(page, sensor) {
  await rowOf(page, sensor).waitFor();
  const vitals = await page.textContent("#vitals");
  const moves = await eventually(async () => (await page.textContent("#vitals")) !== vitals);
  expect(moves, `the line on top stays ${vitals}`);
  await page.waitForFunction(() => document.querySelectorAll("#channel canvas").length >= 1);
}

export async function testAccess(browser) {
  const begin = Date.now();
  const patch = { monitor: access() };
  const daemon = await startDaemon({ patch });
  const sensor = startSensor("simulate", "--sensor", "calm");
  for (const [who, options] of Object.entries(kStrangers)) {
    const context = await browser.newContext(options);
    // Chromium has no page for one who gives no name at all.
    const seen = await (await context.newPage()).goto(daemon.url).then((answer) => String(answer.status()), (error) => error.message);
    expect(/^401$|ERR_INVALID_AUTH_CREDENTIALS/.test(seen), `${who} gets ${seen}`);
    await context.close();
  }

  const reader = await read(browser, daemon.url, { hash: "#sensor=calm", quiet: /Failed to load resource/, access: kAnna });
  const { page } = reader;
  await follows(page, "calm");
  await stop(daemon.process);
  await page.getByText(/Disconnected from gyrod since/).waitFor();
  const after = await startDaemon({ port: daemon.port, patch });
  await page.waitForFunction(() => document.getElementById("link").textContent === "live");
  await follows(page, "calm");
  await page.keyboard.press("Escape");
  await page.locator("#overview .events").getByText("gyrod stops").waitFor();
  const log = await page.textContent("#overview .events");
  expect(log.indexOf("has started") >= 0 && log.indexOf("has started") < log.indexOf("gyrod stops"), `the log does not tell of the restart, newest first: ${log}`);
  await reader.close();
  await stop(sensor);
  await stop(after.process);
  console.log(`TLS and a password: ${((Date.now() - begin) / 1000).toFixed(1)} s`);
}
