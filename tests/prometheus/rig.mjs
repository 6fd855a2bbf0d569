// A small fleet for a test: real daemons, real sensors, a real Prometheus, all on loopback and gone at the end. Environment: GYROD_BINARY, GYROD_PROMETHEUS.
import { spawn } from "node:child_process";
import { createWriteStream, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { setTimeout as pause } from "node:timers/promises";
import { Readable } from "node:stream";
import { pipeline } from "node:stream/promises";

export const deployed = join(dirname(fileURLToPath(import.meta.url)), "../../deploy");
const kPatience_s = 60;

/** Waits until `holds()` gives something true, and gives it back. @throws after a minute, saying what it waited for. */
export async function eventually(what, holds) {
  const end = Date.now() + 1000 * kPatience_s;
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() > end) throw new Error(`still waiting after ${kPatience_s} s: ${what}`);
    await pause(50);
  }
}

export async function freePort() {
  const server = createServer();
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  const { port } = server.address();
  await new Promise((closed) => server.close(closed));
  return port;
}

const topicNames = ["raw", "raw_batch", "denoised", "denoised_batch", "noise", "health", "realtime", "realtime_batch"];

export class Rig {
  constructor() {
    this.folder = mkdtempSync(join(tmpdir(), "gyrod-prometheus-"));
    // Beyond the domains of tests/integration/rig.cpp.
    this.domain = 206 + (process.pid % 25);
    this.children = [];
    mkdirSync(join(this.folder, "fleet"));
    this.killAll = () => this.children.forEach((child) => child.kill("SIGKILL"));
    process.once("exit", this.killAll);
  }

  path(name) {
    return join(this.folder, name);
  }

  /** Starts a program that ends when we do, whatever ends us; what it says goes to NAME.log. */
  start(name, program, args) {
    const child = spawn("setpriv", ["--pdeathsig", "KILL", program, ...args], { cwd: this.folder, stdio: ["pipe", "pipe", "pipe"] });
    const log = createWriteStream(this.path(`${name}.log`));
    child.name = name;
    child.said = "";
    for (const stream of [child.stdout, child.stderr]) {
      stream.on("data", (text) => {
        child.said += text;
        log.write(text);
      });
    }
    child.over = new Promise((over) => child.once("close", over));
    this.children.push(child);
    return child;
  }

  /** What the last program of that name has said until now. */
  said(name) {
    return this.children.findLast((child) => child.name === name)?.said ?? "nothing";
  }

  gyrod(name, ...args) {
    return this.start(name, process.env.GYROD_BINARY, args);
  }

  /** A gyrod for a vehicle, with topics of its own. @return its address */
  async daemon(vehicle, settings = {}) {
    const config = this.path(`${vehicle}.json`);
    const topics = Object.fromEntries(topicNames.map((topic) => [topic, `${vehicle}/${topic}`]));
    // A machine that is busy elsewhere is no silence.
    const health = { silent_after_s: 5, ...settings.health };
    const whole = { workers: 1, ...settings, health, bus: { domain: this.domain, topics }, monitor: { port: 0, ...settings.monitor } };
    writeFileSync(config, JSON.stringify(whole));
    const child = this.gyrod(`gyrod-${vehicle}`, "run", "--config", config);
    const found = await eventually(`gyrod of ${vehicle} says where its metrics are`, () => {
      if (child.exitCode !== null) throw new Error(`gyrod of ${vehicle} ended: ${child.said}`);
      return child.said.match(/http:\/\/([\d.:]+)\/metrics/);
    });
    return { vehicle, child, config, address: found[1] };
  }

  /** Puts vehicles where Prometheus looks for them. */
  discover(...daemons) {
    for (const { vehicle, address } of daemons) {
      writeFileSync(this.path(`fleet/${vehicle}.json`), JSON.stringify([{ targets: [address], labels: { vehicle } }]));
    }
  }

  /** A sensor that sends `rows` (faults.mjs), so many times faster than real time, until it is killed. */
  sensor({ config }, name, rows, speed) {
    const child = this.gyrod(name, "replay", "-", "--sensor", name, "--speed", `${speed}`, "--batch", "10", "--config", config);
    const source = Readable.from(rows);
    pipeline(source, child.stdin).catch(() => {}); // it was killed
    return child;
  }

  /** A Prometheus with the configuration of deploy/prometheus, after `change`. Rules are read from rules/ of the rig's folder. */
  async prometheus(change) {
    writeFileSync(this.path("prometheus.yml"), change(readFileSync(join(deployed, "prometheus/prometheus.yml"), "utf8")));
    const port = await freePort();
    const server = this.start("prometheus", process.env.GYROD_PROMETHEUS, [
      `--config.file=${this.path("prometheus.yml")}`,
      `--storage.tsdb.path=${this.path("tsdb")}`,
      `--web.listen-address=127.0.0.1:${port}`,
    ]);
    const address = `http://127.0.0.1:${port}`;
    await eventually("Prometheus is ready", async () => {
      if (server.exitCode !== null) throw new Error(`Prometheus ended: ${server.said}`);
      return (await fetch(`${address}/-/ready`).catch(() => ({ ok: false }))).ok;
    });
    return address;
  }

  async stop() {
    this.killAll();
    await Promise.all(this.children.map((child) => child.over));
    process.removeListener("exit", this.killAll);
    rmSync(this.folder, { recursive: true });
  }
}

/** What Prometheus, or what speaks like it, answers to an expression. @throws with its own words */
export async function ask(address, expr, time) {
  const at = time === undefined ? "" : `&time=${time}`;
  const response = await fetch(`${address}/api/v1/query?query=${encodeURIComponent(expr)}${at}`);
  const answer = await response.json();
  if (answer.status !== "success") throw new Error(`${expr}: ${answer.error}`);
  return answer.data.result;
}
