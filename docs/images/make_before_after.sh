#!/usr/bin/env bash
# Draws before_after.svg: 20 s of the yaw axis of a simulated drive, before and after gyrod, beside the truth.
#
#   bash docs/images/make_before_after.sh            with build/release/gyrod
#   GYROD=path/to/gyrod bash docs/images/make_before_after.sh
#
# The simulator is seeded and the settings are the defaults: every run draws the same picture.
set -euo pipefail
cd "$(dirname "$0")/../.."

gyrod="${GYROD:-build/release/gyrod}"
seed=2 first_s=28 last_s=48
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$gyrod" simulate --motion drive --seed "$seed" --seconds 60 --unit dps -o "$work/raw.csv" 2>/dev/null
"$gyrod" denoise "$work/raw.csv" -o "$work/denoised.csv" 2>/dev/null

# Columns of both files: sensor, sequence, stamp_ns, three rates, three rates of the truth.
paste -d, "$work/raw.csv" "$work/denoised.csv" | awk -F, -v seed="$seed" -v first="$first_s" -v last="$last_s" '
  # Curves are drawn in tenths of a pixel, each point relative to the one before: half the bytes.
  function curve(id, value, colour, width,    i, x, y, was_x, was_y) {
    printf "<path id=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%d\" stroke-linejoin=\"round\" d=\"", id, colour, width
    for (i = 1; i <= n; i++) {
      x = int(10 * (time[i] - first) * px_per_s + 0.5)
      y = int(10 * (top_dps - value[i]) * px_per_dps + 0.5)
      if (i == 1) printf "M%d %dl", x, y
      else printf "%d %d%s", x - was_x, y - was_y, (i % 25 && i < n) ? " " : (i < n ? "\n" : "")
      was_x = x; was_y = y
    }
    print "\"/>"
  }
  function text(x, y, anchor, size, words) {
    printf "<text x=\"%g\" y=\"%g\" text-anchor=\"%s\" font-size=\"%d\">%s</text>\n", x, y, anchor, size, words
  }
  function panel(y0, name,    dps, s) {
    for (dps = bottom_dps; dps <= top_dps; dps += 2) {
      printf "<path stroke=\"#d9dce1\" d=\"M%d %gh%d\"/>\n", left, y0 + (top_dps - dps) * px_per_dps, width
      text(left - 8, y0 + (top_dps - dps) * px_per_dps + 4, "end", 12, dps)
    }
    for (s = first; s <= last; s += 4) printf "<path stroke=\"#d9dce1\" d=\"M%g %dv%d\"/>\n", left + (s - first) * px_per_s, y0, height
    printf "<text x=\"%d\" y=\"%d\" font-size=\"14\" font-weight=\"bold\">%s</text>\n", left + 12, y0 + 22, name
    printf "<text transform=\"translate(22 %d) rotate(-90)\" text-anchor=\"middle\" font-size=\"12\">yaw rate, deg/s</text>\n", y0 + height / 2
  }
  function key(x, colour, width, words) {
    printf "<path stroke=\"%s\" stroke-width=\"%g\" d=\"M%d 66h28\"/>\n", colour, width, x
    text(x + 34, 70, "start", 12, words)
  }
  NR > 1 && $3 >= first * 1e9 && $3 <= last * 1e9 {
    time[++n] = $3 / 1e9; raw[n] = $6; truth[n] = $9; denoised[n] = $15
    before += ($6 - $9)^2; after += ($15 - $9)^2
  }
  END {
    left = 60; width = 820; height = 230; bottom_dps = -2; top_dps = 8
    px_per_s = width / (last - first); px_per_dps = height / (top_dps - bottom_dps)
    upper = 84; lower = upper + height + 18
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 612\" width=\"900\" height=\"612\" font-family=\"sans-serif\" fill=\"#22262c\">"
    print "<title>Yaw rate of a simulated drive before and after gyrod</title>"
    print "<rect width=\"900\" height=\"612\" rx=\"8\" fill=\"#fcfcfa\"/>"
    printf "<text x=\"%d\" y=\"28\" font-size=\"17\" font-weight=\"bold\">RMS error %.2f deg/s before, %.2f deg/s after (these 20 s, against the truth)</text>\n", left, sqrt(before / n), sqrt(after / n)
    text(left, 48, "start", 12, "Simulated MEMS gyro at 100 Hz in a driving car, seed " seed ": it stands, drives off and turns. Default settings, truth from the simulator.")
    key(left, "#9aa0a8", 1.6, "measured"); key(left + 130, "#0a6fc2", 1.8, "denoised"); key(left + 260, "#22262c", 1.2, "truth")
    panel(upper, "before"); panel(lower, "after")
    printf "<g transform=\"translate(%d %d) scale(.1)\">\n", left, upper
    curve("raw", raw, "#9aa0a8", 11); curve("truth", truth, "#22262c", 8)
    printf "</g>\n<g transform=\"translate(%d %d) scale(.1)\">\n", left, lower
    print "<use href=\"#truth\"/>"; curve("denoised", denoised, "#0a6fc2", 17)
    print "</g>"
    for (s = first; s <= last; s += 4) text(left + (s - first) * px_per_s, lower + height + 18, "middle", 12, s)
    text(left + width / 2, lower + height + 36, "middle", 12, "time, s")
    print "</svg>"
  }' >docs/images/before_after.svg
