#!/usr/bin/env bash
# Many sensors through the bus for a minute: is anything lost, and does memory stay flat?
#
#   bash tests/benchmark/many_sensors.sh build/release/gyrod [SENSORS [SECONDS]]
#
# 1 000 sensors of three axes at 100 Hz, in batches of 10, to a daemon with short windows of method paper, and from there to a recorder.
# Prints a line every ten seconds and the balance at the end. Uses the loopback network, DDS domain 229 and a folder of its own.
set -euo pipefail

gyrod=${1:?path of gyrod}
sensors=${2:-1000}
seconds=${3:-60}
if [[ ! -f $gyrod || ! -x $gyrod ]]; then
  echo "many_sensors.sh: $gyrod: expected the path of the gyrod binary" >&2
  exit 2
fi
folder=$(mktemp -d)
started=()
finish() {
  for id in "${started[@]}"; do kill "$id" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap finish EXIT

cat > "$folder/gyrod.json" <<JSON
{"bus": {"domain": 229, "input": {"max_messages": 65536}},
 "denoise": {"method": "paper", "window_samples": 64, "hop_samples": 32, "lag_samples": 16, "sifts": 4, "max_ar_order": 2},
 "limits": {"max_channels": 65536, "max_hop_samples": 32},
 "monitor": {"port": 19464}}
JSON

# Waits for the condition as long as the process lives.
until_or_end() {
  until eval "$2"; do
    kill -0 "$1" 2>/dev/null || { cat "$folder"/*.log >&2; exit 1; }
    sleep 0.1
  done
}
metric() { curl -s http://127.0.0.1:19464/metrics | awk -v name="$1" '$1 == name { print $2 }'; }
resident_mib() { awk '/^VmRSS/ { printf "%.0f", $2 / 1024 }' "/proc/$1/status"; }
processor_s() { awk -v hz="$(getconf CLK_TCK)" '{ printf "%.1f", ($14 + $15) / hz }' "/proc/$1/stat"; }

"$gyrod" run --config "$folder/gyrod.json" 2> "$folder/daemon.log" &
daemon=$!
started+=("$daemon")
until_or_end "$daemon" '[[ $(metric gyrod_ready) == 1 ]]'
"$gyrod" record --topic gyro/denoised_batch -o /dev/null --config "$folder/gyrod.json" 2> "$folder/recorder.log" &
recorder=$!
started+=("$recorder")
until_or_end "$recorder" 'grep -q listening "$folder/recorder.log"'
"$gyrod" simulate --sensor imu --sensors "$sensors" --batch 10 --seconds "$seconds" --config "$folder/gyrod.json" 2> "$folder/sensors.log" &
simulator=$!
started+=("$simulator")

echo "time_s received daemon_mib daemon_cpu_s recorder_cpu_s simulator_cpu_s load"
while kill -0 "$simulator" 2>/dev/null; do
  echo "$SECONDS $(metric gyrod_samples_received_total) $(resident_mib "$daemon") $(processor_s "$daemon") $(processor_s "$recorder") $(processor_s "$simulator" 2>/dev/null || true) $(cut -d' ' -f1 /proc/loadavg)"
  sleep 10
done
until_or_end "$daemon" '[[ $(metric gyrod_samples_in_flight) == 0 ]]'
cat "$folder/sensors.log"
for name in received published in_flight missing passed_through; do
  suffix=_total
  [[ $name == in_flight ]] && suffix=
  echo "$name $(metric "gyrod_samples_$name$suffix")"
done
curl -s http://127.0.0.1:19464/metrics | awk '/^gyrod_samples_rejected_total/ { sum += $2 } END { print "rejected", sum }'
echo "overloads $(metric gyrod_overloads_total)  hops_widened $(metric gyrod_hops_widened_total)  refusals $(metric gyrod_bus_refusals_total)"
echo "daemon: $(resident_mib "$daemon") MiB, $(processor_s "$daemon") s of processor time"
kill -TERM "$daemon"
wait "$daemon" || true
wait "$recorder" && echo "recorder: no sequence number is missing" || echo "recorder: exit code $?"
tail -2 "$folder/recorder.log"
