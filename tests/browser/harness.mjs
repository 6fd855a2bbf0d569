// What tests of pages share. Environment: GYROD_BINARY, GYROD_CHROMIUM, GYROD_PLAYWRIGHT (folder of playwright-core).
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { chromium } = await import(pathToFileURL(join(process.env.GYROD_PLAYWRIGHT, "index.mjs")));
let failures = 0;

export function expect(holds, what) {
  if (holds) return;
  failures += 1;
  console.error(`FAILED: ${what}`);
}

export const launch = () => chromium.launch({ executablePath: process.env.GYROD_CHROMIUM, args: ["--no-sandbox"] });

/// Says how it went, and sets the exit code: 0, all held.
export function conclude() {
  console.log(failures === 0 ? "all held" : `${failures} did not hold`);
  process.exitCode = failures === 0 ? 0 : 1;
}
