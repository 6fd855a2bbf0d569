// Turns files into one C++ source that holds them as text: node embed.mjs OUT.cpp NAME=FILE...
// A file's hash goes with it, as a Content-Security-Policy names it.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const [out, ...pairs] = process.argv.slice(2);

const entries = pairs.map((pair) => {
  const at = pair.indexOf("=");
  const name = pair.slice(0, at);
  const text = readFileSync(pair.slice(at + 1), "utf8").replaceAll("\r\n", "\n");
  if (text.includes(')gyrod_asset"')) throw new Error(`${name} holds the end of our raw strings`);
  const hash = createHash("sha256").update(text, "utf8").digest("base64");
  return `    {"${name}",\n     "sha256-${hash}",\n     R"gyrod_asset(${text})gyrod_asset"},\n`;
});

writeFileSync(
  out,
  `// Made by service/web/embed.mjs.
#include "web/asset_table.hpp"

#include <array>

namespace gyrod::web {
namespace {

constexpr std::array<Asset, ${entries.length}> kAssets = {{
${entries.join("")}}};

}  // namespace

std::span<const Asset> assets() noexcept { return kAssets; }

}  // namespace gyrod::web
`,
);
