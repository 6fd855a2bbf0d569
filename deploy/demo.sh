#!/usr/bin/env bash
# Shows gyrod at work on this machine: installs, builds, denoises a simulated gyro in a driving car live over DDS.
#
#   bash deploy/demo.sh                until Ctrl-C
#   bash deploy/demo.sh --seconds 30   for that long
#
# Everything stays on the loopback interface. Exit code 0 where all of it worked.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=0
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds="${2:?--seconds needs a number}"; shift 2 ;;
    -h | --help) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "demo: unknown option '$1'; expected --seconds N" >&2; exit 2 ;;
  esac
done
[[ "$seconds" =~ ^[0-9]+$ ]] || { echo "demo: --seconds is '$seconds'; expected a whole number" >&2; exit 2; }

bash deploy/install-packages.sh
echo "building (a few minutes the first time) ..."
cmake --preset release >/dev/null
cmake --build --preset release --target gyrod >/dev/null
gyrod=build/release/gyrod

work=$(mktemp -d)
daemon='' recorder='' sensor=''
finish() {  # whatever happened: nothing stays behind
  for process in $sensor $recorder $daemon; do kill -TERM "$process" 2>/dev/null || true; done
  rm -rf "$work"
}
trap finish EXIT

port=9464
if (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then port=0; fi  # taken: any free one
cat >"$work/gyrod.json" <<EOF
{ "bus": { "domain": 94 }, "monitor": { "port": $port }, "log": { "level": "info" } }
EOF

await() {  # FILE TEXT PROCESS: until the file holds the text
  for _ in $(seq 200); do
    if grep -q "$2" "$1" 2>/dev/null; then return 0; fi
    kill -0 "$3" 2>/dev/null || break
    sleep 0.05
  done
  echo "demo: '$2' did not come; it said:" >&2
  cat "$1" >&2
  return 1
}

# In sessions of their own: Ctrl-C shall reach this script alone, which then ends them in order.
setsid "$gyrod" run --config "$work/gyrod.json" 2>"$work/daemon.log" & daemon=$!
await "$work/daemon.log" "metrics at" "$daemon"
url=$(sed -n 's/.*metrics at \(.*\)$/\1/p' "$work/daemon.log")
setsid "$gyrod" record --config "$work/gyrod.json" --topic gyro/denoised --until-end -o "$work/denoised.csv" 2>"$work/recorder.log" & recorder=$!
await "$work/recorder.log" "listening" "$recorder"
setsid "$gyrod" simulate --config "$work/gyrod.json" --motion drive --sensor demo 2>"$work/sensor.log" & sensor=$!

cat <<EOF

gyrod denoises the sensor 'demo': a MEMS gyro in a driving car, 100 samples/s, three axes.
Its page, for a browser: ${url%metrics}
Metrics for Prometheus: $url
Ctrl-C ends it.

EOF

live_line() {  # one scrape, and the one before in the file `last`
  curl -sf --max-time 2 "$url" | awk -v last="$work/last" '
    BEGIN { getline before < last; split(before, was, " ") }
    /^gyrod_windows_total / { windows = $2 }
    /^gyrod_added_latency_seconds_sum / { waited = $2 }
    /^gyrod_added_latency_seconds_count / { count = $2 }
    /^gyrod_axis_noise_floor_radians_per_second/ { noise_in += $2 * $2 }
    /^gyrod_axis_output_noise_radians_per_second/ { noise_out += $2 * $2 }
    END {
      deg = 57.29577951308232 / sqrt(3)
      printf "%s %s %s\n", windows, waited, count > last
      if (noise_in == 0) { printf "  waiting for the first window ...\n"; exit }
      new = count - was[3]
      latency = new > 0 ? (waited - was[2]) / new * 1000 : 0
      printf "  noise in %.3f deg/s  out %.3f deg/s (%2.0f %% less) | %3d windows/s, each done in %.1f ms\n",
        sqrt(noise_in) * deg, sqrt(noise_out) * deg, 100 * (1 - sqrt(noise_out / noise_in)), windows - was[1], latency
    }'
}

stop=0
trap 'stop=1' INT TERM
begin=$SECONDS
while [ "$stop" -eq 0 ] && { [ "$seconds" -eq 0 ] || [ $((SECONDS - begin)) -lt "$seconds" ]; }; do
  sleep 1 || true
  if [ -t 1 ]; then printf '\033[A\033[2K'; fi  # on a terminal the line stands still
  live_line || { echo "demo: the daemon does not answer" >&2; exit 1; }
done

# The sensor ends, gyrod releases what it still held, the recorder has it all, the daemon stops.
kill -INT "$sensor" && wait "$sensor"; sensor=''
wait "$recorder"; recorder=''
kill -TERM "$daemon" && wait "$daemon"; daemon=''

samples=$(($(wc -l <"$work/denoised.csv") - 1))
"$gyrod" simulate --motion drive --samples "$samples" -o "$work/truth.csv" 2>/dev/null  # same seed, with the truth
echo
sed -n 's/.*stopped: /gyrod: /p' "$work/daemon.log"
awk -F, 'FNR == 1 { next }
         NR == FNR { for (i = 4; i <= 6; i++) denoised[$2, i] = $i; next }
         { for (i = 4; i <= 6; i++) { raw += ($i - $(i + 3))^2; ours += (denoised[$2, i] - $(i + 3))^2; n++ } }
         END { printf "RMS error against the simulated truth: raw %.3f deg/s, denoised %.3f deg/s, over %d samples\n",
                 sqrt(raw / n) * 57.29577951308232, sqrt(ours / n) * 57.29577951308232, n / 3 }' \
  "$work/denoised.csv" "$work/truth.csv"
