// prometheus.yml as it is when somebody takes the comment signs away from what it leaves out. As a program: to a promtool, GYROD_PROMTOOL.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { deployed } from "./rig.mjs";

/** First lines of the parts that prometheus.yml leaves out. */
const kParts = ["scheme: https", "- job_name: gyrod-dns", "remote_write:"];

/** With these parts in. A part ends with its last commented line. */
export function withParts(text, ...parts) {
  for (const part of parts) {
    const lines = new RegExp(`^( *)# ${part}\\n(?:\\1# .*\\n)*`, "m");
    if (!lines.test(text)) throw new Error(`prometheus.yml has no commented '${part}'`);
    text = text.replace(lines, (block) => block.replace(/^( *)# /gm, "$1"));
  }
  return text;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const shipped = readFileSync(join(deployed, "prometheus/prometheus.yml"), "utf8");
  const input = withParts(shipped, ...kParts);
  const folder = mkdtempSync(join(tmpdir(), "gyrod-config-"));
  writeFileSync(join(folder, "prometheus.yml"), input);
  const { status } = spawnSync(process.env.GYROD_PROMTOOL, ["check", "config", "--syntax-only", join(folder, "prometheus.yml")], { stdio: "inherit" });
  rmSync(folder, { recursive: true });
  process.exitCode = status;
}
