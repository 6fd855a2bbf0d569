// Starts gyrod for tests of its page: a daemon in a DDS domain and a folder of its own, and sensors for it.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const kWait_ms = 20_000;

/// Domains that no other test uses; two runs on one machine most likely differ.
const domain = 220 + (process.pid % 11);
const folder = mkdtempSync(join(tmpdir(), "gyrod-live-"));
const running = new Set();

export const pathOf = (name) => join(folder, name);

export function writeFile(name, text, mode = 0o644) {
  writeFileSync(pathOf(name), text, { mode });
  return pathOf(name);
}

function start(args) {
  const child = spawn(process.env.GYROD_BINARY, args, { stdio: ["ignore", "pipe", "pipe"] });
  const made = { child, said: "", ended: new Promise((done) => child.on("exit", done)) };
  for (const pipe of [child.stdout, child.stderr]) pipe.on("data", (bytes) => (made.said += bytes));
  running.add(made);
  made.ended.then(() => running.delete(made));
  return made;
}

export async function stop(process, signal = "SIGTERM") {
  process.child.kill(signal);
  await process.ended;
}

/// Waits until `look` gives something, at most 20 s.
export async function eventually(look, limit_ms = kWait_ms) {
  const end = Date.now() + limit_ms;
  for (;;) {
    const found = await look();
    if (found || Date.now() > end) return found;
    await new Promise((done) => setTimeout(done, 50));
  }
}

/// port 0: any free one. patch: keys of the configuration besides. @return {process, url, port}
export async function startDaemon({ port = 0, patch = {} } = {}) {
  const config = { ...patch, bus: { domain }, monitor: { ...patch.monitor, port } };
  const file = writeFile("gyrod.json", JSON.stringify(config));
  const process = start(["run", "--config", file]);
  const found = await eventually(() => /127\.0\.0\.1:(\d+)/.exec(process.said) ?? (process.child.exitCode !== null && [null, null]));
  if (!found?.[1]) throw new Error(`the daemon does not say where it listens: ${process.said}`);
  return { process, port: Number(found[1]), url: `${patch.monitor?.tls ? "https" : "http"}://127.0.0.1:${found[1]}/` };
}

export const startSensor = (...args) => start([...args, "--config", pathOf("gyrod.json")]);

export async function cleanUp() {
  await Promise.all([...running].map((process) => stop(process, "SIGKILL")));
  rmSync(folder, { recursive: true });
}
