// prometheus.yml as it is when somebody takes the comment signs away from what it leaves out. As a program: to a promtool, GYROD_PROMTOOL.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { deployed } from "./rig.mjs";

const kLeftOut = /^( *)# ((?:- job_name: gyrod-dns|remote_write:)\n(?:\1#   .*\n)*)/gm;
export const withoutCommentSigns = (text) => text.replace(kLeftOut, (_, indent, block) => indent + block.replace(/^ *# /gm, indent));

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const shipped = readFileSync(join(deployed, "prometheus/prometheus.yml"), "utf8");
  const input = withoutCommentSigns(shipped);
  for (const key of ["dns_sd_configs:", "remote_write:"]) {
    if (!new RegExp(`^ *${key}`, "m").test(input)) throw new Error(`prometheus.yml has no ${key} to take the comment signs from`);
  }
  const folder = mkdtempSync(join(tmpdir(), "gyrod-config-"));
  writeFileSync(join(folder, "prometheus.yml"), input);
  const { status } = spawnSync(process.env.GYROD_PROMTOOL, ["check", "config", "--syntax-only", join(folder, "prometheus.yml")], { stdio: "inherit" });
  rmSync(folder, { recursive: true });
  process.exitCode = status;
}
